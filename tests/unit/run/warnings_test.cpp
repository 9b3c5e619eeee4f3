// Every way in which a method leaves the range where it works, provoked: each ends with a named outcome or
// warning.

#include "engine/run/warnings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/run/run.hpp"
#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

bool has(const std::vector<Warning>& warnings, const std::string& name) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const Warning& warning) { return warning.name == name; });
}
std::string names_of(const std::vector<Warning>& warnings) {
  std::string names;
  for (const Warning& warning : warnings) names += warning.name + " ";
  return names;
}
std::string text_of(const std::vector<Warning>& warnings, const std::string& name) {
  for (const Warning& warning : warnings)
    if (warning.name == name) return warning.text;
  return "no warning " + name;
}

// --- of the scene alone ----------------------------------------------------------------------------------

TEST(SceneWarnings, NoneForASoundScene) { EXPECT_EQ(names_of(scene_warnings(sound_scene())), ""); }

TEST(SceneWarnings, FrictionAboveOneIsNamedWithItsValueAndPlace) {
  Scene scene = sound_scene();
  scene.contact.particle_particle.static_friction = 1.0;
  EXPECT_FALSE(has(scene_warnings(scene), "high_friction"));
  scene.contact.particle_particle.static_friction = 1.5;
  scene.contact.particle_wall.rolling_friction = 2.0;
  const std::string text = text_of(scene_warnings(scene), "high_friction");
  EXPECT_NE(text.find("μs = 1.5 between particles"), std::string::npos) << text;
  EXPECT_NE(text.find("μr = 2 between particle and wall"), std::string::npos) << text;
}

TEST(SceneWarnings, FrictionOfZeroAndRestitutionOfZeroAndOne) {
  Scene scene = sound_scene();
  scene.contact.particle_particle = {0.0, 0.0, 0.0};
  scene.contact.particle_wall = {1.0, 0.5, 0.0};
  EXPECT_EQ(names_of(scene_warnings(scene)),
            "no_friction no_rolling_friction no_restitution full_restitution ");
}

TEST(SceneWarnings, ATinySphereOfAClump) {
  Scene scene = sound_scene();
  const double r = 2e-3;
  scene.particles.shapes = {summed_clump({{Vec3::Zero(), r}, {Vec3(r, 0.0, 0.0), 0.2 * r}})};
  EXPECT_FALSE(has(scene_warnings(scene), "tiny_sphere"));
  scene.particles.shapes = {summed_clump({{Vec3::Zero(), r}, {Vec3(r, 0.0, 0.0), 0.05 * r}})};
  EXPECT_NE(text_of(scene_warnings(scene), "tiny_sphere").find("0.05 times"), std::string::npos);
}

TEST(SceneWarnings, SpheresThatOthersCanPassBetween) {
  Scene scene = sound_scene();
  const double r = 2e-3;
  const auto dumbbell = [r](double gap) {
    return summed_clump({{Vec3::Zero(), r}, {Vec3((2.0 + gap) * r, 0.0, 0.0), r}});
  };
  scene.particles.shapes = {dumbbell(0.09)};
  EXPECT_FALSE(has(scene_warnings(scene), "loose_spheres"));
  scene.particles.shapes = {dumbbell(0.09), dumbbell(0.5)};
  EXPECT_NE(text_of(scene_warnings(scene), "loose_spheres").find("2 groups"), std::string::npos);
}

TEST(SceneWarnings, ASizeRatioOfTwenty) {
  Scene scene = sound_scene();
  const auto class_of = [](double diameter) {
    const double volume = kPi / 6.0 * diameter * diameter * diameter;
    return SizeClass{volume, volume, 0.5};
  };
  scene.particles.size_classes = {class_of(5e-4), class_of(4.9e-3)};
  EXPECT_FALSE(has(scene_warnings(scene), "size_ratio"));
  scene.particles.size_classes = {class_of(5e-4), class_of(1e-2)};
  EXPECT_NE(text_of(scene_warnings(scene), "size_ratio").find("ratio of 20.0"), std::string::npos);
}

