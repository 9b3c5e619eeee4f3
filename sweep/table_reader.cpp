#include "sweep/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/csv.hpp"
#include "sweep/factor.hpp"

namespace repose::sweep {

namespace {

constexpr const char* kReplicate = "replicate";
constexpr double kMostReplicates = 1e6;

std::string at_line(int line) { return "line " + std::to_string(line); }

void read_columns(const CsvTable& table, Design& design, Faults& faults) {
  for (const std::string& name : table.columns) {
    if (name != kReplicate) add_factor(name, table.file, "column " + name, design.factors, faults);
  }
  if (design.factors.empty()) faults.add(table.file, "", "", "has no column with a factor");
}

TableRow read_row(const CsvTable& table, std::size_t index, Faults& faults) {
  TableRow row;
  row.line = table.lines[index];
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const std::string& cell = table.rows[index][c];
    const std::string where = at_line(row.line) + ", " + table.columns[c];
    const double number = parse_number(cell).value_or(std::nan(""));
    if (table.columns[c] != kReplicate) {
      if (std::isnan(number)) faults.add(table.file, where, cell, "must be a number");
      row.values.push_back(number);
    } else if (number >= 1 && number <= kMostReplicates && number == std::floor(number)) {
      row.replicate = static_cast<int>(number);
    } else {
      faults.add(table.file, where, cell, "must be a positive integer");
    }
  }
  return row;
}

void check_repetitions(const CsvTable& table, const Design& design, Faults& faults) {
  std::map<std::pair<std::vector<double>, int>, int> lines;
  for (const TableRow& row : design.rows) {
    if (std::any_of(row.values.begin(), row.values.end(), [](double x) { return std::isnan(x); })) continue;
    const auto [place, is_new] = lines.emplace(std::pair(row.values, row.replicate), row.line);
    if (!is_new)
      faults.add(table.file, at_line(row.line), "", "is the same run as " + at_line(place->second));
  }
}

}  // namespace

void read_design_table(const std::filesystem::path& file, Design& design, Faults& faults) {
  try {
    Faults of_rows;
    const CsvTable table = read_csv(file, of_rows);
    read_columns(table, design, faults);
    for (std::size_t i = 0; i < table.rows.size(); ++i) design.rows.push_back(read_row(table, i, faults));
    if (table.rows.empty() && of_rows.empty())
      faults.add(table.file, "", "", "holds no row below its header");
    faults.add(of_rows);
    check_repetitions(table, design, faults);
  } catch (const InputError& error) {
    faults.add(error);
  }
}

}  // namespace repose::sweep
