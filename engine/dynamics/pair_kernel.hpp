#pragma once

#include <bit>

#include "engine/dynamics/contact_block.hpp"
#include "engine/dynamics/force_kernels.hpp"

namespace repose {

/// First pass: which near candidates touch.
inline void find_touching(ForceKernels::Placed placed, NearList& near, TouchingList& touching) {
  const double* record = placed.data()->centre;
  touching.start(near.count);
  for (std::size_t block = 0; block < near.blocks(); ++block) {
    unsigned mask = 0;
    for (std::size_t part = 0; part < NearList::kBlock; part += kSimdWidth) {
      const std::size_t first = block * NearList::kBlock + part;
      const Fields4 a = load_fields4(record, near.placed_a.data() + first),
                    b = load_fields4(record, near.placed_b.data() + first);
      const SimdReal dx = a[0] - b[0], dy = a[1] - b[1], dz = a[2] - b[2], reach = a[3] + b[3];
      mask |= less_bits(dx * dx + dy * dy + dz * dz, reach * reach) << part;
    }
    mark_touching(near, block, mask);
    touching.take(near, block, mask);
  }
  touching.finish();
}

/// RollingContact::inertia_or_limit of a pair under type_c: I_r = 1/Σ 1/(I + m |arm|²).
template <class T>
REPOSE_INLINE T inertia_about_contact(const BlockSide<T>& i, const BlockSide<T>& j, const Triple<T>& arm_i,
                                      const Triple<T>& arm_j) {
  const T about_i = i.inertia_term + i.mass * dot(arm_i, arm_i);
  const T about_j = j.inertia_term + j.mass * dot(arm_j, arm_j);
  return about_i * about_j / (about_i + about_j);
}

/// n, δ, R*, m*, 1/m* and, under type_a_relative, 1/(Δt Σ n/I_min): the torque per spin of which all contacts
/// of a body together at most stop it within a step. Their five divisions are one, by the product of all
/// denominators: the others are products of what is left of it.
template <RollingModel kModel>
REPOSE_INLINE ContactGeometry<SimdReal> pair_geometry(const BlockSide<SimdReal>& i,
                                                      const BlockSide<SimdReal>& j, double dt) {
  const Triple<SimdReal> d = i.centre - j.centre;
  const SimdReal distance = length(d), reach = i.radius + j.radius;
  const SimdReal mass = i.mass + j.mass, masses = i.mass * j.mass;
  ContactGeometry<SimdReal> contact;
  contact.overlap = reach - distance;
  contact.inertia_or_limit = 0.0;
  const SimdReal lengths = distance * reach, inertia = mass * masses;
  SimdReal inverse;
  if constexpr (kModel == RollingModel::type_a_relative) {
    const SimdReal softness = dt * (i.inertia_term + j.inertia_term);
    const SimdReal of_all = 1.0 / (lengths * inertia * softness);
    contact.inertia_or_limit = of_all * (lengths * inertia);
    inverse = of_all * softness;
  } else {
    inverse = 1.0 / (lengths * inertia);
  }
  const SimdReal of_lengths = inverse * inertia, of_masses = inverse * lengths;
  contact.n = SimdReal(of_lengths * reach) * d;
  contact.R_eff = i.radius * j.radius * (of_lengths * distance);
  contact.m_eff = masses * masses * of_masses;
  contact.inverse_m_eff = mass * mass * of_masses;
  return contact;
}

/// The same in single precision. Of two radii and a distance of millimetres that are rounded to 6e-8 an
/// overlap of a micrometre would be known to 1e-4; so it is taken as
///   δ = ((R_i + R_j)² − |d|²) / (R_i + R_j + |d|)
/// with the difference in doubles.
template <RollingModel kModel>
REPOSE_INLINE ContactGeometry<Single> pair_geometry(const BlockSide<Single>& i, const BlockSide<Single>& j,
                                                    double dt) {
  const Triple<Twin> apart = i.centre - j.centre;
  const Twin wide_reach = i.wide_radius + j.wide_radius;
  const Triple<Single> d = narrow<Single>(apart);
  const Single distance = length(d), reach(wide_reach);
  const Single mass = i.mass + j.mass, masses = i.mass * j.mass;
  ContactGeometry<Single> contact;
  contact.overlap = Single(wide_reach * wide_reach - dot(apart, apart)) / (reach + distance);
  contact.inertia_or_limit = 0.0;
  if constexpr (kModel == RollingModel::type_a_relative)
    contact.inertia_or_limit = 1.0 / (dt * (i.inertia_term + j.inertia_term));
  contact.n = Single(1.0 / distance) * d;
  contact.R_eff = i.radius * j.radius / reach;
  contact.m_eff = masses / mass;
  contact.inverse_m_eff = mass / masses;
  return contact;
}

/// A block of touching pairs on its way through the passes.
template <class T>
struct PairBlock {
  ContactGeometry<T> contact;
  ContactMotion<T> motion;
  Triple<T> arm_i, arm_j;  ///< contact point − centre of mass [m]
  Triple<T> lead;          ///< where ForceStep::leads
  Triple<T> force, rolling_torque;
  T F_n;
};

/// Second pass: geometry and relative motion. The contact point lies in the middle of the overlap.
template <RollingModel kModel, class T>
REPOSE_INLINE void pair_motion(const ForceStep& step, const Bodies& bodies, ForceKernels::Placed placed,
                               const TouchingList& touching, std::size_t first, PairBlock<T>& block) {
  const std::int32_t *body_i = touching.body_a.data() + first, *body_j = touching.body_b.data() + first;
  const auto i = load_side<T>(bodies, placed, touching.placed_a.data() + first, body_i);
  const auto j = load_side<T>(bodies, placed, touching.placed_b.data() + first, body_j);
  block.contact = pair_geometry<kModel>(i, j, step.dt);
  block.arm_i = i.arm - (i.radius - 0.5 * block.contact.overlap) * block.contact.n;
  block.arm_j = j.arm + (j.radius - 0.5 * block.contact.overlap) * block.contact.n;
  if constexpr (kModel == RollingModel::type_c)
    block.contact.inertia_or_limit = inertia_about_contact(i, j, block.arm_i, block.arm_j);
  block.motion =
      relative_motion<T>(block.contact.n, {i.velocity, i.w, block.arm_i}, {j.velocity, j.w, block.arm_j});
  if (step.leads)
    block.lead = lead_of<T>(bodies, body_i, block.arm_i) - lead_of<T>(bodies, body_j, block.arm_j);
}

/// What a law gives goes to the history, the ledger and the block.
template <class T>
REPOSE_INLINE void keep(const ContactForces<T>& f, const ContactHistory<T>& history, bool rolls,
                        const ForceStep& step, NearList& near, const TouchingList& touching,
                        std::size_t first, PairBlock<T>& block, PowerSum& sum) {
  const std::size_t lanes = std::min(kLanes<T>, touching.count - first);
  store_history(history, near, touching.history.data() + first, lanes, rolls);
  if (step.booked) sum.add(f.power, lanes);
  block.force = f.force, block.rolling_torque = f.rolling_torque, block.F_n = f.F_n;
}

/// Third pass: the contact law, for two blocks side by side.
template <RollingModel kModel>
REPOSE_INLINE void pair_law_twice(const ForceStep& step, NearList& near, const TouchingList& touching,
                                  std::size_t first, PairBlock<SimdReal>& a, PairBlock<SimdReal>& b,
                                  PowerSum& sum) {
  constexpr bool kSpring = has_rolling_spring(kModel);
  const std::int32_t* at_history = touching.history.data() + first;
  ContactHistory<Twin> history = twin(load_history<SimdReal>(near, at_history, kSpring),
                                      load_history<SimdReal>(near, at_history + kSimdWidth, kSpring));
  const Triple<Twin> lead = step.leads ? twin(a.lead, b.lead) : Triple<Twin>{0.0, 0.0, 0.0};
  const ContactTiming<Twin> timing{step.dt, step.lag, step.booked, step.leads ? &lead : nullptr};
  const ContactForces<Twin> f = contact_forces<kModel>(step.pair_law, twin(a.contact, b.contact),
                                                       twin(a.motion, b.motion), timing, history);
  keep(half_of<0>(f), half_of<0>(history), kSpring, step, near, touching, first, a, sum);
  keep(half_of<1>(f), half_of<1>(history), kSpring, step, near, touching, first + kSimdWidth, b, sum);
}

/// The same for one block.
template <RollingModel kModel, class T>
REPOSE_INLINE void pair_law(const ForceStep& step, NearList& near, const TouchingList& touching,
                            std::size_t first, PairBlock<T>& block, PowerSum& sum) {
  constexpr bool kSpring = has_rolling_spring(kModel);
  auto history = load_history<T>(near, touching.history.data() + first, kSpring);
  const ContactTiming<T> timing{step.dt, step.lag, step.booked, step.leads ? &block.lead : nullptr};
  const ContactForces<T> f =
      contact_forces<kModel>(step.pair_law, block.contact, block.motion, timing, history);
  keep(f, history, kSpring, step, near, touching, first, block, sum);
}

/// Whether some of kSimdWidth offsets are below `first`.
REPOSE_INLINE bool any_below(const std::int32_t* offset, std::int32_t first) {
  bool below = false;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane) below |= offset[lane] < first;
  return below;
}

