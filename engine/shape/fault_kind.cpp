#include "engine/shape/fault_kind.hpp"

#include <fmt/format.h>

namespace repose {

FaultKind::~FaultKind() {
  if (count_ > kNamedFaults)
    faults_.add(file_, fmt::format("{} more {}", count_ - kNamedFaults, others_), "", rest_);
}

void FaultKind::add(const std::string& place, const std::string& value, const std::string& rule) {
  if (++count_ <= kNamedFaults)
    faults_.add(file_, place, value, rule);
  else
    rest_ = rest_.empty() || rest_ == rule ? rule : "have faults of these kinds";
}

}  // namespace repose
