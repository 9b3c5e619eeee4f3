#include "engine/scene/canonical.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "engine/scene/case_keys.hpp"
#include "unit/scene/good_case.hpp"

namespace repose::test {
namespace {

Scene good_scene() { return read_scene(patched("{}")); }

using Change = std::function<void(Scene&)>;

/// One change for every member of a scene that can change a result.
const std::vector<std::pair<const char*, Change>> kChanges = {
    {"particle density", [](Scene& s) { s.particles.material.density *= 1.001; }},
    {"particle modulus", [](Scene& s) { s.particles.material.shear_modulus *= 1.001; }},
    {"particle Poisson ratio", [](Scene& s) { s.particles.material.poisson_ratio += 0.001; }},
    {"a shape more", [](Scene& s) { s.particles.shapes.push_back(sphere_clump(0.004)); }},
    {"sphere x", [](Scene& s) { s.particles.shapes[0].spheres[0].centre.x() = 1e-9; }},
    {"sphere y", [](Scene& s) { s.particles.shapes[0].spheres[0].centre.y() = 1e-9; }},
    {"sphere z", [](Scene& s) { s.particles.shapes[0].spheres[0].centre.z() = 1e-9; }},
    {"sphere radius", [](Scene& s) { s.particles.shapes[0].spheres[0].radius *= 1.001; }},
    {"a sphere more",
     [](Scene& s) {
       s.particles.shapes[0].spheres.push_back({Vec3::Zero(), 0.001});
     }},
    {"shape volume", [](Scene& s) { s.particles.shapes[0].volume *= 1.001; }},
    {"moment x", [](Scene& s) { s.particles.shapes[0].inertia.x() *= 1.001; }},
    {"moment y", [](Scene& s) { s.particles.shapes[0].inertia.y() *= 1.001; }},
    {"moment z", [](Scene& s) { s.particles.shapes[0].inertia.z() *= 1.001; }},
    {"class minimum", [](Scene& s) { s.particles.size_classes[0].volume_min *= 0.999; }},
    {"class maximum", [](Scene& s) { s.particles.size_classes[0].volume_max *= 1.001; }},
    {"class share", [](Scene& s) { s.particles.size_classes[0].number_fraction *= 1.001; }},
    {"a class less", [](Scene& s) { s.particles.size_classes.pop_back(); }},
    {"total mass", [](Scene& s) { s.particles.total_mass *= 1.001; }},
    {"wall density", [](Scene& s) { s.walls.density *= 1.001; }},
    {"wall modulus", [](Scene& s) { s.walls.shear_modulus *= 1.001; }},
    {"wall Poisson ratio", [](Scene& s) { s.walls.poisson_ratio += 0.001; }},
    {"e_pp", [](Scene& s) { s.contact.particle_particle.restitution += 0.001; }},
    {"mu_s", [](Scene& s) { s.contact.particle_particle.static_friction += 0.001; }},
    {"mu_r", [](Scene& s) { s.contact.particle_particle.rolling_friction += 0.001; }},
    {"e_pw", [](Scene& s) { s.contact.particle_wall.restitution += 0.001; }},
    {"mu_s_pw", [](Scene& s) { s.contact.particle_wall.static_friction += 0.001; }},
    {"mu_r_pw", [](Scene& s) { s.contact.particle_wall.rolling_friction += 0.001; }},
    {"rolling type_a", [](Scene& s) { s.contact.rolling_model = RollingModel::type_a; }},
    {"rolling type_a_relative", [](Scene& s) { s.contact.rolling_model = RollingModel::type_a_relative; }},
    {"rolling type_c_undamped", [](Scene& s) { s.contact.rolling_model = RollingModel::type_c_undamped; }},
    {"history", [](Scene& s) { s.contact.tangential_history = TangentialHistory::force; }},
    {"damping", [](Scene& s) { s.contact.normal_damping = NormalDamping::with_tail; }},
    {"rolling damping", [](Scene& s) { s.contact.rolling_damping_ratio += 0.001; }},
    {"rolling torque", [](Scene& s) { s.contact.rolling_torque = RollingTorque::limited; }},
    {"integrator", [](Scene& s) { s.numerics.integrator = Integrator::symplectic_euler; }},
    {"arithmetic", [](Scene& s) { s.numerics.arithmetic = Arithmetic::mixed; }},
    {"kind", [](Scene& s) { s.test.kind = TestKind::split_cylinder; }},
    {"filling", [](Scene& s) { s.test.filling = Filling::packing; }},
    {"opening", [](Scene& s) { s.test.opening = Opening::moved; }},
    {"base radius", [](Scene& s) { s.test.base_radius += 1e-9; }},
    {"base unbounded", [](Scene& s) { s.test.base_radius = HUGE_VAL; }},
    {"base height", [](Scene& s) { s.test.base_height += 1e-9; }},
    {"cylinder radius", [](Scene& s) { s.test.cylinder_radius += 1e-9; }},
    {"cylinder height", [](Scene& s) { s.test.cylinder_height += 1e-9; }},
    {"pour rate", [](Scene& s) { s.test.pour_rate += 1e-9; }},
    {"pour speed", [](Scene& s) { s.test.pour_speed += 1e-9; }},
    {"opening speed", [](Scene& s) { s.test.opening_speed += 1e-9; }},
    {"shared columns", [](Scene& s) { s.test.shared_columns.emplace(); }},
    {"number of shared columns", [](Scene& s) { s.test.shared_columns = SharedColumns{.count = 2}; }},
    {"e of shared columns", [](Scene& s) { s.test.shared_columns.emplace().contact.restitution = 0.2; }},
    {"mu_s of shared columns",
     [](Scene& s) { s.test.shared_columns.emplace().contact.static_friction = 0.2; }},
    {"mu_r of shared columns",
     [](Scene& s) { s.test.shared_columns.emplace().contact.rolling_friction = 0.2; }},
    {"step fraction", [](Scene& s) { s.numerics.time_step_fraction = 0.3; }},
    {"step automatic", [](Scene& s) { s.numerics.time_step_fraction.reset(); }},
    {"step in seconds", [](Scene& s) { s.numerics.time_step = 0.2; }},
    {"step moved from fraction to seconds",
     [](Scene& s) {
       s.numerics.time_step = s.numerics.time_step_fraction;
       s.numerics.time_step_fraction.reset();
     }},
    {"stiffness scale", [](Scene& s) { s.numerics.stiffness_scale += 1e-9; }},
    {"settle ratio", [](Scene& s) { s.numerics.settle_energy_ratio *= 1.001; }},
    {"rest ratio", [](Scene& s) { s.numerics.rest_energy_ratio *= 1.001; }},
    {"rest angle change", [](Scene& s) { s.numerics.rest_angle_change = 0.001; }},
    {"no rest angle change", [](Scene& s) { s.numerics.rest_angle_change.reset(); }},
    {"time limit", [](Scene& s) { s.numerics.stage_time_limit += 1e-9; }},
    {"window low", [](Scene& s) { s.measure.window_low += 1e-9; }},
    {"window high", [](Scene& s) { s.measure.window_high += 1e-9; }},
};

TEST(CanonicalText, ChangesWithEveryMemberThatCanChangeAResult) {
  std::set<std::string> texts = {canonical_text(good_scene())};
  std::set<std::string> digests = {digest(*texts.begin())};
  for (const auto& [name, change] : kChanges) {
    Scene scene = good_scene();
    change(scene);
    const std::string text = canonical_text(scene);
    EXPECT_TRUE(texts.insert(text).second) << name;
    EXPECT_TRUE(digests.insert(digest(text)).second) << name;
  }
}

TEST(CanonicalText, ChangesWithEveryNumberOfACase) {
  const CaseDocument document = patched("{}");
  const std::string before = canonical_text(read_scene(document));
  int moved_keys = 0;
  for (const CaseKey& key : case_keys()) {
    std::string pointer(key.pattern);
    while (pointer.find('*') != std::string::npos) pointer.replace(pointer.find('*'), 1, "0");
    const Json* value = document.find(pointer);
    if (value == nullptr || !value->is_number() || pointer == "/schema") continue;
    CaseDocument moved = document;
    moved.set(pointer, value->get<double>() * 1.0001, "factor");
    EXPECT_NE(canonical_text(read_scene(moved)), before) << pointer;
    ++moved_keys;
  }
  EXPECT_EQ(moved_keys, 31);  // of the good case
}

// Studies from before the keys were there keep their runs.
TEST(CanonicalText, NamesSharedColumnsOnlyWhereThereAreSome) {
  EXPECT_EQ(canonical_text(good_scene()).find("shared_columns"), std::string::npos);
}

TEST(CanonicalText, NamesTheArithmeticOnlyWhereItIsNotDouble) {
  Scene scene = good_scene();
  EXPECT_EQ(canonical_text(scene).find("arithmetic"), std::string::npos);
  scene.numerics.arithmetic = Arithmetic::mixed;
  EXPECT_NE(canonical_text(scene).find(R"("arithmetic":"mixed")"), std::string::npos);
}

TEST(CanonicalText, DoesNotKnowNamesAndTitles) {
  Scene scene = good_scene();
  scene.title = "another";
  scene.particles.shapes[0].name = "another";
  EXPECT_EQ(canonical_text(scene), canonical_text(good_scene()));
}

TEST(CanonicalText, IsTheSameForTheSameValuesWrittenDifferently) {
  const CaseDocument document = patched(R"({
    "$schema": "case.schema.json", "sweep": {},
    "particles": {"density_kg_m3": 2.5e3, "shear_modulus_Pa": 10000000}})");
  EXPECT_EQ(canonical_text(read_scene(document)), canonical_text(good_scene()));
}

TEST(CanonicalText, KeepsEveryBitOfADouble) {
  Scene scene = good_scene();
  scene.particles.total_mass = 0.1 + 0.2;
  const std::string text = canonical_text(scene);
  scene.particles.total_mass = std::nextafter(scene.particles.total_mass, 1.0);
  EXPECT_NE(canonical_text(scene), text);
  EXPECT_NE(text.find("0.30000000000000004"), std::string::npos);
}

// XXH3, 128 bits, seed 0, of the empty input: test vector of the algorithm's specification.
TEST(Digest, IsXxh3Of128Bits) { EXPECT_EQ(digest(""), "99aa06d3014798d86001c324468d497f"); }

TEST(Digest, HasThirtyTwoHexadecimalDigits) {
  for (int i = 0; i < 1000; ++i) {
    const std::string hex = digest(std::to_string(i));
    ASSERT_EQ(hex.size(), 32U);
    ASSERT_EQ(hex.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
}

}  // namespace
}  // namespace repose::test
