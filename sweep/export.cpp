#include "sweep/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "engine/scene/case_keys.hpp"
#include "sweep/self_contained.hpp"
#include "sweep/study.hpp"

namespace repose::sweep {

namespace {

constexpr std::string_view kFactorsColumn = "factors";

/// RFC 4180; line breaks become blanks, so that a line of the file is a line of the table.
std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  if (text.find_first_of(",\"#") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

std::string cell(const std::string& value) { return quoted(value); }
std::string cell(double value) { return fmt::format("{}", value); }
template <class Integer>
std::string cell(Integer value) {
  return std::to_string(value);
}
template <class Value>
std::string cell(const std::optional<Value>& value) {
  return value ? cell(*value) : std::string{};
}

/// Names of all factors but those that have a column of their own.
std::set<std::string> other_factors(const std::vector<StoredRun>& runs) {
  std::set<std::string> names;
  for (const StoredRun& run : runs)
    for (const auto& [name, value] : run.factors) names.insert(name);
  for (const char* own : {"e_pp", "mu_s", "mu_r"}) names.erase(own);
  return names;
}

std::optional<double> factor_of(const StoredRun& run, const std::string& name, const CaseDocument& document) {
  if (const auto found = run.factors.find(name); found != run.factors.end()) return found->second;
  const auto pointer = factor_pointer(name);
  const auto* value = pointer ? document.find(*pointer) : nullptr;
  if (value == nullptr || !value->is_number()) return std::nullopt;
  return value->get<double>();
}

/// Builds one line of the table, of names or of values.
class Line {
 public:
  void add(const std::string& cell) {
    text_ += (first_ ? "" : ",") + cell;
    first_ = false;
  }
  [[nodiscard]] std::string ended() const { return text_ + "\n"; }

 private:
  std::string text_;
  bool first_ = true;
};

std::string header(const std::set<std::string>& factors) {
  Line line;
  StoredRun run;
  visit_columns(run, [&](const char* name, const auto&) {
    if (name != kFactorsColumn) return line.add(name);
    for (const std::string& factor : factors) line.add(quoted(factor));
  });
  return line.ended();
}

std::string line_of(const StoredRun& run, const std::set<std::string>& factors,
                    const CaseDocument& document) {
  Line line;
  visit_columns(run, [&](const char*, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, FactorValues>) {
      for (const std::string& factor : factors) line.add(cell(factor_of(run, factor, document)));
    } else {
      line.add(cell(value));
    }
  });
  return line.ended();
}

}  // namespace

std::string study_as_csv(const std::filesystem::path& folder) {
  const Study study = open_study(folder);
  std::vector<StoredRun> runs = runs_of(study.store);
  std::erase_if(runs, [](const StoredRun& run) { return run.superseded; });
  const std::set<std::string> factors = other_factors(runs);
  std::string text = header(factors);
  for (const StoredRun& run : runs) text += line_of(run, factors, study.document);
  return text;
}

void export_csv(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const std::string text = study_as_csv(folder);
  try {
    replace_file(file, text);
  } catch (const std::exception& error) {
    throw InputError(Fault{file.string(), "", "", std::string("cannot be written: ") + error.what()});
  }
}

}  // namespace repose::sweep
