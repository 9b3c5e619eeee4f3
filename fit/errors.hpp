#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "fit/response_table.hpp"

namespace repose::fit {

/// A table, a saved fit or a question that cannot be answered; what() says why, one line per fault.
class Unusable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A saved fit that is none; what() has a line a fault, each as `fit.json: /C = -1: must be > 0`.
class BadSavedFit : public Unusable {
 public:
  struct Fault {
    std::string pointer;  ///< JSON pointer; empty: the whole file
    std::string value;    ///< what stands there; empty: nothing
    std::string rule;     ///< that it breaks
  };
  BadSavedFit(const std::string& source, std::vector<Fault> faults);
  [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// An angle that the equation gives nowhere in the domain; what() names the range that it does give.
class Unreachable : public Unusable {
 public:
  Unreachable(const std::string& reason, Range reachable) : Unusable(reason), reachable_(reachable) {}
  /// Angles within reach with what is fixed [deg].
  [[nodiscard]] const Range& reachable() const { return reachable_; }

 private:
  Range reachable_;
};

}  // namespace repose::fit
