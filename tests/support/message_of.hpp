#pragma once

#include <string>

#include "engine/base/input_error.hpp"

namespace repose::test {

/// what() of the InputError that an action throws; "" where it throws none.
template <class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace repose::test
