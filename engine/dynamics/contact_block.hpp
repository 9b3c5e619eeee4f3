#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <type_traits>

#include "engine/contact/contact_law.hpp"
#include "engine/contact/single.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/contact_list.hpp"
#include "engine/dynamics/force_kernels.hpp"
#include "engine/dynamics/simd_records.hpp"

namespace repose {

/// A block of contacts between the arrays in memory and the contact law: kLanes<T> of them, one lane each.
/// The arrays hold doubles; T is SimdReal, or Single for a law in single precision. What is small only as a
/// difference of large numbers is taken of Wide<T> before it is rounded to T.
static_assert(sizeof(BodyMotion) == 64 && sizeof(BodyLoad) == 64 && sizeof(BodyLead) == 64 &&
              sizeof(BodyAxes) == 128);
static_assert(sizeof(PlacedSphere) == 32 && sizeof(SpringRecord) == 32 && sizeof(RollingRecord) == 32);

template <class T>
inline constexpr std::size_t kLanes = kSimdWidth;
template <>
inline constexpr std::size_t kLanes<Twin> = 2 * kSimdWidth;
template <>
inline constexpr std::size_t kLanes<Single> = 2 * kSimdWidth;

/// Doubles in the lanes of T.
template <class T>
using Wide = std::conditional_t<kLanes<T> == kSimdWidth, SimdReal, Twin>;

template <class T>
REPOSE_INLINE Triple<T> narrow(const Triple<Wide<T>>& wide) {
  return {T(wide.x), T(wide.y), T(wide.z)};
}

/// Four and eight neighbouring fields of records, from `base` on.
template <class T>
REPOSE_INLINE std::array<T, 4> load_four(const double* base, const std::int32_t* offset) {
  if constexpr (kLanes<T> == kSimdWidth) {
    return load_fields4(base, offset);
  } else {
    const Fields4 a = load_fields4(base, offset), b = load_fields4(base, offset + kSimdWidth);
    return {T(a[0], b[0]), T(a[1], b[1]), T(a[2], b[2]), T(a[3], b[3])};
  }
}
template <class T>
REPOSE_INLINE std::array<T, 8> load_eight(const double* base, const std::int32_t* offset) {
  if constexpr (kLanes<T> == kSimdWidth) {
    return load_fields8(base, offset);
  } else {
    const auto low = load_four<T>(base, offset), high = load_four<T>(base + 4, offset);
    return {low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]};
  }
}

/// visit(half of the fields, first lane, lanes) for each SimdReal that T holds, of `lanes` lanes in all.
template <class T, std::size_t N, class Visit>
REPOSE_INLINE void each_half(const std::array<T, N>& fields, std::size_t lanes, Visit visit) {
  if constexpr (kLanes<T> == kSimdWidth) {
    visit(fields, 0, lanes);
  } else {
    std::array<SimdReal, N> half;
    for (std::size_t f = 0; f < N; ++f) half[f] = fields[f].template half<0>();
    visit(half, 0, std::min(lanes, kSimdWidth));
    if (lanes <= kSimdWidth) return;
    for (std::size_t f = 0; f < N; ++f) half[f] = fields[f].template half<1>();
    visit(half, kSimdWidth, lanes - kSimdWidth);
  }
}

/// One side of a block: spheres with their bodies.
template <class T>
struct BlockSide {
  Triple<Wide<T>> centre;
  Wide<T> wide_radius;
  Triple<T> arm, velocity, w;
  T radius, mass, inertia_term;
};

/// Where the centres of mass are, from what their spheres were placed by; those of single spheres are not
/// kept there (BodyAxes), and have no arms.
template <class T>
REPOSE_INLINE Triple<T> arm_of(const Bodies& bodies, const std::int32_t* body,
                               const Triple<Wide<T>>& centre) {
  if (!bodies.oriented) return {T(0.0), T(0.0), T(0.0)};
  std::array<std::int32_t, kLanes<T>> at;
  for (std::size_t lane = 0; lane < at.size(); ++lane) at[lane] = 2 * body[lane];
  const auto position = load_four<Wide<T>>(bodies.axes.data()->position, at.data());
  return narrow<T>(centre - Triple<Wide<T>>{position[0], position[1], position[2]});
}

/// @param sphere, body  offsets of the records, TouchingList
template <class T>
REPOSE_INLINE BlockSide<T> load_side(const Bodies& bodies, std::span<const PlacedSphere> placed,
                                     const std::int32_t* sphere, const std::int32_t* body) {
  BlockSide<T> side;
  const auto s = load_four<Wide<T>>(placed.data()->centre, sphere);
  const auto m = load_eight<T>(bodies.motion.data()->velocity, body);
  side.centre = {s[0], s[1], s[2]};
  side.wide_radius = s[3];
  side.radius = T(s[3]);
  side.arm = arm_of<T>(bodies, body, side.centre);
  side.velocity = {m[0], m[1], m[2]};
  side.mass = m[3];
  side.w = {m[4], m[5], m[6]};
  side.inertia_term = m[7];
  return side;
}

/// What Bodies::lead adds to the velocity at the contact point of one side.
template <class T>
REPOSE_INLINE Triple<T> lead_of(const Bodies& bodies, const std::int32_t* body, const Triple<T>& arm) {
  const auto lead = load_eight<T>(bodies.lead.data()->velocity, body);
  return Triple<T>{lead[0], lead[1], lead[2]} + cross(Triple<T>{lead[4], lead[5], lead[6]}, arm);
}

