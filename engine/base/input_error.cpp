#include "engine/base/input_error.hpp"

namespace repose {

std::string Fault::text() const {
  std::string text = file;
  if (!pointer.empty() || !value.empty()) text += ": " + pointer;
  if (!value.empty()) text += (pointer.empty() ? "" : " = ") + value;
  return text + ": " + rule;
}

namespace {
std::string all_of(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + fault.text();
  return text;
}
}  // namespace

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(all_of(faults)), faults_(std::move(faults)) {}

InputError InputError::in_file(const std::string& file) const {
  std::vector<Fault> faults = faults_;
  for (Fault& fault : faults) fault.file = file;
  return InputError(std::move(faults));
}

}  // namespace repose
