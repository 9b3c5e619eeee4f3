#pragma once

#include <chrono>
#include <string>

namespace repose::program {

/// Progress on standard error: one line that is written over on a terminal, elsewhere a plain line every few
/// seconds (the first at once).
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine() { finish(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// True where it is time for the next line; making the text costs nothing otherwise.
  [[nodiscard]] bool due() const;
  void show(const std::string& text);
  /// Shows the text though it is not due, e.g. the last state.
  void show_now(const std::string& text);
  /// Ends the line on a terminal, so that other text can follow.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_;
  bool terminal_;
  bool open_ = false;  ///< a line stands on the terminal without its end
  Clock::time_point next_ = Clock::now();
};

/// "45 s", "3 min 20 s", "2 h 05 min".
std::string duration_text(double seconds);

}  // namespace repose::program