TEST(SceneWarnings, WallsThatMoveByATenthOfARadiusInAStep) {
  Scene scene = sound_scene();
  scene.numerics.time_step_fraction.reset();
  scene.numerics.time_step = 1e-5;
  scene.test.opening_speed = 19.0;  // 0.19 of the 0.2 mm
  EXPECT_FALSE(has(scene_warnings(scene), "coarse_opening"));
  scene.test.opening_speed = 21.0;
  EXPECT_TRUE(has(scene_warnings(scene), "coarse_opening"));
}

// --- of the run ------------------------------------------------------------------------------------------

TEST(RunWarnings, ASoundRunOfFewParticlesSaysOnlyThatItsHeapIsFlat) {
  const RunResult result = run_slump_test(sound_scene(), 1);
  ASSERT_EQ(result.outcome, Outcome::completed) << result.reason;
  EXPECT_EQ(names_of(result.warnings), "flat_heap ");
  EXPECT_TRUE(result.reason.empty());
  EXPECT_TRUE(result.responses.reaches_edge);
  EXPECT_GT(result.responses.mass_lost, 0.0);
}

TEST(RunWarnings, AHeapOfAHundredBodiesIsOfFewParticlesWithItsError) {
  Scene scene = sound_scene();
  scene.particles.total_mass = 0.012;
  const RunResult result = run_slump_test(scene, 2);
  ASSERT_TRUE(result.outcome == Outcome::completed || result.outcome == Outcome::unreadable) << result.reason;
  if (result.outcome == Outcome::completed) {
    EXPECT_NE(text_of(result.warnings, "few_particles").find("±"), std::string::npos)
        << names_of(result.warnings);
  }
}

TEST(RunWarnings, AHandfulOfBodiesIsNoHeap) {
  Scene scene = sound_scene();
  scene.particles.total_mass = 0.001;
  const RunResult result = run_slump_test(scene, 1);
  EXPECT_EQ(result.outcome, Outcome::no_heap);
  EXPECT_FALSE(result.reason.empty());
}

TEST(RunWarnings, AHeapOnAWideBaseStopsShortOfItsEdgeAndLosesNothing) {
  Scene scene = sound_scene();
  scene.test.base_radius = 0.3;
  const RunResult result = run_slump_test(scene, 1);
  EXPECT_FALSE(result.responses.reaches_edge);
  EXPECT_NEAR(result.responses.mass_lost, 0.0, 0.001 * scene.particles.total_mass);
}

TEST(RunWarnings, ASlowOpeningAndAFastOne) {
  Scene scene = sound_scene();  // the column is 28 mm high, √(g h) = 0.52 m/s
  for (const auto& [speed, name] : std::vector<std::pair<double, std::string>>{
           {0.15, "slow_opening"}, {0.3, ""}, {2.0, ""}, {3.0, "fast_opening"}}) {
    scene.test.opening_speed = speed;
    const RunResult result = run_slump_test(scene, 1);
    for (const char* either : {"slow_opening", "fast_opening"})
      EXPECT_EQ(has(result.warnings, either), either == name) << speed << " " << names_of(result.warnings);
  }
}

/// Thirty times softer the column is 10 % denser and is warned of, a hundred times it is 20 % denser and no
/// column of these particles: density against the stiff one, measured here; 6 points are five deviations of
/// one packing's.
TEST(RunWarnings, SoftContactsAreWarnedOfAndThenRefused) {
  Scene scene = sound_scene();
  scene.numerics.time_step_fraction = 0.1;
  const double density = run_slump_test(scene, 1).responses.bulk_density;
  scene.numerics.stiffness_scale = 0.03;
  const RunResult soft = run_slump_test(scene, 1);
  EXPECT_TRUE(has(soft.warnings, "soft_contacts")) << names_of(soft.warnings);
  if (soft.outcome == Outcome::completed) {
    EXPECT_NEAR(soft.responses.bulk_density / density - 1.0, 0.1, 0.06);
  }
  scene.numerics.stiffness_scale = 0.01;
  EXPECT_EQ(run_slump_test(scene, 1).outcome, Outcome::overlapping);
}

// --- steps from slightly to grossly too large ------------------------------------------------------------

