#include "engine/contact/contact_law.hpp"
#include "engine/contact/single.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "unit/contact/random_contact.hpp"

namespace repose::test {
namespace {

constexpr double kStep = 1e-6;

template <RollingModel kModel>
constexpr bool kHasTorque = kModel != RollingModel::type_a;

template <RollingModel kModel>
Numbers engine_numbers(const LawParameters& law, EngineContact<double> c) {
  const ContactForces<double> f =
      contact_forces<kModel>(law, c.geometry, relative_motion(c.geometry.n, c.i, c.j), {kStep}, c.history);
  return numbers_of(f, c.history, kHasTorque<kModel>);
}

template <RollingModel kModel>
std::array<Numbers, kSimdWidth> engine_numbers(const LawParameters& law, Block block) {
  EngineContact<SimdReal> c = to_lanes(block);
  const ContactForces<SimdReal> f =
      contact_forces<kModel>(law, c.geometry, relative_motion(c.geometry.n, c.i, c.j), {kStep}, c.history);
  const auto numbers = numbers_of(f, c.history, kHasTorque<kModel>);
  std::array<Numbers, kSimdWidth> lanes{};
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
    for (std::size_t k = 0; k < numbers.size(); ++k) lanes[lane][k] = numbers[k][lane];
  return lanes;
}

/// In the lane `lane` of a block in single precision; the other lanes hold the same contact.
template <RollingModel kModel>
Numbers single_numbers(const LawParameters& law, const EngineContact<double>& contact, std::size_t lane) {
  Block block;
  block.fill(contact);
  const EngineContact<SimdReal> wide = to_lanes(block);
  std::vector<SimdReal> values;
  EngineContact<SimdReal> source = wide;
  visit_numbers(source, [&](SimdReal& value) { values.push_back(value); });
  EngineContact<Single> c;
  std::size_t row = 0;
  visit_numbers(c, [&](Single& value) { value = Single(values[row], values[row]), ++row; });
  const ContactForces<Single> f =
      contact_forces<kModel>(law, c.geometry, relative_motion(c.geometry.n, c.i, c.j), {kStep}, c.history);
  const auto numbers = numbers_of(f, c.history, kHasTorque<kModel>);
  Numbers result{};
  for (std::size_t k = 0; k < numbers.size(); ++k)
    result[k] = lane < kSimdWidth ? numbers[k].template half<0>()[lane]
                                  : numbers[k].template half<1>()[lane - kSimdWidth];
  return result;
}

/// Largest difference of each group (force, torque, F_n, spring, radius, rolling spring) over the group's
/// size.
double worst_difference(const Numbers& a, const Numbers& b, const Numbers& size_of) {
  constexpr std::size_t kGroups[] = {0, 3, 6, 7, 10, 11, 14};
  double worst = 0.0;
  for (std::size_t g = 0; g + 1 < std::size(kGroups); ++g) {
    double difference = 0.0, size = 0.0;
    for (std::size_t k = kGroups[g]; k < kGroups[g + 1]; ++k) {
      difference = std::max(difference, std::abs(a[k] - b[k]));
      size = std::max(size, std::abs(size_of[k]));
    }
    if (difference > 0.0) worst = std::max(worst, difference / size);
  }
  return worst;
}

template <RollingModel kModel>
void compare_with_plain_law(bool single, double bar) {
  RandomStream random(7, static_cast<std::uint64_t>(kModel));
  int sliding = 0, unloading = 0;
  for (std::size_t k = 0; k < 4000; ++k) {
    const reference::ContactMaterial material = random_material(random, kModel);
    const RandomContact contact = random_contact(random, material);
    reference::PlainMemory memory = contact.memory;
    const reference::PlainForces plain =
        reference::plain_contact(material, contact.contact, contact.i, contact.j, kStep, memory);
    Numbers expected = numbers_of(plain, memory);
    const EngineContact<double> c = engine_contact(contact, kModel);
    const Numbers engine = single ? single_numbers<kModel>(law_of(material), c, k % (2 * kSimdWidth))
                                  : engine_numbers<kModel>(law_of(material), c);
    // What remains after a cancellation between elastic and damping parts is compared on the scale of the
    // parts: the elastic force, the velocity's own.
    Numbers scale = expected;
    const Vec3 v = contact.i.at_contact() - contact.j.at_contact();
    const double a = std::sqrt(contact.contact.R_eff * contact.contact.overlap);
    const double damping =
        2.0 * material.beta_clamped * std::sqrt(2.0 * material.Y_eff() * a * contact.contact.m_eff);
    const double part = std::max(damping, 8.0 * material.G_eff() * a * kStep) * v.norm() +
                        4.0 / 3.0 * material.Y_eff() * a * contact.contact.overlap;
    for (const std::size_t f : {0, 6}) scale[f] = std::max(std::abs(scale[f]), part);
    if (single)  // the torque's limit is of F_n, which may be what is left of its parts
      for (const std::size_t t : {3, 11})
        scale[t] = std::max(std::abs(scale[t]), material.rolling * contact.contact.R_eff * part);
    scale[7] =
        std::max(std::abs(scale[7]),
                 material.history == TangentialHistory::force ? part : part / (8.0 * material.G_eff() * a));
    ASSERT_LT(worst_difference(engine, expected, scale), bar) << "contact " << k;
    const double tangent = reference::tangent_part(plain.force, contact.contact.n).norm();
    sliding += tangent > 0.999 * material.friction * std::abs(plain.F_n);
    unloading += contact.memory.radius > a;
  }
  EXPECT_GT(sliding, 100);
  EXPECT_GT(unloading, 100);
}

TEST(ContactLaw, AgreesWithAPlainImplementation) {
  for (const bool single : {false, true}) {
    const double bar = single ? 1e-5 : 1e-11;  // some hundred times the rounding of a number
    compare_with_plain_law<RollingModel::type_a>(single, bar);
    compare_with_plain_law<RollingModel::type_a_relative>(single, bar);
    compare_with_plain_law<RollingModel::type_c>(single, bar);
    compare_with_plain_law<RollingModel::type_c_undamped>(single, bar);
  }
}

template <RollingModel kModel>
void compare_lanes() {
  RandomStream random(11, static_cast<std::uint64_t>(kModel));
  for (int k = 0; k < 500; ++k) {
    const reference::ContactMaterial material = random_material(random, kModel);
    const LawParameters law = law_of(material);
    Block block;
    for (auto& contact : block) contact = engine_contact(random_contact(random, material), kModel);
    const auto lanes = engine_numbers<kModel>(law, block);
    for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
      const Numbers single = engine_numbers<kModel>(law, block[lane]);
      // Fused multiplications may fall differently in the two compilations: a few roundings of the largest
      // part.
      ASSERT_LT(worst_difference(lanes[lane], single, single), 1e-9) << "contact " << k << " lane " << lane;
    }
    // The same contact in every other lane, among other neighbours: the same bits.
    constexpr std::size_t kReplaced = kSimdWidth - 1;
    Block turned;
    for (std::size_t lane = 0; lane < kSimdWidth; ++lane) turned[(lane + 3) % kSimdWidth] = block[lane];
    turned[(kReplaced + 3) % kSimdWidth] = engine_contact(random_contact(random, material), kModel);
    const auto moved = engine_numbers<kModel>(law, turned);
    for (std::size_t lane = 0; lane < kSimdWidth; ++lane) {
      if (lane == kReplaced) continue;
      const Numbers& there = moved[(lane + 3) % kSimdWidth];
      ASSERT_EQ(std::memcmp(there.data(), lanes[lane].data(), sizeof(Numbers)), 0) << "contact " << k;
    }
  }
}

TEST(ContactLaw, GivesEveryLaneWhatItGivesOneContactWhateverItsNeighbours) {
  compare_lanes<RollingModel::type_a>();
  compare_lanes<RollingModel::type_a_relative>();
  compare_lanes<RollingModel::type_c>();
  compare_lanes<RollingModel::type_c_undamped>();
}

TEST(ContactLaw, IsFiniteWithoutFrictionRollingMotionOrRestitution) {
  RandomStream random(3, 1);
  for (const double e : {0.0, 1.0})
    for (const auto damping : {NormalDamping::with_tail, NormalDamping::clamped})
      for (const auto history : {TangentialHistory::force, TangentialHistory::displacement}) {
        reference::ContactMaterial material = random_material(random, RollingModel::type_c);
        material.e = e;
        material.friction = material.rolling = 0.0;
        material.damping = damping;
        material.history = history;
        RandomContact contact = random_contact(random, material);
        contact.memory = {};
        for (const double speed : {0.0, 1.0}) {
          for (auto* side : {&contact.i, &contact.j}) side->velocity *= speed, side->w *= speed;
          for (const double overlap : {contact.contact.overlap, 1e-300, 0.0}) {
            contact.contact.overlap = overlap;
            const EngineContact<double> c = engine_contact(contact, RollingModel::type_c);
            for (const double x : engine_numbers<RollingModel::type_c>(law_of(material), c))
              EXPECT_TRUE(std::isfinite(x));
            for (const double x : engine_numbers<RollingModel::type_a_relative>(law_of(material), c))
              EXPECT_TRUE(std::isfinite(x));
          }
        }
      }
}

TEST(ContactLaw, IsTheSameInEveryInertialFrameAndDirection) {
  // Turned, moved and boosted, a contact gives the turned force, torque and history. Bar 1e-9; met to 1e-11,
  // which is rounding of a boost of 100 times the contact's own speed.
  RandomStream random(5, 2);
  for (int k = 0; k < 300; ++k) {
    const reference::ContactMaterial material = random_material(random, RollingModel::type_c);
    const LawParameters law = law_of(material);
    RandomContact contact = random_contact(random, material);
    contact.i.velocity *= 1.0 / (1e-6 + contact.i.velocity.norm());
    contact.j.velocity *= 0.5 / (1e-6 + contact.j.velocity.norm());
    const Numbers here =
        engine_numbers<RollingModel::type_c>(law, engine_contact(contact, RollingModel::type_c));
    const Quat turn = random.rotation();
    const Vec3 boost = random_vector(random, 10.0);
    RandomContact there = contact;
    for (auto* v : {&there.contact.n, &there.i.velocity, &there.i.w, &there.i.arm, &there.j.velocity,
                    &there.j.w, &there.j.arm, &there.memory.spring, &there.memory.rolling})
      *v = turn * *v;
    there.i.velocity += boost;
    there.j.velocity += boost;
    Numbers seen = engine_numbers<RollingModel::type_c>(law, engine_contact(there, RollingModel::type_c));
    for (const std::size_t at : {0, 3, 7, 11}) {
      const Vec3 back = turn.conjugate() * Vec3(seen[at], seen[at + 1], seen[at + 2]);
      seen[at] = back.x(), seen[at + 1] = back.y(), seen[at + 2] = back.z();
    }
    ASSERT_LT(worst_difference(seen, here, here), 1e-9) << k;
  }
}

}  // namespace
}  // namespace repose::test
