#include "tools/program/study_answer.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

#include "engine/base/json_file.hpp"
#include "engine/scene/scene_reader.hpp"
#include "fit/fit_json.hpp"
#include "tools/program/output_folder.hpp"
#include "tools/program/progress_line.hpp"
#include "tools/program/response_source.hpp"
#include "tools/program/scene_facts.hpp"
#include "tools/program/sweep_runner.hpp"

namespace repose::program {

namespace fs = std::filesystem;

namespace {

constexpr const char* kQuestionFile = "question.json";

StudyAnswer answer_of(const sweep::Study& study, const std::optional<QuestionOptions>& options) {
  StudyAnswer answer;
  try {
    answer.law =
        fit_of(read_responses(study), options ? fit::loss_named(options->loss) : fit::Loss::least_squares);
    if (!options) return answer;
    Faults faults;
    const fit::Question question = question_of(*options, faults);
    faults.throw_if_any();
    answer.inversion = fit::invert(*answer.law, question);
  } catch (const fit::Unreachable& error) {
    answer.inversion_reason = error.what();
    answer.reachable = error.reachable();
  } catch (const fit::Unusable& error) {
    (answer.law ? answer.inversion_reason : answer.law_reason) = error.what();
  }
  return answer;
}

std::vector<report::Fact> cost_of(const std::vector<sweep::StoredRun>& runs) {
  double cpu = 0.0;
  int count = 0;
  for (const sweep::StoredRun& run : runs) {
    if (!run.point || run.superseded) continue;
    ++count;
    cpu += run.cpu_s.value_or(0.0);
  }
  return {{"runs", std::to_string(count)},
          {"CPU time", duration_text(cpu)},
          {"CPU time a run", fmt::format("{:.3g} s", count > 0 ? cpu / count : 0.0)}};
}

/// How many heaps reach the base's edge. Where some do and some do not, the angles are of two kinds: of a
/// heap that sheds what comes down, and of a cone whose foot lies on the base.
std::string edge_in_words(const std::vector<sweep::StoredRun>& runs) {
  int heaps = 0, cut = 0;
  for (const sweep::StoredRun& run : runs) {
    if (!run.point || run.superseded || !run.reaches_edge) continue;
    ++heaps;
    cut += *run.reaches_edge;
  }
  if (heaps == 0) return {};
  if (cut == heaps) return "Every heap reaches the base's edge: what comes down leaves it.";
  if (cut == 0) return "No heap reaches the base's edge: all are free cones.";
  return fmt::format(
      "{} of {} heaps reach the base's edge, the others are free cones: their angles are of two kinds. Take "
      "a narrower "
      "base or more mass, so that all reach it, or a wider one, so that none does.",
      cut, heaps);
}

report::ReportData report_of(const sweep::Study& study, const StudyAnswer& answer) {
  report::ReportData data;
  const Scene scene = read_scene(study.document);
  data.title = scene.title;
  data.source = study.folder.string();
  data.law = answer.law;
  data.law_reason = answer.law_reason;
  data.inversion = answer.inversion;
  data.inversion_reason = answer.inversion_reason;
  const std::vector<sweep::StoredRun> runs = sweep::runs_of(study.store);
  for (const sweep::StoredRun& run : runs)
    if (!run.superseded) data.runs.push_back({observation_of(run), run.outcome, run.cpu_s, run.warnings});
  for (const auto& [name, count] : answer.warnings)
    data.warnings.push_back({name, count.runs, count.example});
  data.edge = edge_in_words(runs);
  data.inputs = facts_of(scene);
  data.cost = cost_of(runs);
  data.made_by = fmt::format("repose {} (engine {}), {:%Y-%m-%d}", REPOSE_VERSION, engine_version(),
                             fmt::gmtime(std::time(nullptr)));
  return data;
}

}  // namespace

StudyAnswer answer_and_report(const sweep::Study& study, const std::optional<QuestionOptions>& question,
                              const HeapKeeper* keeper, bool quiet) {
  StudyAnswer answer = answer_of(study, question);
  for (const sweep::StoredRun& run : sweep::runs_of(study.store))
    if (run.point && !run.superseded && run.completed()) sweep::count_warnings(run, answer.warnings);
  report::ReportData data = report_of(study, answer);
  const auto measured = question ? std::optional<double>(question->angle) : std::nullopt;
  data.heaps = draw_heaps(study, runs_to_show(sweep::runs_of(study.store), measured), keeper, quiet);
  answer.report = report::write_report(study.folder, data);
  return answer;
}

nlohmann::ordered_json to_json(const StudyAnswer& answer, const std::string& source) {
  nlohmann::ordered_json json;
  if (answer.inversion) json["answer"] = report::answer_in_words(*answer.law, *answer.inversion, source);
  if (!answer.reason().empty()) json["error"] = answer.reason();
  if (answer.reachable) json["reachable_deg"] = {answer.reachable->low, answer.reachable->high};
  if (answer.inversion) json["inversion"] = fit::to_json(*answer.inversion);
  if (answer.law) json["fit"] = fit::to_json(*answer.law);
  json["warnings"] = warnings_json(answer.warnings);
  json["report"] = answer.report.string();
  return json;
}

std::string in_words(const StudyAnswer& answer, const std::string& source) {
  std::string text;
  if (answer.inversion)
    text = report::answer_in_words(*answer.law, *answer.inversion, source);
  else if (answer.law)
    text = report::equation_in_words(*answer.law) + "   (degrees)\n";
  if (!answer.warnings.empty())
    text += "Runs of the equation that carry a warning:\n" + in_words(answer.warnings);
  return text + fmt::format("The report: {}\n", answer.report.string());
}

void keep_question(const fs::path& folder, const QuestionOptions& question) {
  write_file(folder / kQuestionFile, to_json(question).dump(2) + "\n");
}

std::optional<QuestionOptions> kept_question(const fs::path& folder) {
  const fs::path file = folder / kQuestionFile;
  if (!fs::exists(file)) return std::nullopt;
  try {
    return question_from_json(read_json(file));
  } catch (const nlohmann::json::exception& error) {
    throw InputError({file.string(), "", "", std::string("is no question of this program: ") + error.what()});
  }
}

}  // namespace repose::program
