#include "engine/dynamics/integrate.hpp"

#include "engine/dynamics/simd_records.hpp"

namespace repose {

namespace {

using T = SimdReal;

/// Offsets of kSimdWidth neighbouring records of `doubles` each.
LaneOffsets neighbours(std::size_t first, std::size_t doubles) {
  LaneOffsets offset;
  for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
    offset[lane] = static_cast<std::int32_t>((first + lane) * doubles);
  return offset;
}

struct Rotor {
  T w, x, y, z;  ///< quaternion, not normalised
};

/// Turns q by φ about body axis k and the body's angular momentum by −φ: (a, b) are its two other components,
/// cyclic. Cayley: u = φ/2, cos φ → (1−u²)/(1+u²), sin φ → 2u/(1+u²).
REPOSE_INLINE void turn_momentum(const T& u, T& a, T& b) {
  const T scale = 1.0 / (1.0 + u * u);
  const T c = (1.0 - u * u) * scale, s = 2.0 * u * scale;
  const T turned = c * a + s * b;
  b = c * b - s * a;
  a = turned;
}
REPOSE_INLINE void turn_1(Rotor& q, Triple<T>& l, const T& inverse, double h) {
  const T u = (0.5 * h) * inverse * l.x;
  turn_momentum(u, l.y, l.z);
  q = {q.w - u * q.x, q.x + u * q.w, q.y + u * q.z, q.z - u * q.y};
}
REPOSE_INLINE void turn_2(Rotor& q, Triple<T>& l, const T& inverse, double h) {
  const T u = (0.5 * h) * inverse * l.y;
  turn_momentum(u, l.z, l.x);
  q = {q.w - u * q.y, q.x - u * q.z, q.y + u * q.w, q.z + u * q.x};
}
REPOSE_INLINE void turn_3(Rotor& q, Triple<T>& l, const T& inverse, double h) {
  const T u = (0.5 * h) * inverse * l.z;
  turn_momentum(u, l.x, l.y);
  q = {q.w - u * q.z, q.x + u * q.y, q.y - u * q.x, q.z + u * q.w};
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

/// Rolling resistance of type_a on the angular momentum l in the body's frame.
REPOSE_INLINE Triple<T> resist_rolling(const Triple<T>& l, const Triple<T>& inverse, const T& impulse) {
  const Triple<T> w{inverse.x * l.x, inverse.y * l.y, inverse.z * l.z};
  const T momentum = length(l);
  const T spin_squared = dot(w, w);
  const auto turns = spin_squared > 0.0;
  const T safe = select(turns, spin_squared, T(1.0));
  const T spin = square_root(safe);
  // ω̂ᵀ I⁻¹ ω̂ |ω| = Σ w_k² / (I_k |ω|)
  const T softness = (inverse.x * w.x * w.x + inverse.y * w.y * w.y + inverse.z * w.z * w.z) / spin;
  const T most = spin_squared / select(turns, softness, T(1.0));
  const T taken = smaller(impulse, most) / spin;
  const auto stops = momentum <= impulse;
  const T zero = 0.0;
  return {select(stops, zero, T(l.x - taken * w.x)), select(stops, zero, T(l.y - taken * w.y)),
          select(stops, zero, T(l.z - taken * w.z))};
}

Triple<T> rotate(Bodies& bodies, std::size_t first, Triple<T> L, const T& impulse, double dt) {
  const Triple<T> inverse{load(bodies.inverse_i1, first), load(bodies.inverse_i2, first),
                          load(bodies.inverse_i3, first)};
  if (!bodies.oriented) {  // a single sphere has one moment and no visible orientation
    const Triple<T> left = resist_rolling(L, inverse, impulse);
    store(left.x, bodies.lx, first), store(left.y, bodies.ly, first), store(left.z, bodies.lz, first);
    return inverse.x * left;
  }
  Rotor q{load(bodies.qw, first), load(bodies.qx, first), load(bodies.qy, first), load(bodies.qz, first)};
  const Axes before = axes_of(q);
  Triple<T> l{dot(before.c1, L), dot(before.c2, L), dot(before.c3, L)};
  if (stdx::any_of(impulse > 0.0)) {
    l = resist_rolling(l, inverse, impulse);
    const Triple<T> resisted = l.x * before.c1 + l.y * before.c2 + l.z * before.c3;
    L = select3(impulse > 0.0, resisted, L);
  }
  store(L.x, bodies.lx, first), store(L.y, bodies.ly, first), store(L.z, bodies.lz, first);

  turn_1(q, l, inverse.x, 0.5 * dt);
  turn_2(q, l, inverse.y, 0.5 * dt);
  turn_3(q, l, inverse.z, dt);
  turn_2(q, l, inverse.y, 0.5 * dt);
  turn_1(q, l, inverse.x, 0.5 * dt);
  const T scale = 1.0 / square_root(T(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z));
  q = {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
  store(q.w, bodies.qw, first), store(q.x, bodies.qx, first), store(q.y, bodies.qy, first),
      store(q.z, bodies.qz, first);

  const Axes axes = axes_of(q);
  const LaneOffsets at = neighbours(first, 12);
  double* column = bodies.axes.data()->column[0];
  for (const Triple<T>* axis : {&axes.c1, &axes.c2, &axes.c3}) {
    store_fields4({axis->x, axis->y, axis->z, T(0.0)}, column, at, kSimdWidth);
    column += 4;
  }
  return (inverse.x * l.x) * axes.c1 + (inverse.y * l.y) * axes.c2 + (inverse.z * l.z) * axes.c3;
}

}  // namespace

void integrate(Bodies& bodies, double dt, bool rolling_type_a) {
  double* motions = bodies.motion.data()->velocity;
  double* loads = bodies.load.data()->force;
  for (std::size_t first = 0; first < bodies.padded(); first += kSimdWidth) {
    const LaneOffsets at = neighbours(first, 8);
    Fields8 motion = load_fields8(motions, at);
    const Fields8 sum = load_fields8(loads, at);
    const T kick = dt / motion[3];
    motion[0] += kick * sum[0];
    motion[1] += kick * sum[1];
    motion[2] += kick * sum[2] - dt * kGravity;
    store(load(bodies.x, first) + dt * motion[0], bodies.x, first);
    store(load(bodies.y, first) + dt * motion[1], bodies.y, first);
    store(load(bodies.z, first) + dt * motion[2], bodies.z, first);

    const Triple<T> L{load(bodies.lx, first) + dt * sum[4], load(bodies.ly, first) + dt * sum[5],
                      load(bodies.lz, first) + dt * sum[6]};
    const T impulse = rolling_type_a ? T(dt * sum[3]) : T(0.0);
    const Triple<T> w = rotate(bodies, first, L, impulse, dt);
    motion[4] = w.x, motion[5] = w.y, motion[6] = w.z;
    store_fields8(motion, motions, at);
  }
}

}  // namespace repose
