#include "chart/kinds.hpp"

#include <map>
#include <utility>

namespace repose::chart {

namespace {

std::string part_of(const std::string& pointer) {
  return pointer.starts_with("/particles/shapes") ? "shapes" : pointer.substr(pointer.rfind('/') + 1);
}

}  // namespace

std::vector<std::string> kinds_of(const std::vector<sweep::Variant>& rungs) {
  std::map<std::pair<std::string, std::string>, std::size_t> rungs_with;
  const auto setting = [](const sweep::Override& override) {
    return std::pair(override.pointer, override.value.dump());
  };
  for (const sweep::Variant& rung : rungs)
    for (const sweep::Override& override : rung.set) ++rungs_with[setting(override)];
  std::vector<std::string> kinds;
  for (const sweep::Variant& rung : rungs) {
    std::string& kind = kinds.emplace_back();
    for (const sweep::Override& override : rung.set) {
      const std::string part = part_of(override.pointer);
      const bool shared = 2 * rungs_with[setting(override)] > rungs.size();
      if (!shared && kind.find(part) == std::string::npos) kind += (kind.empty() ? "" : "+") + part;
    }
  }
  return kinds;
}

}  // namespace repose::chart
