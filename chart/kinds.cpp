#include "chart/kinds.hpp"

namespace repose::chart {

namespace {

std::string part_of(const std::string& pointer) {
  return pointer.starts_with("/particles/shapes") ? "shapes" : pointer.substr(pointer.rfind('/') + 1);
}

}  // namespace

std::vector<std::string> kinds_of(const std::vector<sweep::Variant>& rungs) {
  std::vector<std::string> kinds;
  for (const sweep::Variant& rung : rungs) {
    std::string& kind = kinds.emplace_back();
    for (const sweep::Override& override : rung.own()) {
      const std::string part = part_of(override.pointer);
      if (kind.find(part) == std::string::npos) kind += (kind.empty() ? "" : "+") + part;
    }
  }
  return kinds;
}

}  // namespace repose::chart
