#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "engine/base/input_error.hpp"

namespace repose {

inline constexpr std::size_t kNamedFaults = 10;  ///< of one kind; the rest are counted

/// Faults of one kind in one file: the first kNamedFaults by name, the number of the others at the end.
class FaultKind {
 public:
  /// @param others  what the rest are called, as in "7 more facets"
  FaultKind(Faults& faults, std::string file, std::string others)
      : faults_(faults), file_(std::move(file)), others_(std::move(others)) {}
  ~FaultKind();
  FaultKind(const FaultKind&) = delete;
  FaultKind& operator=(const FaultKind&) = delete;

  void add(const std::string& place, const std::string& value, const std::string& rule);
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  Faults& faults_;
  std::string file_;
  std::string others_;
  std::string rest_;  ///< the rule that the others break
  std::size_t count_ = 0;
};

}  // namespace repose