/// What force and torque on a body add to its record (BodyLoad).
template <class T>
REPOSE_INLINE std::array<T, 8> load_fields(const Triple<T>& force, const T& rolling,
                                           const Triple<T>& torque) {
  return {force.x, force.y, force.z, rolling, torque.x, torque.y, torque.z, T(1.0)};
}

/// @param history  offsets of the records, TouchingList
template <class T>
REPOSE_INLINE ContactHistory<T> load_history(const NearList& contacts, const std::int32_t* history,
                                             bool rolling) {
  const auto spring = load_four<T>(contacts.spring.data()->value, history);
  ContactHistory<T> loaded;
  loaded.tangential = {{spring[0], spring[1], spring[2]}, spring[3]};
  loaded.rolling = {T(0.0), T(0.0), T(0.0)};
  if (rolling) {
    const auto torque = load_four<T>(contacts.rolling.data()->torque, history);
    loaded.rolling = {torque[0], torque[1], torque[2]};
  }
  return loaded;
}

template <class T>
REPOSE_INLINE void store_history(const ContactHistory<T>& loaded, NearList& contacts,
                                 const std::int32_t* history, std::size_t lanes, bool rolling) {
  const auto store = [&](const std::array<T, 4>& fields, double* base) {
    each_half(fields, lanes, [&](const Fields4& half, std::size_t first, std::size_t count) {
      store_fields4(half, base, history + first, count);
    });
  };
  const TangentialSpring<T>& spring = loaded.tangential;
  store({spring.value.x, spring.value.y, spring.value.z, spring.root}, contacts.spring.data()->value);
  if (!rolling) return;
  const Triple<T>& torque = loaded.rolling;
  store({torque.x, torque.y, torque.z, T(0.0)}, contacts.rolling.data()->torque);
}

// Two blocks side by side, and what comes out of them.
REPOSE_INLINE ContactHistory<Twin> twin(const ContactHistory<SimdReal>& a,
                                        const ContactHistory<SimdReal>& b) {
  return {{twin(a.tangential.value, b.tangential.value), {a.tangential.root, b.tangential.root}},
          twin(a.rolling, b.rolling)};
}
REPOSE_INLINE ContactGeometry<Twin> twin(const ContactGeometry<SimdReal>& a,
                                         const ContactGeometry<SimdReal>& b) {
  return {twin(a.n, b.n),
          {a.overlap, b.overlap},
          {a.R_eff, b.R_eff},
          {a.m_eff, b.m_eff},
          {a.inertia_or_limit, b.inertia_or_limit},
          {a.inverse_m_eff, b.inverse_m_eff}};
}
REPOSE_INLINE ContactMotion<Twin> twin(const ContactMotion<SimdReal>& a, const ContactMotion<SimdReal>& b) {
  return {twin(a.v, b.v), twin(a.w_rel, b.w_rel), {a.w_normal, b.w_normal}};
}
template <int kHalf>
REPOSE_INLINE ContactHistory<SimdReal> half_of(const ContactHistory<Twin>& h) {
  return {{half_of<kHalf>(h.tangential.value), h.tangential.root.half<kHalf>()}, half_of<kHalf>(h.rolling)};
}
template <int kHalf>
REPOSE_INLINE ContactForces<SimdReal> half_of(const ContactForces<Twin>& f) {
  const ContactPower<Twin>& p = f.power;
  return {half_of<kHalf>(f.force),
          half_of<kHalf>(f.rolling_torque),
          f.F_n.half<kHalf>(),
          {p.normal_damping.half<kHalf>(), p.tangential_damping.half<kHalf>(), p.spring.half<kHalf>(),
           p.rolling.half<kHalf>()}};
}

/// Sums the power of blocks, lane by lane.
struct PowerSum {
  SimdReal normal_damping = 0.0, tangential_damping = 0.0, spring = 0.0, rolling = 0.0, wall = 0.0;

  template <class T>
  REPOSE_INLINE void add(const ContactPower<T>& power, std::size_t lanes) {
    const std::array<T, 4> parts{power.normal_damping, power.tangential_damping, power.spring, power.rolling};
    each_half(parts, lanes, [this](const Fields4& half, std::size_t, std::size_t count) {
      normal_damping += real(half[0], count);
      tangential_damping += real(half[1], count);
      spring += real(half[2], count);
      rolling += real(half[3], count);
    });
  }
  REPOSE_INLINE void add_wall(const SimdReal& power, std::size_t lanes) { wall += real(power, lanes); }
  /// Lanes beyond `lanes` repeat a contact and count for nothing.
  REPOSE_INLINE static SimdReal real(const SimdReal& power, std::size_t lanes) {
    if (lanes == kSimdWidth) return power;
    SimdReal counted = power;
    for (std::size_t lane = lanes; lane < kSimdWidth; ++lane) counted[lane] = 0.0;
    return counted;
  }
  [[nodiscard]] ContactWork work(double dt) const {
    return {dt * stdx::reduce(normal_damping), dt * stdx::reduce(tangential_damping),
            dt * stdx::reduce(spring), dt * stdx::reduce(rolling), dt * stdx::reduce(wall)};
  }
};

/// Brings a block of near candidates to this step.
inline void mark_touching(NearList& near, std::size_t block, unsigned touching) {
  const unsigned before = near.touching[block];
  near.touching[block] = static_cast<std::uint8_t>(touching);
  for (unsigned met = touching & ~before; met != 0; met &= met - 1)
    near.begin(block * NearList::kBlock + static_cast<std::size_t>(std::countr_zero(met)));
}

}  // namespace repose
