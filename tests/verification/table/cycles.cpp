#include "engine/base/random.hpp"
#include "support/led_contact.hpp"
#include "support/test_scene.hpp"
#include "verification/table/row.hpp"

namespace repose::verification {

namespace {

constexpr double kCycleBar = 1e-9;
constexpr const char* kCycleSource = "Mindlin & Deresiewicz 1953; Thornton & Randall 1988";

LawParameters elastic_law(double friction) {
  const ElasticSide side{1e9, 0.3};
  return law_parameters(side, side, 1.0, friction, 0.0, 0.0, NormalDamping::with_tail,
                        TangentialHistory::force);
}

/// A random closed path of loading, unloading, sticking and sliding, with the contact's plane turned on the
/// way if asked; returns work/Σ|work| and keeps the forces at its corners.
double closed_path(RandomStream& random, test::LedContact& contact, bool turned, std::vector<Vec3>& forces) {
  double work = 0.0;
  const int corners = 3 + static_cast<int>(random.below(5));
  for (int k = 0; k < corners; ++k) {
    const double overlap = 1e-5 * std::pow(10.0, random.uniform(-1.5, 0.0));
    work += contact.lead(overlap, {random.uniform(-5e-6, 5e-6), random.uniform(-5e-6, 5e-6), 0.0}, 800);
    forces.push_back(contact.force());
    const Vec3 axis(random.normal(), random.normal(), random.normal());
    if (turned) contact.turn(axis, random.uniform(0.0, 3.0), 400);
  }
  work += contact.lead(0.0, Vec3::Zero(), 800);
  return work / contact.spent();
}

/// Two clumps that hit, stick and slide: what they do to each other is the same where all is turned, moved
/// and boosted. Gravity, which both share, is not in their relative motion.
Row collision_in_two_frames() {
  Worst worst("collisions of two clumps turned, moved and boosted: relative motion and spins",
              "the same in every frame", kCycleBar);
  for (std::uint64_t collision = 0; collision < 20; ++collision) {
    const auto run = [&](const Quat& turn, const Vec3& moved, const Vec3& boost) {
      RandomStream random(17, collision);
      const std::vector<Clump> shapes{test::random_clump(random, 4, 5e-3),
                                      test::random_clump(random, 3, 5e-3)};
      Simulation simulation(test::scene_of(shapes, test::kGlass, {0.6, 0.4, 0.2}, RollingModel::type_c),
                            5e-6);
      const double side = random.uniform(-0.002, 0.002);
      for (int k = 0; k < 2; ++k) {
        NewBody body;
        body.shape = k;
        body.position = moved + turn * Vec3(0.013 * k, side * k, 0.0);
        body.orientation = turn * random.rotation();
        body.velocity =
            boost + turn * Vec3(k == 0 ? 0.5 : -0.5, 0.1 * random.normal(), 0.1 * random.normal());
        body.angular_velocity = turn * Vec3(random.normal(), random.normal(), random.normal()) * 20.0;
        simulation.add(body);
      }
      bool hit = false;
      for (int k = 0; k < 2000; ++k) {
        simulation.step();
        hit = hit || simulation.touching_another()[0] != 0;
      }
      const Bodies& b = simulation.bodies();
      const Quat back = turn.conjugate();
      std::vector<Vec3> seen{back * (b.position(1) - b.position(0)), back * (b.velocity(1) - b.velocity(0)),
                             back * b.angular_velocity(0), back * b.angular_velocity(1)};
      if (!hit) seen.front().setConstant(std::nan(""));  // a test of nothing is a missed one
      return seen;
    };
    RandomStream choice(19, collision);
    const auto vector = [&] { return Vec3(choice.normal(), choice.normal(), choice.normal()); };
    const Quat turn = choice.rotation();
    const Vec3 moved = 0.1 * vector(), boost = vector();
    const std::vector<Vec3> here = run(Quat::Identity(), Vec3::Zero(), Vec3::Zero()),
                            there = run(turn, moved, boost);
    for (std::size_t k = 0; k < here.size(); ++k)
      worst.add(here[k].norm(), here[k].norm() + (there[k] - here[k]).norm());
  }
  return worst.row();
}

}  // namespace

Rows cycle_rows() {
  Worst still("300 closed Mindlin cycles: energy created over the work", kCycleSource, kCycleBar);
  Worst turned("300 closed Mindlin cycles in a turning plane: energy created over the work", kCycleSource,
               kCycleBar);
  Worst frame("the same cycles turned and boosted: forces", "the same in every frame", kCycleBar);
  for (std::uint64_t path = 0; path < 300; ++path) {
    RandomStream choice(11, path);
    const LawParameters law = elastic_law(choice.uniform(0.05, 2.0));
    const Quat rotation = choice.rotation();
    const Vec3 boost = 1e-6 * Vec3(choice.normal(), choice.normal(), choice.normal());
    for (const bool turn : {false, true}) {
      std::vector<Vec3> here, there;
      RandomStream one(13, path), two(13, path);
      test::LedContact contact(law), elsewhere(law, rotation, boost);
      const double work = closed_path(one, contact, turn, here);
      (turn ? turned : still).add(0.0, std::min(work, 0.0), 1.0);
      closed_path(two, elsewhere, turn, there);
      for (std::size_t k = 0; k < here.size(); ++k)
        frame.add(here[k].norm(), here[k].norm() + (there[k] - here[k]).norm());
    }
  }
  return {still.row(), turned.row(), frame.row(), collision_in_two_frames()};
}

}  // namespace repose::verification
