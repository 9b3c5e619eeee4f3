#include "engine/dynamics/integrate.hpp"

#include "engine/dynamics/simd_records.hpp"

namespace repose {

namespace {

using T = SimdReal;

/// Offsets of kSimdWidth neighbouring records of `doubles` each, from the first of them on.
constexpr LaneOffsets neighbours(std::size_t doubles) {
  LaneOffsets offset{};
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
    offset[lane] = static_cast<std::int32_t>(lane * doubles);
  return offset;
}
constexpr LaneOffsets kLines = neighbours(8), kAxes = neighbours(sizeof(BodyAxes) / sizeof(double));

struct Rotor {
  T w, x, y, z;  ///< quaternion, not normalised
};

/// 1/(1+x), 0 ≤ x, and 1/√(1+x). A body turns by little in a step: their series are then exact to rounding,
/// and five multiplications take a fraction of a division's time.
constexpr double kSmall = 1e-4;
REPOSE_INLINE T inverse_of_one_plus(const T& x) {
  if (stdx::all_of(x < kSmall)) return (1.0 - x) * (1.0 + x * x);  // x⁴ = 1e-16
  return 1.0 / (1.0 + x);
}
REPOSE_INLINE T inverse_root_of_one_plus(const T& x) {
  if (stdx::all_of(absolute(x) < kSmall))
    return 1.0 - x * (0.5 - x * (0.375 - x * (0.3125 - x * 0.2734375)));  // 0.25 x⁵ = 2e-21
  return 1.0 / square_root(T(1.0 + x));
}

/// Turns q by φ about body axis k and the body's angular momentum by −φ: (a, b) are its two other components,
/// cyclic. Cayley: u = φ/2, cos φ → (1−u²)/(1+u²), sin φ → 2u/(1+u²). Returns |u|, half of a bound of the
/// angle.
REPOSE_INLINE void turn_momentum(const T& u, T& a, T& b) {
  const T scale = inverse_of_one_plus(T(u * u));
  const T c = (1.0 - u * u) * scale, s = 2.0 * u * scale;
  const T turned = c * a + s * b;
  b = c * b - s * a;
  a = turned;
}
REPOSE_INLINE T turn_1(Rotor& q, Triple<T>& l, const T& inverse, double h) {
  const T u = (0.5 * h) * inverse * l.x;
  turn_momentum(u, l.y, l.z);
  q = {q.w - u * q.x, q.x + u * q.w, q.y + u * q.z, q.z - u * q.y};
  return absolute(u);
}
REPOSE_INLINE T turn_2(Rotor& q, Triple<T>& l, const T& inverse, double h) {
  const T u = (0.5 * h) * inverse * l.y;
  turn_momentum(u, l.z, l.x);
  q = {q.w - u * q.y, q.x - u * q.z, q.y + u * q.w, q.z + u * q.x};
  return absolute(u);
}
REPOSE_INLINE T turn_3(Rotor& q, Triple<T>& l, const T& inverse, double h) {
  const T u = (0.5 * h) * inverse * l.z;
  turn_momentum(u, l.x, l.y);
  q = {q.w - u * q.z, q.x + u * q.y, q.y - u * q.x, q.z + u * q.w};
  return absolute(u);
}

struct Axes {
  Triple<T> c1, c2, c3;  ///< world directions of the body's axes
};
REPOSE_INLINE Axes axes_of(const Rotor& q) {
  const T xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const T xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const T wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{1.0 - 2.0 * (yy + zz), 2.0 * (xy + wz), 2.0 * (xz - wy)},
          {2.0 * (xy - wz), 1.0 - 2.0 * (xx + zz), 2.0 * (yz + wx)},
          {2.0 * (xz + wy), 2.0 * (yz - wx), 1.0 - 2.0 * (xx + yy)}};
}

/// Rolling resistance of type_a on the angular momentum l in the body's frame, to which the contacts' torque
/// has just added `kick`. Adds its work to `taken_energy`: the momentum that it takes, J = l − l', times the
/// mean of the spins before and after the step,
///   W = J·½(I⁻¹(l − kick) + I⁻¹ l'),
/// since over the step it acts beside the contacts, which book theirs by the same mean (ContactPower). As if
/// it acted after them, J·½ I⁻¹(l + l'), the spin that a contact gives and resistance takes away in the same
/// step counted as lost though nobody had put it in: +16 % of the energy of 1.5 kg of soft clumps of 8 at
/// 0.3 T_R (μr = 0.2), where the mean is off by −1 %.
REPOSE_INLINE Triple<T> resist_rolling(const Triple<T>& l, const Triple<T>& kick, const Triple<T>& inverse,
                                       const T& impulse, const MotionStep& step, T& taken_energy) {
  const Triple<T> w{inverse.x * l.x, inverse.y * l.y, inverse.z * l.z};
  const T momentum = length(l);
  const T spin_squared = dot(w, w);
  const auto turns = spin_squared > 0.0;
  const T safe = select(turns, spin_squared, T(1.0));
  const T spin = square_root(safe);
  T taken = select(turns, T(impulse / spin), T(0.0));
  auto stops = spin_squared < 0.0;
  if (step.rolling_torque == RollingTorque::limited) {
    // ω̂ᵀ I⁻¹ ω̂ |ω| = Σ w_k² / (I_k |ω|)
    const T softness = (inverse.x * w.x * w.x + inverse.y * w.y * w.y + inverse.z * w.z * w.z) / spin;
    const T most = spin_squared / select(turns, softness, T(1.0));
    taken = smaller(impulse, most) / spin;
    stops = momentum <= impulse;
  }
  const T zero = 0.0;
  const Triple<T> left{select(stops, zero, T(l.x - taken * w.x)), select(stops, zero, T(l.y - taken * w.y)),
                       select(stops, zero, T(l.z - taken * w.z))};
  if (step.booked) {
    const Triple<T> twice = l - kick + left;
    taken_energy += 0.5 * dot(l - left, {inverse.x * twice.x, inverse.y * twice.y, inverse.z * twice.z});
  }
  return left;
}

REPOSE_INLINE Triple<T> to_body(const Axes& axes, const Triple<T>& world) {
  return {dot(axes.c1, world), dot(axes.c2, world), dot(axes.c3, world)};
}
REPOSE_INLINE Triple<T> to_world(const Axes& axes, const Triple<T>& body) {
  return body.x * axes.c1 + body.y * axes.c2 + body.z * axes.c3;
}

/// The free rotation over Δt; l becomes the momentum as the turned body sees it.
/// @return a bound of the angle
REPOSE_INLINE T turn_freely(Rotor& q, Triple<T>& l, const Triple<T>& inverse, double dt) {
  T half = turn_1(q, l, inverse.x, 0.5 * dt);
  half += turn_2(q, l, inverse.y, 0.5 * dt);
  half += turn_3(q, l, inverse.z, dt);
  half += turn_2(q, l, inverse.y, 0.5 * dt);
  half += turn_1(q, l, inverse.x, 0.5 * dt);
  const T scale = inverse_root_of_one_plus(T(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0));
  q = {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
  return 2.0 * half;
}

/// What acts on the rotation of kSimdWidth bodies.
struct Twist {
  Triple<T> momentum;  ///< L before the step, world
  Triple<T> torque;    ///< world
  T impulse;           ///< of type_a's rolling resistance
};

void store_momentum(const Triple<T>& L, Bodies& bodies, std::size_t first) {
  store(L.x, bodies.lx, first), store(L.y, bodies.ly, first), store(L.z, bodies.lz, first);
}

/// L with rolling resistance, in the world and, by `axes`, in the body.
REPOSE_INLINE void resist(const Axes& axes, const Triple<T>& inverse, const Twist& twist,
                          const MotionStep& step, Triple<T>& L, Triple<T>& l, T& taken_energy) {
  if (!stdx::any_of(twist.impulse > 0.0)) return;
  const Triple<T> kick = to_body(axes, T(step.dt) * twist.torque);
  l = resist_rolling(l, kick, inverse, twist.impulse, step, taken_energy);
  L = select3(twist.impulse > 0.0, to_world(axes, l), L);
}

/// @param turned  out: a bound of the angle
/// @return ω that contacts will see, world
template <Integrator kIntegrator>
REPOSE_INLINE Triple<T> rotate(Bodies& bodies, std::size_t first, const Twist& twist, const MotionStep& step,
                               T& turned, T& taken_energy) {
  const double dt = step.dt;
  turned = 0.0;
  const Triple<T> inverse{load(bodies.inverse_i1, first), load(bodies.inverse_i2, first),
                          load(bodies.inverse_i3, first)};
  const Triple<T> kick = T(dt) * twist.torque;
  Triple<T> L = twist.momentum + kick;
  if (!bodies.oriented) {  // a single sphere has one moment and no visible orientation
    L = resist_rolling(L, kick, inverse, twist.impulse, step, taken_energy);
    store_momentum(L, bodies, first);
    return inverse.x * L;
  }
  Rotor q{load(bodies.qw, first), load(bodies.qx, first), load(bodies.qy, first), load(bodies.qz, first)};
  Axes axes = axes_of(q);
  Triple<T> l;
  if constexpr (kIntegrator == Integrator::explicit_euler) {
    Triple<T> before = to_body(axes, twist.momentum);
    turned = turn_freely(q, before, inverse, dt);
    axes = axes_of(q);
    l = to_body(axes, L);
    resist(axes, inverse, twist, step, L, l, taken_energy);
  } else {
    l = to_body(axes, L);
    resist(axes, inverse, twist, step, L, l, taken_energy);
    turned = turn_freely(q, l, inverse, dt);
    axes = axes_of(q);
  }
  store_momentum(L, bodies, first);
  store(q.w, bodies.qw, first), store(q.x, bodies.qx, first), store(q.y, bodies.qy, first),
      store(q.z, bodies.qz, first);

  BodyAxes& first_axes = bodies.axes[first];
  double* column = first_axes.column[0];
  const T scale = load(bodies.scale, first);
  for (const Triple<T>* axis : {&axes.c1, &axes.c2, &axes.c3}) {
    store_fields4({scale * axis->x, scale * axis->y, scale * axis->z, T(0.0)}, column, kAxes.data(),
                  kSimdWidth);
    column += 4;
  }
  store_fields4({load(bodies.x, first), load(bodies.y, first), load(bodies.z, first), scale},
                first_axes.position, kAxes.data(), kSimdWidth);
  return to_world(axes, {inverse.x * l.x, inverse.y * l.y, inverse.z * l.z});
}

/// Moves the centres of mass of kSimdWidth bodies by what their velocity in `motion` becomes; dv = Δt a.
/// @return how far
template <Integrator kIntegrator>
REPOSE_INLINE T translate(Bodies& bodies, std::size_t first, const Triple<T>& dv, double dt,
                          Fields8& motion) {
  Triple<T> v{motion[0], motion[1], motion[2]};
  Triple<T> moving = v;
  v = v + dv;
  if constexpr (kIntegrator != Integrator::explicit_euler) moving = v;
  motion[0] = v.x, motion[1] = v.y, motion[2] = v.z;
  store(load(bodies.x, first) + dt * moving.x, bodies.x, first);
  store(load(bodies.y, first) + dt * moving.y, bodies.y, first);
  store(load(bodies.z, first) + dt * moving.z, bodies.z, first);
  return dt * length(moving);
}

/// Bodies::lead of kSimdWidth bodies; the turn of their axes within half a step is left out.
void store_lead(Bodies& bodies, std::size_t first, const Triple<T>& dv, const Triple<T>& dL) {
  const Triple<T> inverse{load(bodies.inverse_i1, first), load(bodies.inverse_i2, first),
                          load(bodies.inverse_i3, first)};
  Triple<T> dw = inverse.x * dL;
  if (bodies.oriented) {
    const Axes axes = axes_of(
        {load(bodies.qw, first), load(bodies.qx, first), load(bodies.qy, first), load(bodies.qz, first)});
    const Triple<T> dl = to_body(axes, dL);
    dw = to_world(axes, {inverse.x * dl.x, inverse.y * dl.y, inverse.z * dl.z});
  }
  const T half = 0.5, none = 0.0;
  store_fields8({half * dv.x, half * dv.y, half * dv.z, none, half * dw.x, half * dw.y, half * dw.z, none},
                bodies.lead[first].velocity, kLines.data());
}

/// 1/I_min
REPOSE_INLINE T softest_axis(const Bodies& bodies, std::size_t first) {
  return larger(larger(load(bodies.inverse_i1, first), load(bodies.inverse_i2, first)),
                load(bodies.inverse_i3, first));
}

template <Integrator kIntegrator>
double integrate_range(Bodies& bodies, const MotionStep& step, std::size_t begin, std::size_t end) {
  const double dt = step.dt;
  T taken_energy = 0.0;
  for (std::size_t first = begin; first < end; first += kSimdWidth) {
    double* record = bodies.motion[first].velocity;
    Fields8 motion = load_fields8(record, kLines.data());
    const Fields8 sum = load_fields8(bodies.load[first].force, kLines.data());
    const T kick = dt / motion[3];
    const Triple<T> dv{kick * sum[0], kick * sum[1], kick * sum[2] - dt * kGravity};
    const T moved = translate<kIntegrator>(bodies, first, dv, dt, motion);
    const Twist twist{{load(bodies.lx, first), load(bodies.ly, first), load(bodies.lz, first)},
                      {sum[4], sum[5], sum[6]},
                      step.rolling == RollingModel::type_a ? T(dt * sum[3]) : T(0.0)};
    T turned;
    const Triple<T> w = rotate<kIntegrator>(bodies, first, twist, step, turned, taken_energy);
    const T swung = load(bodies.swing, first) * turned, pace = moved + swung;
    store(pace, bodies.pace, first);
    store(load(bodies.travel, first) + pace, bodies.travel, first);
    store(load(bodies.swung, first) + swung, bodies.swung, first);
    motion[4] = w.x, motion[5] = w.y, motion[6] = w.z;
    if (step.rolling == RollingModel::type_a_relative)
      motion[7] = larger(sum[7], T(1.0)) * softest_axis(bodies, first);
    store_fields8(motion, record, kLines.data());
    if constexpr (kIntegrator == Integrator::velocity_verlet)
      store_lead(bodies, first, dv, T(dt) * twist.torque);
  }
  return stdx::reduce(taken_energy);
}

}  // namespace

double integrate(Bodies& bodies, const MotionStep& step, std::size_t first, std::size_t last) {
  if (last == bodies.count) last = bodies.padded();
  switch (step.integrator) {
    case Integrator::symplectic_euler:
      return integrate_range<Integrator::symplectic_euler>(bodies, step, first, last);
    case Integrator::velocity_verlet:
      return integrate_range<Integrator::velocity_verlet>(bodies, step, first, last);
    case Integrator::explicit_euler:
      return integrate_range<Integrator::explicit_euler>(bodies, step, first, last);
  }
  return 0.0;
}

}  // namespace repose