TEST(LargeSteps, AreWarnedOfThenUnstableThenThroughTheWallsAndNeverGiveAnAngle) {
  Scene scene = sound_scene();
  scene.numerics.stage_time_limit = 0.7;
  std::string before;
  for (const double fraction : {0.5, 0.52, 0.55, 1.0, 3.0, 30.0, 1000.0, 1e7}) {
    scene.numerics.time_step_fraction = fraction;
    const RunResult result = run_slump_test(scene, 1);
    EXPECT_NE(result.outcome, Outcome::completed) << fraction;
    EXPECT_FALSE(result.reason.empty());
    const std::set<Outcome> named{Outcome::unstable, Outcome::escaped, Outcome::diverged};
    EXPECT_TRUE(named.contains(result.outcome)) << fraction << " " << name_of(result.outcome);
    before += std::string(name_of(result.outcome)) + " ";
  }
  EXPECT_NE(before.find("unstable"), std::string::npos) << before;
  EXPECT_NE(before.find("escaped"), std::string::npos) << before;

  // Slightly too large: over the bar of the stability number for certain, and of what the ledger says by the
  // seed.
  int energy_errors = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    scene.numerics.time_step_fraction = 0.42;
    const RunResult slightly = run_slump_test(scene, seed);
    EXPECT_TRUE(has(slightly.warnings, "coarse_step")) << names_of(slightly.warnings);
    energy_errors += has(slightly.warnings, "energy_error") ? 1 : 0;
  }
  EXPECT_GE(energy_errors, 2);
}

/// Type A stops spin in the step in which contacts give it, and nothing is lost by that: the ledger is off by
/// the other errors of first order in the step, −2.5 to −2.9 % here. (Booked as a loss it was +8 %, and the
/// article's test with clumps of 8 ended `unstable`.)
TEST(LargeSteps, KeepTheLedgerClosedWhereTypeAHoldsTheHeap) {
  Scene scene = sound_scene();
  scene.contact.particle_particle = {0.3, 0.8, 0.3};
  for (const std::uint64_t seed : {1, 2, 3}) {
    const RunResult result = run_slump_test(scene, seed);
    EXPECT_EQ(result.outcome, Outcome::completed) << result.reason;
    EXPECT_LT(std::abs(result.energy.relative_imbalance()), 0.04) << seed;
  }
}

/// A heap that looks well (17°, overlaps as always) in which each contact that sticks makes energy: only the
/// ledger sees.
TEST(LargeSteps, ArePickedUpByTheLedgerWhereFrictionAboveOneHoldsContactsTogether) {
  Scene scene = sound_scene();
  scene.contact.particle_particle.static_friction = 1.5;
  EXPECT_EQ(run_slump_test(scene, 1).outcome, Outcome::completed);
  scene.numerics.time_step_fraction = 0.35;
  const RunResult result = run_slump_test(scene, 1);
  EXPECT_EQ(result.outcome, Outcome::unstable) << result.energy.relative_imbalance();
  EXPECT_TRUE(has(result.warnings, "coarse_step")) << result.motion.stability_number;
}

// --- limits of the contact law ---------------------------------------------------------------------------

TEST(LimitsOfTheLaw, WithoutDampingAndFrictionNothingRestsAndTheReasonSaysWhatIsMissing) {
  Scene scene = sound_scene();
  scene.contact.particle_particle = scene.contact.particle_wall = {1.0, 0.0, 0.0};
  scene.particles.total_mass = 0.005;  // 60 bodies without a throw, so that few leap over the rim
  scene.test.pour_speed = 0.0;
  scene.numerics.stage_time_limit = 0.3;
  scene.numerics.time_step_fraction = 0.1;
  const RunResult result = run_slump_test(scene, 1);
  EXPECT_EQ(result.outcome, Outcome::timed_out) << result.reason;
  EXPECT_NE(result.reason.find("nothing brakes"), std::string::npos) << result.reason;
  EXPECT_TRUE(has(result.warnings, "full_restitution"));
  EXPECT_TRUE(has(result.warnings, "spilled")) << "what leaps over the rim is counted";
}