/// add_fields8() where some records of the second side belong to others.
[[gnu::noinline]] inline void add_beyond(const Fields8& on_i, const std::int32_t* body_i, const Fields8& on_j,
                                         const std::int32_t* body_j, Bodies& bodies, std::size_t lanes,
                                         LoadsBeyond& beyond) {
  std::array<BodyLoad, kSimdWidth> row_i, row_j;
  LaneOffsets at;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
    at[lane] = NearList::kLine * static_cast<std::int32_t>(lane);
  store_fields8(on_i, row_i.data()->force, at.data());
  store_fields8(on_j, row_j.data()->force, at.data());
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    bodies.load_at(body_i[lane]) += row_i[lane];
    if (body_j[lane] >= beyond.first) {
      bodies.load_at(body_j[lane]) += row_j[lane];
    } else {
      beyond.body.push_back(body_j[lane]);
      beyond.load.push_back(row_j[lane]);
    }
  }
}

/// Fourth pass: forces and torques added up by body.
template <RollingModel kModel, class T>
REPOSE_INLINE void pair_loads(const ForceStep& step, Bodies& bodies, const TouchingList& touching,
                              std::size_t first, const PairBlock<T>& block, LoadsBeyond& beyond) {
  T resist_i = 0.0, resist_j = 0.0;
  if constexpr (kModel == RollingModel::type_a) {
    const T size = step.pair_law.rolling * absolute(block.F_n);
    resist_i = size * length(block.arm_i);
    resist_j = size * length(block.arm_j);
  }
  const Triple<T> minus = T(-1.0) * block.force;
  const auto on_i =
      load_fields<T>(block.force, resist_i, cross(block.arm_i, block.force) + block.rolling_torque);
  const auto on_j = load_fields<T>(minus, resist_j, cross(block.arm_j, minus) - block.rolling_torque);
  std::array<T, 16> on_both;
  std::ranges::copy(on_i, on_both.begin()), std::ranges::copy(on_j, on_both.begin() + 8);
  const std::size_t lanes = std::min(kLanes<T>, touching.count - first);
  each_half(on_both, lanes, [&](const std::array<SimdReal, 16>& half, std::size_t at, std::size_t count) {
    const std::int32_t *body_i = touching.body_a.data() + first + at,
                       *body_j = touching.body_b.data() + first + at;
    Fields8 half_i, half_j;
    std::copy_n(half.begin(), 8, half_i.begin()), std::copy_n(half.begin() + 8, 8, half_j.begin());
    if (any_below(body_j, beyond.first))
      add_beyond(half_i, body_i, half_j, body_j, bodies, count, beyond);
    else
      add_fields8(half_i, body_i, half_j, body_j, bodies.load.data()->force, count);
  });
}

