// Every number of a case at the ends of what a double holds: refused, or run to a named outcome, or to a heap
// that could lie there.

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "engine/base/json_file.hpp"
#include "engine/scene/case_keys.hpp"
#include "engine/scene/scene_reader.hpp"
#include "stability/hostile/sample/hostile_check.hpp"

namespace repose::hostile {
namespace {

using Json = CaseDocument::Json;

/// Some sixty spheres and every number that a case can give.
Json whole_case() {
  return Json::parse(R"({
    "schema": 1,
    "particles": {
      "density_kg_m3": 2500, "shear_modulus_Pa": 2e6, "poisson_ratio": 0.25, "shapes": [{"sphere": true}],
      "size_classes": [{"volume_mm3": [30, 36], "percent": 60}, {"volume_mm3": [36, 40], "percent": 40}],
      "total_mass_kg": 0.005
    },
    "walls": {"density_kg_m3": 1200, "shear_modulus_Pa": 2e6, "poisson_ratio": 0.4},
    "contact": {
      "particle_particle": {"restitution": 0.3, "static_friction": 0.5, "rolling_friction": 0.1},
      "particle_wall": {"restitution": 0.5, "static_friction": 0.7, "rolling_friction": 0.1},
      "rolling_model": "type_c", "rolling_damping_ratio": 0.3
    },
    "test": {
      "kind": "split_cylinder", "base": {"diameter_mm": 40, "height_mm": 20},
      "cylinder": {"diameter_mm": 20, "height_mm": 60},
      "pour_rate_kg_s": 0.1, "pour_speed_m_s": 0.5, "opening_speed_m_s": 1.0
    },
    "numerics": {
      "time_step_s": 4e-5, "stiffness_scale": 0.5, "settle_energy_ratio": 1e-3, "rest_energy_ratio": 1e-3,
      "stage_time_limit_s": 0.3
    },
    "measure": {"window": [0.1, 0.9]}
  })");
}

void collect_numbers(const Json& value, const std::string& pointer, std::vector<std::string>& found) {
  if (value.is_number()) found.push_back(pointer);
  if (value.is_object())
    for (const auto& [name, below] : value.items()) collect_numbers(below, pointer_to(pointer, name), found);
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i)
      collect_numbers(value[i], pointer_to(pointer, std::to_string(i)), found);
}

class Extremes : public testing::TestWithParam<double> {};

TEST_P(Extremes, OfEveryNumberAreRefusedOrEndWithASoundHeapOrANamedOutcome) {
  std::vector<std::string> pointers;
  collect_numbers(whole_case(), "", pointers);
  ASSERT_GT(pointers.size(), 30U);
  int refused = 0;
  for (const std::string& pointer : pointers) {
    if (pointer == "/numerics/stage_time_limit_s" && GetParam() > 1.0)
      continue;  // asks for all the time there is
    Json json = whole_case();
    json[Json::json_pointer(pointer)] = GetParam();
    Faults faults;
    const Scene scene = read_scene(CaseDocument::from_json(json, "case.json"), faults);
    if (!faults.empty()) {
      ++refused;
      continue;
    }
    const auto begin = std::chrono::steady_clock::now();
    const RunResult result = run_slump_test(scene, 1);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    for (const std::string& fault : faults_of(scene, result))
      ADD_FAILURE() << pointer << " = " << GetParam() << ": " << name_of(result.outcome) << ": " << fault;
    EXPECT_LT(took.count(), 60.0) << pointer << " = " << GetParam() << ": " << name_of(result.outcome);
  }
  EXPECT_GT(refused, 3);
}

INSTANTIATE_TEST_SUITE_P(Of, Extremes, testing::Values(1e-320, 1e-200, 1e-20, 1e20, 1e200, 1e308));

}  // namespace
}  // namespace repose::hostile
