#include "sweep/factor.hpp"

#include "engine/scene/case_keys.hpp"

namespace repose::sweep {

void add_factor(const std::string& name, const std::string& file, const std::string& place,
                std::vector<Factor>& factors, Faults& faults) {
  const auto pointer = factor_pointer(name);
  if (!pointer) faults.add(file, place, "", factor_rule(name));
  for (const Factor& other : factors) {
    if (pointer && other.pointer == *pointer)
      faults.add(file, place, "", "is the same number as " + other.name);
  }
  factors.push_back({name, pointer.value_or(""), {}});
}

}  // namespace repose::sweep
