#include "engine/scene/scene_reader.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "engine/shape/mesh_file.hpp"
#include "support/process.hpp"
#include "unit/scene/good_case.hpp"

namespace repose::test {
namespace {

Scene scene_of(const std::string& patch) { return read_scene(patched(patch)); }

TEST(SceneReader, ReadsEveryValueInSiUnits) {
  const Scene scene = scene_of("{}");
  EXPECT_EQ(scene.title, "Good");
  EXPECT_EQ(scene.particles.material.density, 2500.0);
  EXPECT_EQ(scene.particles.material.shear_modulus, 1e7);
  EXPECT_EQ(scene.particles.material.poisson_ratio, 0.25);
  EXPECT_EQ(scene.particles.total_mass, 1.5);
  EXPECT_EQ(scene.walls.density, 1200.0);
  EXPECT_EQ(scene.walls.shear_modulus, 2e7);
  EXPECT_EQ(scene.walls.poisson_ratio, 0.4);
  EXPECT_EQ(scene.contact.particle_particle.restitution, 0.3);
  EXPECT_EQ(scene.contact.particle_particle.static_friction, 0.5);
  EXPECT_EQ(scene.contact.particle_particle.rolling_friction, 0.1);
  EXPECT_EQ(scene.contact.particle_wall.restitution, 0.6);
  EXPECT_EQ(scene.contact.particle_wall.static_friction, 0.7);
  EXPECT_EQ(scene.contact.particle_wall.rolling_friction, 0.05);
  EXPECT_EQ(scene.contact.rolling_model, RollingModel::type_c);
  EXPECT_EQ(scene.contact.tangential_history, TangentialHistory::displacement);
  EXPECT_EQ(scene.contact.normal_damping, NormalDamping::clamped);
  EXPECT_EQ(scene.contact.rolling_damping_ratio, 0.2);
  EXPECT_EQ(scene.contact.rolling_torque, RollingTorque::unlimited);
  EXPECT_EQ(scene.numerics.integrator, Integrator::velocity_verlet);
  EXPECT_EQ(scene.test.kind, TestKind::lifted_cylinder);
  EXPECT_EQ(scene.test.base_radius, 0.0975);
  EXPECT_EQ(scene.test.base_height, 0.04);
  EXPECT_EQ(scene.test.cylinder_radius, 0.05);
  EXPECT_EQ(scene.test.cylinder_height, 0.3);
  EXPECT_EQ(scene.test.filling, Filling::rain);
  EXPECT_EQ(scene.test.pour_rate, 4.0);
  EXPECT_EQ(scene.test.pour_speed, 1.5);
  EXPECT_EQ(scene.test.opening, Opening::instant);
  EXPECT_EQ(scene.test.opening_speed, 0.5);
  EXPECT_EQ(scene.numerics.time_step_fraction, 0.2);
  EXPECT_FALSE(scene.numerics.time_step.has_value());
  EXPECT_EQ(scene.numerics.stiffness_scale, 0.5);
  EXPECT_EQ(scene.numerics.settle_energy_ratio, 2e-4);
  EXPECT_EQ(scene.numerics.rest_energy_ratio, 3e-5);
  EXPECT_EQ(scene.numerics.rest_angle_change, radians(0.25));
  EXPECT_EQ(scene.numerics.stage_time_limit, 6.0);
  EXPECT_EQ(scene.measure.window_low, 0.1);
  EXPECT_EQ(scene.measure.window_high, 0.7);
}

TEST(SceneReader, LeavesTheDefaultsOfTheSceneWhereACaseIsSilent) {
  const Scene scene = scene_of(R"({
    "title": null, "numerics": null, "measure": null,
    "contact": {"rolling_model": null, "tangential_history": null, "normal_damping": null,
                "rolling_damping_ratio": null, "rolling_torque": null},
    "test": {"base": {"height_mm": null}, "filling": null, "pour_rate_kg_s": null, "pour_speed_m_s": null,
             "opening": null, "opening_speed_m_s": null, "shared_columns": null}})");
  EXPECT_EQ(scene.title, "");
  EXPECT_EQ(scene.contact.rolling_model, RollingModel::type_a);
  EXPECT_EQ(scene.contact.tangential_history, TangentialHistory::force);
  EXPECT_EQ(scene.contact.normal_damping, NormalDamping::with_tail);
  EXPECT_EQ(scene.contact.rolling_damping_ratio, 0.3);
  EXPECT_EQ(scene.contact.rolling_torque, RollingTorque::limited);
  EXPECT_EQ(scene.numerics.integrator, Integrator::symplectic_euler);
  EXPECT_EQ(scene.test.base_height, 0.05);
  EXPECT_EQ(scene.test.filling, Filling::pour);
  EXPECT_EQ(scene.test.pour_rate, 5.0);
  EXPECT_EQ(scene.test.pour_speed, 1.0);
  EXPECT_EQ(scene.test.opening, Opening::moved);
  EXPECT_EQ(scene.test.opening_speed, 1.0);
  EXPECT_FALSE(scene.test.shared_columns.has_value());
  EXPECT_EQ(scene.numerics.time_step_fraction, 0.3);
  EXPECT_EQ(scene.numerics.stiffness_scale, 1.0);
  EXPECT_EQ(scene.numerics.settle_energy_ratio, 1e-4);
  EXPECT_EQ(scene.numerics.rest_energy_ratio, 1e-5);
  EXPECT_FALSE(scene.numerics.rest_angle_change.has_value());
  EXPECT_EQ(scene.numerics.stage_time_limit, 5.0);
  EXPECT_EQ(scene.measure.window_low, 0.2);
  EXPECT_EQ(scene.measure.window_high, 0.8);
}

TEST(SceneReader, ReadsSharedColumns) {
  const Scene scene = scene_of(R"({"test": {"shared_columns": {"count": 7, "static_friction": 0.4}}})");
  ASSERT_TRUE(scene.test.shared_columns.has_value());
  EXPECT_EQ(scene.test.shared_columns->count, 7);
  EXPECT_EQ(scene.test.shared_columns->contact.restitution, 0.3);
  EXPECT_EQ(scene.test.shared_columns->contact.static_friction, 0.4);
  EXPECT_EQ(scene.test.shared_columns->contact.rolling_friction, 0.1);
}

TEST(SceneReader, TakesABaseWithoutADiameterAsAnUnboundedPlane) {
  EXPECT_TRUE(std::isinf(scene_of(R"({"test": {"base": null}})").test.base_radius));
  EXPECT_TRUE(std::isinf(scene_of(R"({"test": {"base": {"diameter_mm": null}}})").test.base_radius));
}

TEST(SceneReader, TakesAWideCylinderOnAnUnboundedPlane) {
  const Scene scene = scene_of(R"({"test": {"base": null, "cylinder": {"diameter_mm": 2000}}})");
  EXPECT_EQ(scene.test.cylinder_radius, 1.0);
}

TEST(SceneReader, ReadsTheThreeWaysToGiveATimeStep) {
  const Numerics automatic = scene_of(R"({"numerics": {"time_step_fraction": "auto"}})").numerics;
  EXPECT_FALSE(automatic.time_step_fraction || automatic.time_step);

  const Numerics seconds =
      scene_of(R"({"numerics": {"time_step_fraction": null, "time_step_s": 5e-6}})").numerics;
  EXPECT_FALSE(seconds.time_step_fraction.has_value());
  EXPECT_EQ(seconds.time_step, 5e-6);

  const Numerics fraction = scene_of(R"({"numerics": {"time_step_fraction": 0.45}})").numerics;
  EXPECT_EQ(fraction.time_step_fraction, 0.45);
  EXPECT_FALSE(fraction.time_step.has_value());
}

TEST(SceneReader, TakesTheLimitsOfClosedRanges) {
  const Scene scene = scene_of(R"({
    "particles": {"poisson_ratio": 0},
    "contact": {"particle_particle": {"restitution": 0, "static_friction": 0, "rolling_friction": 0},
                "particle_wall": {"restitution": 1, "static_friction": 3}},
    "test": {"cylinder": {"diameter_mm": 195}},
    "measure": {"window": [0, 1]}})");
  EXPECT_EQ(scene.contact.particle_particle.restitution, 0.0);
  EXPECT_EQ(scene.contact.particle_wall.restitution, 1.0);
  EXPECT_EQ(scene.contact.particle_wall.static_friction, 3.0);
  EXPECT_EQ(scene.test.cylinder_radius, scene.test.base_radius);
}

