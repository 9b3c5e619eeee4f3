#include "engine/base/random.hpp"
#include "support/led_contact.hpp"
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
  return {still.row(), turned.row(), frame.row()};
}

}  // namespace repose::verification
