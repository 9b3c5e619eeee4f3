#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "verification/table/row.hpp"

namespace {

using repose::verification::Row;
using repose::verification::Rows;

void print_table(const Rows& rows) {
  fmt::print("{:<96} {:>12} {:>12} {:>8} {:>6}  {:<6}  {}\n", "test", "theory", "result", "error", "bar",
             "passed", "source");
  for (const Row& row : rows)
    fmt::print("{:<96} {:>12.6g} {:>12.6g} {:>8.2g} {:>6.2g}  {:<6}  {}\n", row.test, row.theory, row.result,
               row.error, row.bar, row.passed() ? "yes" : "MISSED", row.source);
}

void print_json(const Rows& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const Row& row : rows)
    list.push_back({{"test", row.test},
                    {"source", row.source},
                    {"theory", row.theory},
                    {"result", row.result},
                    {"error", row.error},
                    {"bar", row.bar},
                    {"passed", row.passed()}});
  fmt::print("{}\n", list.dump(2));
}

}  // namespace

/// repose_verify [--json]: the verification table; 1 if a bar is missed, 2 for an argument it does not know.
int main(int argc, char** argv) {
  const bool json = argc == 2 && std::strcmp(argv[1], "--json") == 0;
  if (argc > 2 || (argc == 2 && !json)) {
    fmt::print(stderr, "usage: verify [--json]\n");
    return 2;
  }
  const Rows rows = repose::verification::all_rows();
  json ? print_json(rows) : print_table(rows);
  for (const Row& row : rows)
    if (!row.passed()) return 1;
  return 0;
}
