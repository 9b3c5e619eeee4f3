// Level 3 of ContactList: candidates that may touch soon.

#include <algorithm>
#include <cmath>

#include "engine/dynamics/contact_list.hpp"
#include "engine/dynamics/simd_records.hpp"

namespace repose {

namespace {

/// A share lasts for kLookSteps at the present pace, within limits that are parts of the candidates' skin. A
/// longer one keeps more candidates near that never touch, a shorter one looks more often. A look takes along
/// the bodies whose share would end within kTogether steps. Figures in tools/bench/NOTES.md.
constexpr double kLookSteps = 32.0, kTogether = 12.0;
constexpr double kLeastShare = 1.0 / 256.0, kMostShare = 0.25;

/// What is added to a threshold against rounding [m]: far above that of coordinates of kFarthest.
constexpr double kRounding = 1e-12;

}  // namespace

void ContactList::share_out(const Bodies& bodies) {
  looked_.clear();
  const double least = kLeastShare * skins_.spheres, most = kMostShare * skins_.spheres;
  for (std::size_t i = 0; i < bodies.count; ++i) {
    is_looked_[i] |= !(bodies.travel[i] + kTogether * bodies.pace[i] <= until_.near[i]);
    if (!is_looked_[i]) continue;
    looked_.push_back(i);
    const double share = std::clamp(kLookSteps * bodies.pace[i], least, most);
    until_.near[i] = std::min({bodies.travel[i] + share, until_.spheres[i], until_.bodies[i]});
  }
}

void ContactList::look_near(const Bodies& bodies, std::span<const Wall> walls, bool walls_used_up) {
  ++looks_;
  share_out(bodies);
  for (const std::size_t i : looked_) {
    for (std::size_t p = pair_first_[i]; p < pair_first_[i + 1]; ++p) look_at_pair(bodies, p);
    for (std::size_t k = second_first_[i]; k < second_first_[i + 1]; ++k) {
      const std::size_t p = second_[k];
      if (!is_looked_[static_cast<std::size_t>(body_pairs_[p].i)]) look_at_pair(bodies, p);
    }
  }
  if (walls_used_up) {
    looked_walls_.assign(walls.begin(), walls.end());
    wall_share_ = 0.0;
    for (const Wall& wall : walls)
      if (wall.present)
        wall_share_ = std::max(
            wall_share_, std::min(kLookSteps * dt_ * wall.velocity.norm(), kMostShare * skins_.spheres));
    for (std::size_t i = 0; i < bodies.count; ++i) look_at_walls(bodies, i);
  } else {
    for (const std::size_t i : looked_) look_at_walls(bodies, i);
  }
  gather_near();
}

/// All candidates of a pair of bodies, a vector at a time: their spheres are placed in registers, since most
/// are not near.
void ContactList::look_at_pair(const Bodies& bodies, std::size_t pair) {
  const std::size_t begin = pair_begin_[pair], end = pair_begin_[pair + 1];
  if (begin == end) return;
  const auto i = static_cast<std::size_t>(body_pairs_[pair].i),
             j = static_cast<std::size_t>(body_pairs_[pair].j);
  const SimdReal share = left(bodies, i) + left(bodies, j) + kRounding;
  const Vec3 apart = bodies.position(i) - bodies.position(j);
  const auto placed_at = [&](const std::vector<std::int32_t>& spheres, std::size_t body, std::size_t first,
                             Fields4& sphere) {
    const std::int32_t shift = local_of_shape_[static_cast<std::size_t>(bodies.shape[body])] -
                               static_cast<std::int32_t>(first_sphere_[body]);
    LaneOffsets at;
    for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
      at[lane] = 4 * (spheres[std::min(first + lane, end - 1)] + shift);
    sphere = load_fields4(local_.data()->centre, at.data());
    const SimdReal scale = bodies.scale[body];
    for (SimdReal& field : sphere) field *= scale;
    if (!bodies.oriented) return;
    const double(&axis)[3][4] = bodies.axes[body].column;
    const SimdReal x = sphere[0], y = sphere[1], z = sphere[2];
    for (std::size_t k = 0; k < 3; ++k)
      sphere[k] = SimdReal(axis[0][k]) * x + SimdReal(axis[1][k]) * y + SimdReal(axis[2][k]) * z;
  };
  for (std::size_t first = begin; first < end; first += kSimdWidth) {
    Fields4 a, b;
    placed_at(pairs_.a, i, first, a);
    placed_at(pairs_.b, j, first, b);
    const SimdReal dx = a[0] - b[0] + apart.x(), dy = a[1] - b[1] + apart.y(), dz = a[2] - b[2] + apart.z();
    const SimdReal reach = a[3] + b[3] + share;
    const unsigned near = less_bits(dx * dx + dy * dy + dz * dz, reach * reach);
    pairs_.set_near(first, std::min(kSimdWidth, end - first), near);
  }
}

void ContactList::look_at_walls(const Bodies& bodies, std::size_t i) {
  const double share = left(bodies, i) + wall_share_ + kRounding;
  for (std::size_t c = wall_begin_[i]; c < wall_begin_[i + 1]; ++c) {
    const auto s = static_cast<std::size_t>(walls_.a[c]);
    place(bodies, s);
    const PlacedSphere& sphere = placed[s];
    const Wall& wall = looked_walls_[static_cast<std::size_t>(walls_.b[c])];
    walls_.set_near(c, 1, within_reach(wall, Vec3(sphere.centre), sphere.radius + share));
  }
}

void ContactList::gather_near() {
  std::swap(near_pairs, old_near_pairs_);
  near_pairs.gather(pairs_, placed, old_near_pairs_);
  std::swap(near_walls, old_near_walls_);
  near_walls.gather(walls_, placed, old_near_walls_);
  for (const std::int32_t s : needed_) is_needed_[static_cast<std::size_t>(s)] = 0;
  needed_.clear();
  const auto need = [&](std::int32_t at) {
    const auto s = static_cast<std::size_t>(at / NearList::kLine);
    if (is_needed_[s]) return;
    is_needed_[s] = 1;
    needed_.push_back(static_cast<std::int32_t>(s));
  };
  for (std::size_t k = 0; k < near_pairs.count; ++k)
    need(near_pairs.sphere_a[k]), need(near_pairs.sphere_b[k]);
  for (std::size_t k = 0; k < near_walls.count; ++k) need(near_walls.sphere_a[k]);
}

}  // namespace repose
