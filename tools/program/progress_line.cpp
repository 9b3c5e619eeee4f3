#include "tools/program/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace repose::program {

namespace {
constexpr std::chrono::milliseconds kTerminalInterval{200};
constexpr std::chrono::seconds kPlainInterval{5};
}  // namespace

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

bool ProgressLine::due() const { return !quiet_ && Clock::now() >= next_; }

void ProgressLine::show(const std::string& text) {
  if (due()) show_now(text);
}

void ProgressLine::show_now(const std::string& text) {
  if (quiet_) return;
  next_ = Clock::now() + (terminal_ ? Clock::duration(kTerminalInterval) : Clock::duration(kPlainInterval));
  if (terminal_)
    fmt::print(stderr, "\r\033[K{}", text);
  else
    fmt::print(stderr, "{}\n", text);
  open_ = terminal_;
  std::fflush(stderr);
}

void ProgressLine::finish() {
  if (open_) fmt::print(stderr, "\n");
  open_ = false;
}

std::string duration_text(double seconds) {
  const long s = std::lround(std::fmax(seconds, 0.0));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

}  // namespace repose::program