TEST(LimitsOfTheLaw, WithoutFrictionThereIsNoHeap) {
  Scene scene = sound_scene();
  scene.contact.particle_particle = scene.contact.particle_wall = {0.3, 0.0, 0.0};
  const RunResult result = run_slump_test(scene, 1);
  EXPECT_TRUE(result.outcome == Outcome::no_heap || result.outcome == Outcome::timed_out)
      << name_of(result.outcome);
  EXPECT_TRUE(has(result.warnings, "no_friction"));
}

TEST(LimitsOfTheLaw, RestitutionOfZeroNeedsASmallStepAndThenGivesAHeap) {
  Scene scene = sound_scene();
  scene.contact.particle_particle.restitution = scene.contact.particle_wall.restitution = 0.0;
  scene.numerics.time_step_fraction = 0.3;
  EXPECT_NE(run_slump_test(scene, 1).outcome, Outcome::completed);
  scene.numerics.time_step_fraction = 0.1;
  const RunResult result = run_slump_test(scene, 1);
  EXPECT_EQ(result.outcome, Outcome::completed) << result.reason;
  EXPECT_TRUE(has(result.warnings, "no_restitution"));
}

/// The torque of type_a_relative is limited by the last step's contacts only: a heap of it keeps about 1e-5 m
/// g d, and wavers by factors of ten; to the limit that is asked for here it would have to fall by a hundred
/// in every quarter.
TEST(LimitsOfTheLaw, AFloorOfTheEnergyIsCalledJitter) {
  Scene scene = sound_scene();
  scene.contact.rolling_model = RollingModel::type_a_relative;
  scene.numerics.rest_energy_ratio = 1e-15;
  scene.numerics.stage_time_limit = 1.0;
  const RunResult result = run_slump_test(scene, 1);
  EXPECT_EQ(result.outcome, Outcome::timed_out);
  EXPECT_TRUE(has(result.warnings, "jitter")) << result.reason;
  EXPECT_NE(result.reason.find("rotation"), std::string::npos) << result.reason;
}

/// Without its limit type A's torque turns the bodies back and forth at every step: at μr = 1 it gives more
/// energy than it takes, at a step that is sound with the limit. How fast is a matter of the seed.
TEST(LimitsOfTheLaw, TypeAWithoutTheTorqueLimitMakesEnergyWhereItIsStrong) {
  Scene scene = sound_scene();
  scene.contact.particle_particle.rolling_friction = scene.contact.particle_wall.rolling_friction = 1.0;
  const RunResult limited = run_slump_test(scene, 1);
  EXPECT_NE(limited.outcome, Outcome::unstable) << limited.reason;
  EXPECT_FALSE(has(limited.warnings, "energy_error")) << limited.energy.relative_imbalance();
  scene.contact.rolling_torque = RollingTorque::unlimited;
  int unstable = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const RunResult result = run_slump_test(scene, seed);
    EXPECT_TRUE(has(result.warnings, "energy_error")) << seed << " " << result.energy.relative_imbalance();
    if (result.outcome != Outcome::unstable) continue;
    ++unstable;
    EXPECT_NE(result.reason.find("unlimited"), std::string::npos) << result.reason;
  }
  EXPECT_GE(unstable, 1);
}

TEST(LimitsOfTheTest, ACylinderThatIsTooSmallIsOverfull) {
  Scene scene = sound_scene();
  scene.contact.rolling_model = RollingModel::type_c;
  scene.particles.total_mass = 0.15;  // 0.6 of the cylinder's volume is 0.127 kg
  const RunResult full = run_slump_test(scene, 1);
  EXPECT_EQ(full.outcome, Outcome::overfull) << full.reason;
  EXPECT_NE(full.reason.find("found room"), std::string::npos) << full.reason;
  scene.particles.total_mass = 0.2;  // 0.94 of it
  const RunResult hopeless = run_slump_test(scene, 1);
  EXPECT_EQ(hopeless.outcome, Outcome::overfull);
  EXPECT_NE(hopeless.reason.find("94 %"), std::string::npos) << hopeless.reason;
  EXPECT_EQ(hopeless.cost.steps, 0);
}

}  // namespace
}  // namespace repose::test