/// Whether the law takes two vectors side by side (Twin): the 16 registers of AVX hold no two chains.
/// Measured in tools/bench/NOTES.md.
template <class T>
inline constexpr bool kTwins = std::is_same_v<T, SimdReal>&& kSimdWidth > 4;

/// The passes take a few blocks each, that stay in the first cache level between them. All passes in one were
/// a chain of 1,000 instructions a block, of which a core looks ahead to less than half: it waited for roots.
template <RollingModel kModel, class T>
ContactWork pair_forces(const ForceStep& step, Bodies& bodies, ForceKernels::Placed placed, NearList& near,
                        TouchingList& touching, LoadsBeyond& beyond) {
  constexpr std::size_t kBlocks = 4, kWidth = kLanes<T>;
  find_touching(placed, near, touching);
  PowerSum sum;
  std::array<PairBlock<T>, kBlocks> blocks;
  for (std::size_t begin = 0; begin < touching.count; begin += kBlocks * kWidth) {
    const std::size_t end = std::min(begin + kBlocks * kWidth, touching.count);
    PairBlock<T>* block = blocks.data();
    for (std::size_t first = begin; first < end; first += kWidth)
      pair_motion<kModel>(step, bodies, placed, touching, first, *block++);
    block = blocks.data();
    std::size_t at = begin;
    if constexpr (kTwins<T>)
      for (; at + kWidth < end; at += 2 * kWidth, block += 2)
        pair_law_twice<kModel>(step, near, touching, at, block[0], block[1], sum);
    for (; at < end; at += kWidth) pair_law<kModel>(step, near, touching, at, *block++, sum);
    block = blocks.data();
    for (std::size_t first = begin; first < end; first += kWidth)
      pair_loads<kModel>(step, bodies, touching, first, *block++, beyond);
  }
  return sum.work(step.dt);
}

}  // namespace repose