/// Every member of a coarse-grained scene follows from a length's factor k: lengths k, volumes k³, moments of
/// density 1 k⁵; the mass stays.
void expect_grown(const Scene& fine, const Scene& coarse, double k) {
  ASSERT_EQ(coarse.particles.shapes.size(), fine.particles.shapes.size());
  for (std::size_t s = 0; s < fine.particles.shapes.size(); ++s) {
    const Clump &before = fine.particles.shapes[s], &after = coarse.particles.shapes[s];
    EXPECT_NEAR(after.volume / before.volume, std::pow(k, 3), 1e-12);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(after.inertia[axis] / before.inertia[axis], std::pow(k, 5), 1e-12);
    ASSERT_EQ(after.spheres.size(), before.spheres.size());
    for (std::size_t i = 0; i < before.spheres.size(); ++i) {
      EXPECT_NEAR(after.spheres[i].radius, k * before.spheres[i].radius, 1e-15);
      EXPECT_LT((after.spheres[i].centre - k * before.spheres[i].centre).norm(), 1e-15);
    }
  }
  for (std::size_t c = 0; c < fine.particles.size_classes.size(); ++c) {
    const SizeClass &before = fine.particles.size_classes[c], &after = coarse.particles.size_classes[c];
    EXPECT_NEAR(after.volume_min / before.volume_min, std::pow(k, 3), 1e-12);
    EXPECT_NEAR(after.volume_max / before.volume_max, std::pow(k, 3), 1e-12);
    EXPECT_EQ(after.number_fraction, before.number_fraction);
  }
  EXPECT_EQ(coarse.particles.total_mass, fine.particles.total_mass);
}

