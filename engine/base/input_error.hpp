#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace repose {

/// One fault of an input: where it stands, what stands there and the rule that it breaks.
struct Fault {
  std::string file;     ///< as the user named it
  std::string pointer;  ///< JSON pointer, or "line 12" / "facet 7" in a file that is not JSON; may be empty
  std::string value;    ///< what was found, may be empty
  std::string rule;     ///< "must be > 0"

  /// `cases/a.json: /particles/density_kg_m3 = -1: must be > 0`
  [[nodiscard]] std::string text() const;
};

/// Bad input, reported whole: what() holds one line per fault.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Fault> faults);
  explicit InputError(Fault fault) : InputError(std::vector<Fault>{std::move(fault)}) {}
  [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }
  /// The same faults under the name of a file, where they were found by what knows of none.
  [[nodiscard]] InputError in_file(const std::string& file) const;

 private:
  std::vector<Fault> faults_;
};

/// Collects faults while a file is read, so that the user sees all of them at once.
class Faults {
 public:
  void add(std::string file, std::string pointer, std::string value, std::string rule) {
    list_.push_back({std::move(file), std::move(pointer), std::move(value), std::move(rule)});
  }
  void add(const InputError& error) {
    list_.insert(list_.end(), error.faults().begin(), error.faults().end());
  }
  void add(const Faults& more) { list_.insert(list_.end(), more.list_.begin(), more.list_.end()); }
  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] const std::vector<Fault>& list() const { return list_; }
  /// Throws InputError with everything collected, if there is anything.
  void throw_if_any() const {
    if (!list_.empty()) throw InputError(list_);
  }

 private:
  std::vector<Fault> list_;
};

}  // namespace repose
