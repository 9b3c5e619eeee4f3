#pragma once

#include <string>

namespace repose {

/// A result that is given all the same, but is worth less than it looks: in one word for tables
/// ("few_particles"), and with its numbers and what to do for people.
struct Warning {
  std::string name;
  std::string text;
};

}  // namespace repose
