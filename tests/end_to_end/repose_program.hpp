#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/process.hpp"

namespace repose::test {

using Json = nlohmann::json;

/// Runs the program with these arguments.
inline Finished repose(const std::vector<std::string>& arguments, const std::filesystem::path& folder = ".") {
  return run(REPOSE_PROGRAM, arguments, folder);
}

/// A slump test of about 350 spheres of 5 mm that takes a fraction of a second: soft material, small
/// cylinder.
inline Json tiny_case() {
  return Json::parse(R"({
    "schema": 1,
    "title": "Tiny",
    "particles": {
      "density_kg_m3": 2500, "shear_modulus_Pa": 2e6, "poisson_ratio": 0.25,
      "shapes": [{"sphere": true, "diameter_mm": 4}],
      "total_mass_kg": 0.025
    },
    "walls": {"density_kg_m3": 2500, "shear_modulus_Pa": 2e6, "poisson_ratio": 0.25},
    "contact": {
      "particle_particle": {"restitution": 0.3, "static_friction": 0.5, "rolling_friction": 0.1},
      "particle_wall": {"restitution": 0.3, "static_friction": 0.5, "rolling_friction": 0.1}
    },
    "test": {
      "kind": "split_cylinder",
      "base": {"diameter_mm": 60, "height_mm": 20},
      "cylinder": {"diameter_mm": 30, "height_mm": 120},
      "pour_rate_kg_s": 0.5, "opening_speed_m_s": 1.0
    },
    "numerics": {"time_step_fraction": 0.3}
  })");
}

/// The tiny case with a sweep: 2 × 2 frictions, each `replicates` times.
inline Json tiny_sweep(int replicates = 1) {
  Json json = tiny_case();
  json["sweep"] = {{"design", "full_factorial"},
                   {"factors", {{"mu_s", {0.3, 0.7}}, {"mu_r", {0.1, 0.2}}}},
                   {"replicates", replicates},
                   {"seed", 3}};
  return json;
}

/// Writes a case into a folder and returns its path.
inline std::string write_case(const TemporaryFolder& folder, const Json& json,
                              const std::string& name = "case.json") {
  write_text(folder / name, json.dump(1));
  return (folder / name).string();
}

/// The lines of a text that hold a word.
inline int lines_with(const std::string& text, const std::string& word) {
  std::istringstream stream(text);
  int count = 0;
  for (std::string line; std::getline(stream, line);) count += line.find(word) != std::string::npos ? 1 : 0;
  return count;
}

}  // namespace repose::test
