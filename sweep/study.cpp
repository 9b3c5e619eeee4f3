#include "sweep/study.hpp"

#include <fstream>
#include <iterator>
#include <map>
#include <tuple>

#include "engine/base/json_file.hpp"
#include "sweep/same_case.hpp"
#include "sweep/self_contained.hpp"

namespace repose::sweep {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

CaseDocument document_of(const std::string& text, const fs::path& folder) {
  return CaseDocument::from_json(parse_json(text, (folder / kStudyFile).string()), folder / kCaseFile);
}

/// A case.json that no study has written must not be lost.
void check_for_foreign_case(const fs::path& folder, const std::string& text) {
  const fs::path file = folder / kCaseFile;
  if (fs::exists(folder / kStudyFile) || !fs::exists(file) || text_of(file) == text) return;
  throw InputError(Fault{file.string(), "", "",
                         "is of no study and would be overwritten: choose another folder for the study"});
}

}  // namespace

Study open_study(const fs::path& folder) {
  Store store = Store::open(folder);
  const std::string text = store.case_text();
  if (text.empty())
    throw InputError(
        Fault{folder.string(), "", "", "holds a study without a case: sweep the case into it again"});
  return {folder, std::move(store), document_of(text, folder)};
}

Study open_or_create_study(const fs::path& folder, const CaseDocument& document) {
  const SelfContained contained = self_contained(document, folder);
  const std::string text = contained.document.json().dump(2) + "\n";
  check_for_foreign_case(folder, text);
  Store store = Store::open_or_create(folder);
  const std::string before = store.case_text();
  if (!before.empty() && before != text) {
    if (std::vector<Fault> faults = differences(document_of(before, folder), document); !faults.empty()) {
      const Fault head{folder.string(), "", "", "holds the study of another case"};
      faults.insert(faults.begin(), head);
      throw InputError(std::move(faults));
    }
  }
  copy_files(contained, folder);
  if (before != text) store.set_case_text(text);
  if (text_of(folder / kCaseFile) != text) replace_file(folder / kCaseFile, text);
  return {folder, std::move(store), contained.document};
}

std::vector<StoredRun> runs_of(const Store& store) {
  std::vector<StoredRun> runs = store.runs();
  const auto stands_for = [](const StoredRun& run, const StoredRun& other) {
    return run.point.has_value() != other.point.has_value() ? run.point.has_value() : succeeds(run, other);
  };
  std::map<std::tuple<double, double, double, FactorValues, std::string, std::int64_t>, StoredRun*> latest;
  for (StoredRun& run : runs) {
    StoredRun*& last = latest[{run.e_pp, run.mu_s, run.mu_r, run.factors, run.variant, run.seed}];
    if (last != nullptr) (stands_for(run, *last) ? last : &run)->superseded = true;
    if (last == nullptr || !run.superseded) last = &run;
  }
  return runs;
}

}  // namespace repose::sweep
