#include "tools/bench/peer/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "engine/base/input_error.hpp"
#include "engine/base/json_file.hpp"

namespace repose::peer {

namespace {

using Json = nlohmann::ordered_json;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double number(const Json& json, const char* pointer) {
  const Json& value = json.at(Json::json_pointer(pointer));
  return value.is_number() ? value.get<double>() : kNaN;
}

PairedRun read_pair(const std::filesystem::path& folder) {
  const Json repose = read_json(folder / "repose.json");
  const Json peer = read_json(folder / "liggghts.json");
  PairedRun run;
  const long steps = repose.at("/cost/steps"_json_pointer).get<long>();
  run.repose = {number(repose, "/angle_of_repose_deg"),
                number(repose, "/responses/bulk_density_kg_m3"),
                number(repose, "/responses/mass_on_base_kg"),
                kNaN,
                steps,
                repose.at("bodies").get<int>()};
  run.liggghts = {number(peer, "/angle_of_repose_deg"),
                  number(peer, "/bulk_density_kg_m3"),
                  number(peer, "/mass_on_base_kg"),
                  kNaN,
                  steps,
                  peer.at("bodies_poured").get<int>()};
  std::ifstream stream(folder / "cpu.txt");
  std::vector<double> own, other;
  for (double a = 0.0, b = 0.0; stream >> a >> b;) own.push_back(a), other.push_back(b);
  run.repose.cpu = median_of(own);
  run.liggghts.cpu = median_of(other);
  return run;
}

template <class Value>
std::vector<double> collect(const std::vector<PairedRun>& runs, Value value) {
  std::vector<double> values;
  for (const PairedRun& run : runs) values.push_back(value(run));
  return values;
}

double ns_per_body_and_step(const ProgramRun& run) {
  return 1e9 * run.cpu / (static_cast<double>(run.bodies) * static_cast<double>(run.steps));
}

Comparison compare_scene(std::vector<PairedRun> runs) {
  Comparison row;
  row.scene = runs.front().scene;
  row.bodies = runs.front().repose.bodies;
  row.seeds = static_cast<int>(runs.size());
  row.repose_angle = mean_of(collect(runs, [](const PairedRun& r) { return r.repose.angle; }));
  row.liggghts_angle = mean_of(collect(runs, [](const PairedRun& r) { return r.liggghts.angle; }));
  row.angle_difference = row.repose_angle.value - row.liggghts_angle.value;
  row.angle_bar =
      kAngleBar + 2.0 * std::hypot(row.repose_angle.standard_error, row.liggghts_angle.standard_error);
  row.repose_density = mean_of(collect(runs, [](const PairedRun& r) { return r.repose.bulk_density; }));
  row.liggghts_density = mean_of(collect(runs, [](const PairedRun& r) { return r.liggghts.bulk_density; }));
  row.density_difference = row.repose_density.value / row.liggghts_density.value - 1.0;
  row.repose_mass = mean_of(collect(runs, [](const PairedRun& r) { return r.repose.mass_on_base; }));
  row.liggghts_mass = mean_of(collect(runs, [](const PairedRun& r) { return r.liggghts.mass_on_base; }));
  row.repose_cpu = median_of(collect(runs, [](const PairedRun& r) { return r.repose.cpu; }));
  row.liggghts_cpu = median_of(collect(runs, [](const PairedRun& r) { return r.liggghts.cpu; }));
  row.cpu_ratio = median_of(collect(runs, [](const PairedRun& r) { return r.liggghts.cpu / r.repose.cpu; }));
  row.repose_ns = median_of(collect(runs, [](const PairedRun& r) { return ns_per_body_and_step(r.repose); }));
  row.liggghts_ns =
      median_of(collect(runs, [](const PairedRun& r) { return ns_per_body_and_step(r.liggghts); }));
  row.runs = std::move(runs);
  return row;
}

Json mean_json(const Mean& mean) {
  return {{"mean", mean.value}, {"standard_error", mean.standard_error}, {"runs", mean.count}};
}

Json program_json(const ProgramRun& run) {
  return {{"angle_deg", run.angle},
          {"bulk_density_kg_m3", run.bulk_density},
          {"mass_on_base_kg", run.mass_on_base},
          {"cpu_s", run.cpu},
          {"steps", run.steps},
          {"bodies", run.bodies}};
}

}  // namespace

bool Comparison::passed() const {
  return std::abs(angle_difference) <= angle_bar && std::abs(density_difference) <= kDensityBar;
}

Mean mean_of(const std::vector<double>& values) {
  Mean mean;
  for (const double value : values)
    if (std::isfinite(value)) mean.value += value, ++mean.count;
  mean.value = mean.count > 0 ? mean.value / mean.count : kNaN;
  double squares = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) squares += (value - mean.value) * (value - mean.value);
  mean.standard_error = mean.count > 1 ? std::sqrt(squares / (mean.count - 1) / mean.count) : kNaN;
  return mean;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return kNaN;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<PairedRun> read_runs(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().filename() == "cpu.txt" &&
        std::filesystem::exists(entry.path().parent_path() / "liggghts.json"))
      found.push_back(entry.path().parent_path());
  if (found.empty()) throw InputError({folder.string(), "", "", "holds no run of both programs"});
  std::sort(found.begin(), found.end());
  std::vector<PairedRun> runs;
  for (const std::filesystem::path& path : found) {
    PairedRun run = read_pair(path);
    run.scene = path.parent_path().lexically_relative(folder).string();
    run.seed = path.filename().string();
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<Comparison> compare(const std::vector<PairedRun>& runs) {
  std::map<std::string, std::vector<PairedRun>> scenes;
  for (const PairedRun& run : runs) scenes[run.scene].push_back(run);
  std::vector<Comparison> table;
  for (auto& [name, of_scene] : scenes) table.push_back(compare_scene(std::move(of_scene)));
  return table;
}

Json to_json(const std::vector<Comparison>& table) {
  Json list = Json::array();
  for (const Comparison& row : table) {
    Json runs = Json::array();
    for (const PairedRun& run : row.runs)
      runs.push_back({{"seed", run.seed},
                      {"repose", program_json(run.repose)},
                      {"liggghts", program_json(run.liggghts)}});
    list.push_back(
        {{"scene", row.scene},
         {"bodies", row.bodies},
         {"seeds", row.seeds},
         {"angle_deg",
          {{"repose", mean_json(row.repose_angle)}, {"liggghts", mean_json(row.liggghts_angle)}}},
         {"angle_difference_deg", row.angle_difference},
         {"angle_bar_deg", row.angle_bar},
         {"bulk_density_kg_m3",
          {{"repose", mean_json(row.repose_density)}, {"liggghts", mean_json(row.liggghts_density)}}},
         {"bulk_density_difference", row.density_difference},
         {"bulk_density_bar", kDensityBar},
         {"mass_on_base_kg",
          {{"repose", mean_json(row.repose_mass)}, {"liggghts", mean_json(row.liggghts_mass)}}},
         {"cpu_s", {{"repose", row.repose_cpu}, {"liggghts", row.liggghts_cpu}}},
         {"cpu_ratio", row.cpu_ratio},
         {"cpu_ns_per_body_and_step", {{"repose", row.repose_ns}, {"liggghts", row.liggghts_ns}}},
         {"passed", row.passed()},
         {"runs", runs}});
  }
  return list;
}

std::string in_words(const std::vector<Comparison>& table) {
  const auto with_error = [](const Mean& mean, int digits) {
    return fmt::format("{:.{}f} ± {:.{}f}", mean.value, digits, mean.standard_error, digits);
  };
  std::string text = fmt::format(
      "{:<30} {:>6} {:>5}  {:>13} {:>13} {:>7} {:>5}  {:>11} {:>11} {:>6}  {:>8} {:>9} {:>6} {:>6} {:>7}  "
      "{}\n",
      "scene", "bodies", "seeds", "angle Repose", "LIGGGHTS", "differ.", "bar", "density Re.", "LIGGGHTS",
      "differ", "CPU Re.", "LIGGGHTS", "ratio", "ns Re.", "LIGG.", "passed");
  for (const Comparison& row : table)
    text += fmt::format(
        "{:<30} {:>6} {:>5}  {:>13} {:>13} {:>+6.2f}° {:>4.2f}°  {:>11} {:>11} {:>+5.2f}%  {:>6.1f} s "
        "{:>7.1f} s {:>6.1f} {:>6.0f} {:>7.0f}  {}\n",
        row.scene, row.bodies, row.seeds, with_error(row.repose_angle, 2), with_error(row.liggghts_angle, 2),
        row.angle_difference, row.angle_bar, with_error(row.repose_density, 0),
        with_error(row.liggghts_density, 0), 100.0 * row.density_difference, row.repose_cpu, row.liggghts_cpu,
        row.cpu_ratio, row.repose_ns, row.liggghts_ns, row.passed() ? "yes" : "MISSED");
  return text;
}

}  // namespace repose::peer
