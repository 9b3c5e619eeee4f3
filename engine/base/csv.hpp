#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/input_error.hpp"

namespace repose {

/// A table read from a CSV file (RFC 4180 quoting, comma separated, header line, '#' lines and blank lines
/// skipped).
struct CsvTable {
  std::string file;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< every row has columns.size() cells, trimmed
  std::vector<int> lines;                      ///< line number in the file of each row, from 1

  /// Index of a column, or nothing where the table has none of that name.
  [[nodiscard]] std::optional<std::size_t> column(const std::string& name) const;
};

/// Rows whose quotes are not closed, or stand inside a cell without them, and rows whose number of cells is
/// not the header's are left out and become faults, each with its line: what is wrong with the others can be
/// said with them. Throws InputError where there is no header to go by: file missing, empty, cells separated
/// otherwise than by commas, a column named twice or without a name.
CsvTable read_csv(const std::filesystem::path& file, Faults& faults);

/// The number that a cell holds in full ("1.5e-3"), or nothing: text, empty, infinite and NaN are not
/// numbers.
std::optional<double> parse_number(const std::string& cell);

}  // namespace repose
