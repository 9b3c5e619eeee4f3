#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/base/random.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/case_document.hpp"
#include "support/process.hpp"
#include "sweep/sweep.hpp"

namespace repose::sweep {

using Json = nlohmann::ordered_json;

/// A small case that the scene reader takes, with a design of its own.
inline Json case_with(const Json& sweep) {
  Json json = Json::parse(R"({
    "schema": 1, "title": "a case of the tests",
    "particles": {"density_kg_m3": 2500, "shear_modulus_Pa": 1e7, "poisson_ratio": 0.25,
                  "shapes": [{"sphere": true, "diameter_mm": 8}], "total_mass_kg": 0.05},
    "walls": {"density_kg_m3": 1200, "shear_modulus_Pa": 1e9, "poisson_ratio": 0.4},
    "contact": {"particle_particle": {"restitution": 0.3, "static_friction": 0.5, "rolling_friction": 0.1},
                "particle_wall": {"restitution": 0.5, "static_friction": 0.6, "rolling_friction": 0.05}},
    "test": {"kind": "split_cylinder", "base": {"diameter_mm": 195, "height_mm": 50},
             "cylinder": {"diameter_mm": 60, "height_mm": 200}}
  })");
  json["sweep"] = sweep;
  return json;
}

inline Json factorial(int replicates = 2) {
  return {{"design", "full_factorial"},
          {"factors", {{"mu_s", {0.2, 0.5, 0.8}}, {"mu_r", {0.05, 0.2}}}},
          {"replicates", replicates},
          {"seed", 7}};
}

inline CaseDocument document_of(const Json& json) { return CaseDocument::from_json(json, "case.json"); }

/// Stands in for a slump test: a result that follows from scene and seed alone, the engine's promise.
inline RunResult fake_run(const Scene& scene, std::uint64_t seed, const RunOptions&) {
  const ContactParameters& contact = scene.contact.particle_particle;
  RandomStream random(seed, 1);
  RunResult result;
  result.measurement.has_heap = true;
  for (Flank& flank : result.measurement.flanks) {
    flank.angle =
        radians(50.0 * std::pow(contact.rolling_friction, 0.08) * std::pow(contact.static_friction, 0.25)) +
        0.01 * random.normal();
    flank.profile = {{0.0, 0.03}, {0.05 * random.uniform(), 0.001}};
    result.measurement.angle += 0.25 * flank.angle;
  }
  result.measurement.standard_error = 0.005;
  result.responses = {0.04, 0.02 + 0.001 * random.uniform(), 1500.0 + scene.particles.total_mass, 0.3};
  result.cost = {0.5 + random.uniform(), 1000 + static_cast<long>(random.below(10)), 1e-5};
  result.bodies = 70;
  result.spheres = 70;
  result.seed = seed;
  return result;
}

inline SweepOptions with_fake_run(int threads = 1) {
  SweepOptions options;
  options.threads = threads;
  options.run = fake_run;
  return options;
}

/// All that a run's result is, in the order of the keys, without date and CPU time.
inline std::string results_in(const std::filesystem::path& folder) {
  Store store = Store::open(folder);
  std::map<std::string, std::string> lines;
  for (StoredRun run : store.runs()) {
    run.finished_at.clear();
    run.cpu_s.reset();
    std::string line;
    visit_columns(run, [&](const char* name, const auto& value) {
      Json json;
      if constexpr (requires { value.has_value(); })
        json = value ? Json(*value) : Json();
      else
        json = value;
      line += std::string(name) + "=" + json.dump() + " ";
    });
    if (const auto flanks = store.flanks(run.run_key)) line += Json(flanks->at(0).angle).dump();
    lines[run.run_key] = line;
  }
  std::string text;
  for (const auto& [key, line] : lines) text += line + "\n";
  return text;
}

/// What a call refuses to do, or "" where it does not refuse.
template <class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class SweepTest : public testing::Test {
 protected:
  std::filesystem::path study() const { return folder_ / "study"; }
  /// What the whole sweep gives when nothing interferes.
  std::string undisturbed(const Json& sweep) const {
    const std::filesystem::path folder = folder_ / "undisturbed";
    run_sweep(document_of(case_with(sweep)), folder, with_fake_run());
    return results_in(folder);
  }
  test::TemporaryFolder folder_;
};

}  // namespace repose::sweep
