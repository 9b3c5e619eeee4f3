#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "verification/program/plots.hpp"
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

void print_markdown(const Rows& rows) {
  fmt::print("| test | source | theory | result | error | bar |\n|---|---|---:|---:|---:|---:|\n");
  for (const Row& row : rows)
    fmt::print("| {} | {} | {:.5g} | {:.5g} | {:.2g} | {:.2g}{} |\n", row.test, row.source, row.theory,
               row.result, row.error, row.bar, row.passed() ? "" : " **missed**");
}

void draw_plots(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto part : {repose::verification::oblique_plots, repose::verification::order_plots})
    for (const repose::verification::Plot& plot : part()) repose::verification::write_plot(plot, folder);
}

struct Arguments {
  void (*print)(const Rows&) = print_table;
  std::optional<std::filesystem::path> plots;
};

std::optional<Arguments> parsed(int argc, char** argv) {
  Arguments arguments;
  for (int k = 1; k < argc; ++k) {
    const std::string_view option = argv[k];
    if (option == "--json") {
      arguments.print = print_json;
    } else if (option == "--markdown") {
      arguments.print = print_markdown;
    } else if (option == "--plots" && k + 1 < argc) {
      arguments.plots = argv[++k];
    } else {
      return {};
    }
  }
  return arguments;
}

}  // namespace

/// repose_verify [--json | --markdown] [--plots DIR]: the verification table; 1 if a bar is missed or the
/// plots cannot be drawn, 2 for an argument it does not know.
int main(int argc, char** argv) {
  const std::optional<Arguments> arguments = parsed(argc, argv);
  if (!arguments) {
    fmt::print(stderr, "usage: verify [--json | --markdown] [--plots DIR]\n");
    return 2;
  }
  try {
    const Rows rows = repose::verification::all_rows();
    arguments->print(rows);
    if (arguments->plots) draw_plots(*arguments->plots);
    for (const Row& row : rows)
      if (!row.passed()) return 1;
  } catch (const std::exception& fault) {
    fmt::print(stderr, "verify: {}\n", fault.what());
    return 1;
  }
  return 0;
}
