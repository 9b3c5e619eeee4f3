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
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += '"';
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
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

CsvTable read_csv(const std::filesystem::path& file) {
  CsvTable table;
  table.file = file.string();
  Faults faults;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw InputError({table.file, "", "", "cannot be opened"});

  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF"))
      line.erase(0, 3);  // the byte order mark of spreadsheets
    if (const std::string text = trimmed(line); text.empty() || text.front() == '#') continue;
    std::vector<std::string> cells = cells_of(line);
    if (table.columns.empty()) {
      table.columns = std::move(cells);
      check_header(table, number, faults);
    } else if (cells.size() != table.columns.size()) {
      faults.add(table.file, "line " + std::to_string(number), std::to_string(cells.size()) + " cells",
                 "must have " + std::to_string(table.columns.size()) + " like the header");
    } else {
      table.rows.push_back(std::move(cells));
      table.lines.push_back(number);
    }
  }
  if (table.columns.empty()) faults.add(table.file, "", "", "holds no header line");
  faults.throw_if_any();
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