TEST(SceneReader, CoarseGrainingScalesSphereClassesAndClumps) {
  const std::string shapes = R"("shapes": [{"clump": "cases/shapes/particle_13.json"}])";
  const std::string own_size = R"("size_classes": null, )";
  for (const std::string& particles : {std::string(), shapes, own_size + shapes})
    expect_grown(scene_of(R"({"particles": {)" + particles + "}}"),
                 scene_of(R"({"particles": {)" + particles + (particles.empty() ? "" : ", ") +
                          R"("coarse_graining": 1.5}})"),
                 1.5);
}

TEST(SceneReader, DoesNotLookIntoTheSweep) {
  EXPECT_EQ(faults_of(patched(R"({"sweep": {"design": "anything", "x": [1, null]}})")),
            std::vector<std::string>{});
}

TEST(SceneReader, MakesASphereOfItsOwnDiameter) {
  const Scene scene =
      scene_of(R"({"particles": {"size_classes": null, "shapes": [{"sphere": true, "diameter_mm": 7.74}]}})");
  ASSERT_EQ(scene.particles.shapes.size(), 1U);
  ASSERT_EQ(scene.particles.shapes[0].spheres.size(), 1U);
  EXPECT_EQ(scene.particles.shapes[0].spheres[0].radius, 0.00387);
  EXPECT_TRUE(scene.particles.size_classes.empty());
}

// A sphere that takes its size from the classes has their mean volume, 0.6 · 150 + 0.4 · 300 mm³, so that
// whatever is computed from the shape alone has the right order; to rounding of cube and root.
TEST(SceneReader, GivesASphereOfTheClassesTheirMeanVolume) {
  const Scene scene = scene_of("{}");
  ASSERT_EQ(scene.particles.shapes.size(), 1U);
  EXPECT_NEAR(scene.particles.shapes[0].volume, 210e-9, 210e-9 * 1e-14);
}

TEST(SceneReader, ReadsClumpsBesideTheFileThatNamesThem) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "shapes");
  write_clump(folder / "shapes/ball.json", sphere_clump(0.004));
  Json json = good_case();
  json["particles"]["shapes"] = Json::parse(R"([{"clump": "shapes/ball.json"}, {"sphere": true}])");
  std::ofstream(folder / "case.json") << json;
  const Scene scene = read_scene(folder / "case.json");
  ASSERT_EQ(scene.particles.shapes.size(), 2U);
  EXPECT_EQ(scene.particles.shapes[0].spheres[0].radius, 0.004);
}

