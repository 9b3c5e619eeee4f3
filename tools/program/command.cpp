#include "tools/program/command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace repose::program {

int report_bad_input(const InputError& error, bool json) {
  fmt::print(stderr, "{}\n", error.what());
  if (json) {
    auto faults = nlohmann::ordered_json::array();
    for (const Fault& fault : error.faults())
      faults.push_back(
          {{"file", fault.file}, {"pointer", fault.pointer}, {"value", fault.value}, {"rule", fault.rule}});
    print_json({{"error", "bad input"}, {"faults", faults}});
  }
  return kBadInput;
}

int report_bad_usage(const std::string& message, bool json) {
  fmt::print(stderr, "{}\n", message);
  if (json) print_json({{"error", message}, {"faults", nlohmann::ordered_json::array()}});
  return kBadInput;
}

void print_json(const nlohmann::ordered_json& object) {
  // Names of files need not be UTF-8; what JSON cannot hold is replaced.
  const auto text = object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

void check_range(Faults& faults, const std::string& option, double value, double low, double high,
                 const std::string& rule) {
  if (!(std::isfinite(value) && value >= low && value <= high))
    faults.add(option, "", fmt::format("{}", value), rule);
}

void check_threads(Faults& faults, int threads) {
  constexpr int kMost = 4096;
  check_range(faults, "--threads", threads, 1, kMost, fmt::format("must be between 1 and {}", kMost));
}

}  // namespace repose::program
