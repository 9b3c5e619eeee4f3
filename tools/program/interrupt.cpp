#include "tools/program/interrupt.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "tools/program/command.hpp"

namespace repose::program {

namespace {

std::atomic<bool> stop_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void on_signal(int /*signal*/) {
  if (stop_asked.exchange(true)) _exit(kInterrupted);
  constexpr std::string_view message = "\nstopping in order; once more to stop at once\n";
  // Nothing can be done about a terminal that takes no text.
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message.data(), message.size());
}

}  // namespace

const std::atomic<bool>& watch_for_interrupt() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return stop_asked;
}

}  // namespace repose::program
