#include "engine/base/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "engine/base/input_error.hpp"

namespace repose {

namespace {

std::string trimmed(const std::string& text) {
  const char* blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Cells of one line; a quoted cell may hold commas and doubled quotes, but no line break.
class LineOfCells {
 public:
  explicit LineOfCells(const std::string& line) {
    for (at_ = 0; at_ <= line.size(); ++at_) read_cell(line);
  }
  std::vector<std::string> cells;
  std::string fault;  ///< what is wrong with the quotes; empty where nothing is

 private:
  /// Reads up to the comma or the end of the line.
  void read_cell(const std::string& line) {
    const auto start = line.find_first_not_of(" \t\r", at_);
    if (start == std::string::npos || line[start] != '"') {
      const auto comma = std::min(line.find(',', at_), line.size());
      cells.push_back(trimmed(line.substr(at_, comma - at_)));
      if (cells.back().find('"') != std::string::npos)
        fault = "holds a quote inside a cell that does not begin with one";
      at_ = comma;
      return;
    }
    std::string text;
    for (at_ = start + 1; at_ < line.size(); ++at_) {
      if (line[at_] == '"' && (at_ + 1 == line.size() || line[at_ + 1] != '"')) break;
      if (line[at_] == '"') ++at_;
      text += line[at_];
    }
    if (at_ >= line.size()) fault = "holds a quote that is not closed on its line";
    const auto comma = std::min(line.find(',', at_), line.size());
    if (at_ < comma && !trimmed(line.substr(at_ + 1, comma - at_ - 1)).empty())
      fault = "holds text behind the closing quote of a cell";
    cells.push_back(trimmed(text));
    at_ = comma;
  }

  std::size_t at_ = 0;
};

/// Whether the header's only cell holds what other programs separate cells by.
bool is_separated_otherwise(const std::vector<std::string>& header) {
  return header.size() == 1 && header.front().find_first_of(";\t") != std::string::npos;
}

void check_header(const CsvTable& table, int line, Faults& faults) {
  const std::string where = "line " + std::to_string(line);
  for (auto name = table.columns.begin(); name != table.columns.end(); ++name) {
    if (name->empty())
      faults.add(table.file, where, "", "every column needs a name");
    else if (std::find(table.columns.begin(), name, *name) != name)
      faults.add(table.file, where, *name, "this column is named twice");
  }
}

}  // namespace

std::optional<std::size_t> CsvTable::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

CsvTable read_csv(const std::filesystem::path& file, Faults& faults) {
  CsvTable table;
  table.file = file.string();
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw InputError({table.file, "", "", "cannot be opened"});

  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF"))
      line.erase(0, 3);  // the byte order mark of spreadsheets
    if (const std::string text = trimmed(line); text.empty() || text.front() == '#') continue;
    LineOfCells read(line);
    std::vector<std::string>& cells = read.cells;
    Faults of_line;
    if (!read.fault.empty()) of_line.add(table.file, "line " + std::to_string(number), "", read.fault);
    if (table.columns.empty() && is_separated_otherwise(cells))
      throw InputError(
          {table.file, "line " + std::to_string(number), cells.front(), "cells must be separated by commas"});
    if (table.columns.empty()) {
      table.columns = std::move(cells);
      check_header(table, number, of_line);
      of_line.throw_if_any();
    } else if (!of_line.empty()) {
      faults.add(of_line);  // its cells may be others than were meant
    } else if (cells.size() != table.columns.size()) {
      faults.add(table.file, "line " + std::to_string(number), std::to_string(cells.size()) + " cells",
                 "must have " + std::to_string(table.columns.size()) + " like the header");
    } else {
      table.rows.push_back(std::move(cells));
      table.lines.push_back(number);
    }
  }
  if (table.columns.empty()) throw InputError({table.file, "", "", "holds no header line"});
  return table;
}

std::optional<double> parse_number(const std::string& cell) {
  double number = 0.0;
  const char* first = cell.data();
  const char* last = first + cell.size();
  if (cell.starts_with('+') && !cell.starts_with("+-")) ++first;
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc{} || end != last || first == last || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace repose
