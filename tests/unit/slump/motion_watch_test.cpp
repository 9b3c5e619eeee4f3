#include "engine/slump/motion_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/slump/energy_floor.hpp"
#include "unit/slump/tiny_scene.hpp"

namespace repose::test {
namespace {

/// Outcome of one look at a resting sphere of 5 mm that is put where the test says; no outcome: `completed`.
class Placed {
 public:
  Placed(Scene scene, const NewBody& body)
      : scene_(std::move(scene)), simulation_(scene_, 1e-5), watch_(scene_) {
    simulation_.add(body);
  }
  Outcome outcome() const {
    const auto verdict = watch_.check_bodies(simulation_);
    return verdict ? verdict->outcome : Outcome::completed;
  }
  std::string reason() const { return watch_.check_bodies(simulation_)->reason; }
  bool spilled() const { return watch_.spilled(simulation_.bodies(), 0); }
  void open() { watch_.open(); }

 private:
  Scene scene_;
  Simulation simulation_;
  MotionWatch watch_;
};

NewBody at(double x, double y, double z) {
  NewBody body;
  body.position = {x, y, z};
  return body;
}

TEST(MotionWatch, FindsABodyThatWentThroughTheCylinder) {
  EXPECT_EQ(Placed(tiny_scene(), at(0.02, 0.0, 0.05)).outcome(), Outcome::completed);
  Placed through(tiny_scene(), at(0.0, -0.031, 0.05));
  EXPECT_EQ(through.outcome(), Outcome::escaped);
  EXPECT_NE(through.reason().find("1 through the cylinder"), std::string::npos) << through.reason();
  EXPECT_NE(through.reason().find("y = -31.0"), std::string::npos) << through.reason();
  through.open();
  EXPECT_EQ(through.outcome(), Outcome::completed)
      << "after the opening bodies may be anywhere above the base";
}

TEST(MotionWatch, FindsABodyThatWentThroughTheBaseButNotOneThatFellOverItsEdge) {
  Placed inside(tiny_scene(), at(0.02, 0.0, -0.001));
  EXPECT_EQ(inside.outcome(), Outcome::escaped);
  EXPECT_NE(inside.reason().find("1 bodies went through the base"), std::string::npos) << inside.reason();
  Placed over(tiny_scene(), at(0.0651, 0.0, -0.001));  // the base's radius and the sphere's, 60 + 5 mm
  over.open();
  EXPECT_EQ(over.outcome(), Outcome::completed);
  Scene plane = tiny_scene();
  plane.test.base_radius = std::numeric_limits<double>::infinity();
  Placed below(plane, at(5.0, 0.0, -0.001));
  below.open();
  EXPECT_EQ(below.outcome(), Outcome::escaped);
}

TEST(MotionWatch, ABodyOverTheRimHasSpilledAndIsNoEscape) {
  Placed over(tiny_scene(), at(0.031, 0.0, 0.125));
  EXPECT_TRUE(over.spilled());
  EXPECT_EQ(over.outcome(), Outcome::completed);
  EXPECT_FALSE(Placed(tiny_scene(), at(0.02, 0.0, 0.125)).spilled()) << "still above the opening";
  over.open();
  EXPECT_FALSE(over.spilled());
}

TEST(MotionWatch, FindsANumberThatIsNotFiniteWhereverItIs) {
  const double nan = std::nan("");
  NewBody position = at(nan, 0.0, 0.05), velocity = at(0.0, 0.0, 0.05), spin = at(0.0, 0.0, 0.05),
          turn = at(0.0, 0.0, 0.05);
  velocity.velocity.y() = nan;
  spin.angular_velocity.z() = std::numeric_limits<double>::infinity();
  for (const NewBody& body : {position, velocity, spin})
    EXPECT_EQ(Placed(tiny_scene(), body).outcome(), Outcome::diverged);
  turn.orientation = Quat(nan, 0.0, 0.0, 1.0);
  turn.angular_velocity = {1.0, 0.0, 0.0};
  EXPECT_EQ(Placed(tiny_scene(), turn).outcome(), Outcome::diverged);
}

TEST(MotionWatch, FindsALedgerThatDoesNotClose) {
  MotionDiagnosis diagnosis;
  diagnosis.energy_imbalance = 0.24;
  EXPECT_FALSE(judge(diagnosis, 1.0, 1e-5));
  for (const double off : {0.26, -0.26, std::nan("")}) {
    diagnosis.energy_imbalance = off;
    const auto verdict = judge(diagnosis, 1.0, 1e-5);
    ASSERT_TRUE(verdict) << off;
    EXPECT_EQ(verdict->outcome, Outcome::unstable);
  }
  EXPECT_NE(judge({.energy_imbalance = 0.5}, 1.0, 1e-5)->reason.find("+50 %"), std::string::npos);
}

TEST(MotionWatch, FindsAColumnOfParticlesInOneAnother) {
  EXPECT_FALSE(judge({.column_overlap_ratio = 0.029}, 1.0, 1e-5));
  EXPECT_EQ(judge({.column_overlap_ratio = 0.031}, 1.0, 1e-5)->outcome, Outcome::overlapping);
  EXPECT_EQ(judge({.column_overlap_ratio = std::nan("")}, 1.0, 1e-5)->outcome, Outcome::overlapping);
}

/// A sphere that lies on the base of equal material: G* = G/(2 (2 − ν)), Y* = G/(1 − ν), R* = r, and the
/// contact bears its weight, δ = (3 m g/(4 Y* √r))^{2/3}.
TEST(MotionWatch, StabilityNumberOfASphereOnTheBaseIsThatOfItsTwoSprings) {
  Scene scene = tiny_scene();
  scene.numerics.stiffness_scale = 1.0;
  scene.contact.particle_wall.restitution = 1.0;  // no damping
  const double r = 5e-3, m = 2500.0 * 4.0 / 3.0 * kPi * r * r * r, G = 1e8, nu = 0.25;
  const double Y_eff = G / (1.0 - nu), G_eff = G / (2.0 * (2.0 - nu));
  const double overlap = std::pow(3.0 * m * kGravity / (4.0 * Y_eff * std::sqrt(r)), 2.0 / 3.0);
  const double dt = 1e-6, a = std::sqrt(r * overlap);
  Simulation simulation(scene, dt);
  simulation.walls = {floor_wall()};
  simulation.add(at(0.0, 0.0, r - overlap));
  ASSERT_TRUE(simulation.step());
  MotionWatch watch(scene);
  EXPECT_FALSE(watch.check_contacts(simulation));
  // Sliding turns the sphere too: k_t (1/m + r²/I) = 7/2 k_t/m, for an arm r − δ/2; here it exceeds k_n/m.
  const double arm = r - 0.5 * overlap;
  const double tangential = 8.0 * G_eff * a * (1.0 / m + arm * arm / (0.4 * m * r * r));
  ASSERT_GT(tangential, 2.0 * Y_eff * a / m);
  EXPECT_NEAR(watch.diagnosis().stability_number, 0.25 * dt * dt * tangential, 1e-9 * dt * dt * tangential);
  EXPECT_NEAR(watch.diagnosis().stiffest, tangential, 1e-9 * tangential);
  EXPECT_NEAR(watch.diagnosis().largest_overlap_ratio, overlap / r, 1e-9);
}

/// Of e^(−20 t), t the share of the stage, the last quarter holds 6e-8 in the mean: to 1e-9 it takes another
/// e^−4, less than a quarter at e^−5 each. At e^(−2 t) it takes ln(0.17/1e-5)/0.5, 20 quarters.
TEST(EnergyFloor, IsWhatWouldNotReachTheLimitInTheSameTimeAgain) {
  const auto floor_of = [](auto ratio_at, double limit = 1e-9) {
    EnergyFloor floor;
    for (int k = 0; k <= 1000; ++k) floor.add(1e-3 * k, {ratio_at(1e-3 * k), 0.75});
    return floor.level(limit);
  };
  EXPECT_FALSE(floor_of([](double share) { return std::exp(-20.0 * share); }));
  const auto slow = [](double share) { return std::exp(-2.0 * share); };
  EXPECT_TRUE(floor_of(slow, 1e-5));
  EXPECT_FALSE(floor_of(slow, 0.1)) << "one quarter more";
  const auto level = floor_of([](double share) { return 1e-6 + std::exp(-50.0 * share); });
  ASSERT_TRUE(level);
  EXPECT_NEAR(level->ratio, 1e-6, 1e-9);
  EXPECT_NEAR(level->rotation, 0.75, 1e-9);
}

}  // namespace
}  // namespace repose::test
