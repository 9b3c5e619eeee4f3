#include "tools/program/response_csv.hpp"

#include <fmt/format.h>

#include <limits>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "engine/base/csv.hpp"
#include "engine/base/input_error.hpp"
#include "sweep/ladder.hpp"

namespace repose::program {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_blank(const std::string& cell) {
  const std::string word = lower(cell);
  return word.empty() || word == "nan" || word == "na" || word == "n/a" || word == "null";
}

/// Cells of one row by the name of their column, with the faults that they have.
class Row {
 public:
  Row(const CsvTable& table, std::size_t row, Faults& faults) : table_(table), row_(row), faults_(faults) {}

  [[nodiscard]] std::string cell(const std::string& column) const {
    const auto at = table_.column(column);
    return at ? table_.rows[row_][*at] : std::string();
  }
  [[nodiscard]] std::string line() const { return fmt::format("line {}", table_.lines[row_]); }

  [[nodiscard]] double number(const std::string& column) const {
    const auto value = parse_number(cell(column));
    if (!value) faults_.add(table_.file, line() + ", " + column, cell(column), "must be a number");
    return value.value_or(0.0);
  }
  [[nodiscard]] double number_or(const std::string& column, double otherwise) const {
    return is_blank(cell(column)) ? otherwise : number(column);
  }
  [[nodiscard]] int whole_number_or(const std::string& column, int otherwise) const {
    const double value = number_or(column, otherwise);
    if (value == std::floor(value) && std::abs(value) < 1e9) return static_cast<int>(value);
    faults_.add(table_.file, line() + ", " + column, cell(column), "must be a whole number");
    return otherwise;
  }

  /// Why a row of a study's table is none of its design's, or "": as for the study itself (response_source).
  [[nodiscard]] std::string left_out_of_its_study() const {
    if (!table_.column("run_key")) return {};
    if (table_.column("point") && cell("point").empty()) return "not in the study's design any more";
    const std::string variant = cell("variant");
    return variant.empty() || variant == sweep::kReference ? "" : "rung of a chart: " + variant;
  }

  [[nodiscard]] bool is_cheap() const {
    const std::string word = lower(cell("fidelity"));
    if (!word.empty() && word != "cheap" && word != "reference")
      faults_.add(table_.file, line() + ", fidelity", cell("fidelity"), "must be cheap or reference");
    return word == "cheap";
  }

 private:
  const CsvTable& table_;
  std::size_t row_;
  Faults& faults_;
};

fit::Observation observation_of(const Row& row) {
  fit::Observation point;
  point.e = row.number("e_pp");
  point.mu_s = row.number("mu_s");
  point.mu_r = row.number("mu_r");
  point.replicate = row.whole_number_or("replicate", 0);
  point.standard_error = row.number_or("angle_standard_error_deg", 0.0);
  point.label = row.line();
  point.cheap = row.is_cheap();
  point.angle = std::numeric_limits<double>::quiet_NaN();  // unless it is one to be used
  const std::string outcome = row.cell("outcome");
  if (!outcome.empty() && outcome != "completed")
    point.exclusion = "outcome " + outcome;
  else if (const std::string reason = row.left_out_of_its_study(); !reason.empty())
    point.exclusion = reason;
  else if (is_blank(row.cell("angle_deg")))
    point.exclusion = "no angle";
  else
    point.angle = row.number("angle_deg");
  return point;
}

}  // namespace

std::vector<fit::Observation> read_response_csv(const std::filesystem::path& file) {
  Faults faults, missing;
  const CsvTable table = read_csv(file, faults);
  for (const char* name : {"e_pp", "mu_s", "mu_r", "angle_deg"})
    if (!table.column(name)) missing.add(table.file, "", name, "this column is missing");
  if (!missing.empty()) missing.add(faults);
  missing.throw_if_any();
  if (table.rows.empty() && faults.empty())
    throw InputError({table.file, "", "", "has no rows below its header"});

  std::vector<fit::Observation> points;
  for (std::size_t i = 0; i < table.rows.size(); ++i) points.push_back(observation_of(Row(table, i, faults)));
  faults.throw_if_any();
  return points;
}

}  // namespace repose::program