TEST(SceneReader, ReportsTheFaultsOfAClumpFileWithItsOwnName) {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.json") << R"({"schema": 1, "mass": -1, "inertia": [1, 1, 1], "spheres": []})";
  CaseDocument document = patched(R"({"walls": {"density_kg_m3": -1}})");
  document.set("/particles/shapes/0", {{"clump", (folder / "bad.json").string()}}, "case.json");
  const std::vector<std::string> faults = faults_of(document);
  ASSERT_GE(faults.size(), 3U);
  EXPECT_EQ(faults[0], "case.json: /walls/density_kg_m3 = -1: must be > 0");
  for (std::size_t i = 1; i < faults.size(); ++i)
    EXPECT_TRUE(faults[i].starts_with((folder / "bad.json").string() + ": ")) << faults[i];
}

Mesh tetrahedron() {
  return {.name = "tetrahedron",
          .vertices = {Vec3(0, 0, 0), Vec3(0.008, 0, 0), Vec3(0, 0.008, 0), Vec3(0, 0, 0.008)},
          .facets = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// V = a³/6 of the tetrahedron cut off a corner of a cube of side a; STL holds single precision, 1e-6.
TEST(SceneReader, MakesAClumpOfAMeshWithTheMeshsVolume) {
  const TemporaryFolder folder;
  write_stl(folder / "corner.stl", tetrahedron());
  CaseDocument document = patched("{}");
  document.set("/particles/shapes/0", {{"mesh", (folder / "corner.stl").string()}, {"spheres", 4}}, "t");
  const Scene scene = read_scene(document);
  ASSERT_EQ(scene.particles.shapes.size(), 1U);
  const double volume = 0.008 * 0.008 * 0.008 / 6.0;
  EXPECT_NEAR(scene.particles.shapes[0].volume, volume, 1e-6 * volume);
  EXPECT_GE(scene.particles.shapes[0].spheres.size(), 2U);
  EXPECT_LE(scene.particles.shapes[0].spheres.size(), 4U);
}

// Numbers of millimetres in a file that says nothing of its unit: up to 5 they are taken for metres.
TEST(SceneReader, TakesTheUnitOfAMeshFromTheCase) {
  const TemporaryFolder folder;
  write_text(folder / "corner.obj",
             "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  CaseDocument document = patched(R"({"particles": {"size_classes": null}})");
  nlohmann::ordered_json shape = {{"mesh", (folder / "corner.obj").string()}, {"spheres", 4}};
  document.set("/particles/shapes/0", shape, "t");
  const std::vector<std::string> faults = faults_of(document);
  ASSERT_FALSE(faults.empty());
  EXPECT_NE(faults[0].find("(is its mesh in mm? /particles/shapes/0/unit says so)"), std::string::npos)
      << faults[0];
  shape["unit"] = "mm";
  document.set("/particles/shapes/0", shape, "t");
  const double volume = 64e-9 / 6.0;
  EXPECT_NEAR(read_scene(document).particles.shapes[0].volume, volume, 1e-9 * volume);
}

TEST(SceneReader, ReportsTheFaultsOfAMeshWithItsOwnName) {
  const TemporaryFolder folder;
  Mesh open = tetrahedron();
  open.facets.pop_back();
  write_stl(folder / "open.stl", open);
  CaseDocument document = patched("{}");
  document.set("/particles/shapes/0", {{"mesh", (folder / "open.stl").string()}, {"spheres", 4}}, "t");
  const std::vector<std::string> faults = faults_of(document);
  ASSERT_FALSE(faults.empty());
  EXPECT_TRUE(faults[0].starts_with((folder / "open.stl").string() + ": ")) << faults[0];
}

TEST(SceneReader, ReadsAShapeOnceForAllScenesOfACache) {
  const TemporaryFolder folder;
  write_clump(folder / "ball.json", sphere_clump(0.004));
  CaseDocument document = patched("{}");
  document.set("/particles/shapes/0", {{"clump", (folder / "ball.json").string()}}, "t");
  ShapeCache shapes;
  Faults faults;
  const Scene first = read_scene(document, faults, shapes);
  write_clump(folder / "ball.json", sphere_clump(0.005));
  document.set("/particles/total_mass_kg", 0.7, "t");
  const Scene second = read_scene(document, faults, shapes);
  const Scene fresh = read_scene(document, faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(first.particles.total_mass, 1.5);
  EXPECT_EQ(second.particles.total_mass, 0.7);
  EXPECT_EQ(second.particles.shapes[0].spheres[0].radius, 0.004);
  EXPECT_EQ(fresh.particles.shapes[0].spheres[0].radius, 0.005);
}

}  // namespace
}  // namespace repose::test
