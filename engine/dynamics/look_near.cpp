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

}  // namespace

/// Pairs are looked at once the shares of all bodies are settled, and spheres are needed once all sections
/// have said so.
void ContactList::look_near(const Bodies& bodies, std::span<const Wall> walls, bool all_walls, Crew& crew) {
  ++looks_;
  ++changes_;
  if (all_walls) share_out_walls(walls);
  ends_.resize(bodies.count);
  each_section(crew, [&](const Section& section) {
    share_out(bodies, section);
    for (const Section::Needed& needed : section.needed)
      is_needed_[static_cast<std::size_t>(needed.sphere)] = 0;
  });
  each_section(crew, [&](Section& section) {
    look_at(bodies, all_walls, section);
    if (section.changed) section.gather_near();
    flag_needed(section);
  });
  find_places(bodies, crew);
}

void ContactList::share_out(const Bodies& bodies, const Section& section) {
  const double least = kLeastShare * skins_.spheres, most = kMostShare * skins_.spheres;
  for (std::size_t i = section.first; i < section.last; ++i) {
    is_looked_[i] |= !(bodies.travel[i] + kTogether * bodies.pace[i] <= until_.near[i]);
    if (is_looked_[i]) {
      const double share = std::clamp(kLookSteps * bodies.pace[i], least, most + more_[i]);
      until_.near[i] = std::min({bodies.travel[i] + share, until_.spheres[i], until_.bodies[i]});
    }
    ends_[i] = {bodies, i, left(bodies, i)};
  }
}

void ContactList::share_out_walls(std::span<const Wall> walls) {
  looked_walls_.assign(walls.begin(), walls.end());
  wall_share_ = 0.0;
  for (const Wall& wall : walls)
    if (wall.present)
      wall_share_ = std::max(wall_share_,
                             std::min(kLookSteps * dt_ * wall.velocity.norm(), kMostShare * skins_.spheres));
}

void ContactList::look_at(const Bodies& bodies, bool all_walls, Section& section) {
  Section::Lists& lists = section.lists;
  for_each_let_go(lists.looked, lists.body_pairs, ends_, [&](std::size_t p) {
    const auto [i, j] = lists.body_pairs[p];
    const double slack =
        left(bodies, static_cast<std::size_t>(i)) + left(bodies, static_cast<std::size_t>(j)) + kRounding;
    lists.looked[p] = {bodies, {i, j}, slack};
    find_near(bodies, section, p, slack);
    section.changed |= lists.pair_slots[p].changed;
  });
  for (std::size_t i = section.first; i < section.last; ++i)
    if (all_walls || is_looked_[i]) look_at_walls(bodies, section, i);
}

/// All candidates of a pair of bodies, a vector at a time: their spheres are placed in registers, since most
/// are not near.
void ContactList::find_near(const Bodies& bodies, Section& section, std::size_t pair, double slack) const {
  CandidateArrays& candidates = section.lists.pairs;
  CandidateSlot& slot = section.lists.pair_slots[pair];
  slot.near = 0;
  const std::size_t begin = slot.begin, end = begin + slot.count;
  const auto i = static_cast<std::size_t>(section.lists.body_pairs[pair].i),
             j = static_cast<std::size_t>(section.lists.body_pairs[pair].j);
  const Vec3 apart = bodies.position(i) - bodies.position(j);
  const auto placed_at = [&](const std::vector<std::int32_t>& spheres, std::size_t body, std::size_t first,
                             Fields4& sphere) {
    const std::int32_t shift = local_.first_row[static_cast<std::size_t>(bodies.shape[body])] -
                               static_cast<std::int32_t>(first_sphere_[body]);
    LaneOffsets at;
    for (std::size_t lane = 0; lane < kSimdWidth; ++lane)
      at[lane] = LocalSpheres::kLine * (spheres[std::min(first + lane, end - 1)] + shift);
    sphere = load_fields4(local_.rows.data()->centre, at.data());
    sphere[3] *= SimdReal(bodies.scale[body]);
    if (!bodies.oriented) return;
    const double(&axis)[3][4] = bodies.axes[body].column;
    const SimdReal x = sphere[0], y = sphere[1], z = sphere[2];
    for (std::size_t k = 0; k < 3; ++k)
      sphere[k] = SimdReal(axis[0][k]) * x + SimdReal(axis[1][k]) * y + SimdReal(axis[2][k]) * z;
  };
  for (std::size_t first = begin; first < end; first += kSimdWidth) {
    Fields4 a, b;
    placed_at(candidates.a, i, first, a);
    placed_at(candidates.b, j, first, b);
    const SimdReal dx = a[0] - b[0] + apart.x(), dy = a[1] - b[1] + apart.y(), dz = a[2] - b[2] + apart.z();
    const SimdReal reach = a[3] + b[3] + SimdReal(slack);
    const unsigned near = less_bits(dx * dx + dy * dy + dz * dz, reach * reach);
    candidates.set_near(slot, first, std::min(kSimdWidth, end - first), near);
  }
}

void ContactList::look_at_walls(const Bodies& bodies, Section& section, std::size_t i) const {
  const double share = left(bodies, i) + wall_share_ + kRounding;
  CandidateArrays& candidates = section.lists.walls;
  CandidateSlot& slot = section.lists.wall_slots[i - section.first];
  slot.near = 0;
  for (std::size_t c = slot.begin; c < slot.begin + slot.count; ++c) {
    const PlacedSphere sphere = placed_now(bodies, i, static_cast<std::size_t>(candidates.a[c]));
    const Wall& wall = looked_walls_[static_cast<std::size_t>(candidates.b[c])];
    candidates.set_near(slot, c, 1, within_reach(wall, Vec3(sphere.centre), sphere.radius + share));
  }
  section.changed |= slot.changed;
}

/// Spheres are needed, and have a place, once all sections have said which they need.
void ContactList::find_places(const Bodies& bodies, Crew& crew) {
  each_section(crew, [&](Section& section) { collect_needed(bodies, section); });
  each_section(crew, [&](Section& section) {
    section.near_pairs.find_places(place_of_);
    section.near_walls.find_places(place_of_);
  });
}

void ContactList::flag_needed(const Section& section) {
  const auto need = [&](std::int32_t sphere) { raise(is_needed_[static_cast<std::size_t>(sphere)]); };
  for (std::size_t k = 0; k < section.near_pairs.count; ++k)
    need(section.near_pairs.sphere_a[k]), need(section.near_pairs.sphere_b[k]);
  for (std::size_t k = 0; k < section.near_walls.count; ++k) need(section.near_walls.sphere_a[k]);
}

void ContactList::collect_needed(const Bodies& bodies, Section& section) {
  section.needed.clear();
  const std::size_t begin = first_sphere_[section.first], end = first_sphere_[section.last];
  std::size_t place = begin, i = section.first;
  for_each_flag(is_needed_, begin, end, [&](std::size_t sphere) {
    while (first_sphere_[i + 1] <= sphere) ++i;
    place_of_[sphere] = static_cast<std::int32_t>(place++);
    section.needed.push_back({static_cast<std::int32_t>(i),
                              static_cast<std::int32_t>(local_row(bodies, i, sphere)),
                              static_cast<std::int32_t>(sphere)});
  });
}

}  // namespace repose
