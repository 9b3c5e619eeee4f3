#pragma once

#include <string>
#include <vector>

#include "engine/scene/case_document.hpp"
#include "engine/scene/scene_reader.hpp"
#include "support/message_of.hpp"

namespace repose::test {

using Json = CaseDocument::Json;

/// A case without faults that gives every key that has no file behind it.
inline Json good_case() {
  return Json::parse(R"({
    "schema": 1,
    "title": "Good",
    "particles": {
      "density_kg_m3": 2500, "shear_modulus_Pa": 1e7, "poisson_ratio": 0.25,
      "shapes": [ {"sphere": true} ],
      "size_classes": [
        {"volume_mm3": [100, 200], "percent": 60},
        {"volume_mm3": [200, 400], "percent": 40}
      ],
      "total_mass_kg": 1.5, "coarse_graining": 1
    },
    "walls": { "density_kg_m3": 1200, "shear_modulus_Pa": 2e7, "poisson_ratio": 0.4 },
    "contact": {
      "particle_particle": { "restitution": 0.3, "static_friction": 0.5, "rolling_friction": 0.1 },
      "particle_wall":     { "restitution": 0.6, "static_friction": 0.7, "rolling_friction": 0.05 },
      "rolling_model": "type_c",
      "tangential_history": "displacement",
      "normal_damping": "clamped",
      "rolling_damping_ratio": 0.2,
      "rolling_torque": "unlimited"
    },
    "test": {
      "kind": "lifted_cylinder",
      "base": { "diameter_mm": 195, "height_mm": 40 },
      "cylinder": { "diameter_mm": 100, "height_mm": 300 },
      "filling": "rain", "pour_rate_kg_s": 4.0, "pour_speed_m_s": 1.5, "opening": "instant",
      "opening_speed_m_s": 0.5
    },
    "numerics": {
      "time_step_fraction": 0.2, "stiffness_scale": 0.5, "integrator": "velocity_verlet", "settle_energy_ratio": 2e-4,
      "rest_energy_ratio": 3e-5, "rest_angle_change_deg": 0.25, "stage_time_limit_s": 6.0
    },
    "measure": { "window": [0.1, 0.7] }
  })");
}

/// The good case changed by a JSON Merge Patch (RFC 7386: null removes).
inline CaseDocument patched(const std::string& patch) {
  Json json = good_case();
  json.merge_patch(Json::parse(patch));
  return CaseDocument::from_json(std::move(json), "case.json");
}

/// One line per fault of a document, in the order in which they were found.
inline std::vector<std::string> faults_of(const CaseDocument& document) {
  Faults faults;
  read_scene(document, faults);
  std::vector<std::string> lines;
  for (const Fault& fault : faults.list()) lines.push_back(fault.text());
  return lines;
}

}  // namespace repose::test
