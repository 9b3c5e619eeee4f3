#pragma once

#include <atomic>

namespace repose::program {

/// From here on the first Ctrl-C (or SIGTERM) sets the returned flag, so that what is under way can end in
/// order; the second ends the program at once with exit code 130.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace repose::program
