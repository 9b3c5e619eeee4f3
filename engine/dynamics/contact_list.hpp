#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/contact/simd.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/cell_grid.hpp"
#include "engine/dynamics/wall.hpp"

namespace repose {

/// A sphere that some candidate needs, placed in the world; one cache line.
struct alignas(64) PlacedSphere {
  double centre[3] = {};  ///< [m]
  double radius = 0.0;    ///< [m]
  double arm[3] = {};     ///< centre of the sphere − centre of mass of its body [m]
  std::int32_t body = 0;
  std::int32_t sphere = 0;  ///< index in its clump
};

/// What a contact remembers (contact/hertz_mindlin.hpp, contact/rolling.hpp).
struct alignas(32) SpringRecord {
  double value[3] = {};
  double root = 0.0;
};
struct alignas(32) RollingRecord {
  double torque[3] = {};
  double unused = 0.0;
};

/// Candidates for contact with what they remember, as flat arrays. Entries are padded to whole blocks of
/// kBlock with pairs that never touch.
struct CandidateArrays {
  static constexpr std::size_t kBlock = 8;

  std::vector<std::int32_t> a;  ///< placed sphere of body i
  std::vector<std::int32_t> b;  ///< placed sphere of body j; for a wall candidate the wall
  std::vector<SpringRecord> spring;
  std::vector<RollingRecord> rolling;      ///< zero unless the rolling model has a spring
  std::vector<std::uint8_t> was_touching;  ///< one bit per candidate of a block, at the last step
  std::size_t count = 0;                   ///< without padding

  void clear();
  /// Adds a candidate that remembers what `from` remembers in `old`; from < 0: a new one.
  void push(std::int32_t first, std::int32_t second, const CandidateArrays& old, std::ptrdiff_t from);
  /// Fills up the last block with (first, second).
  void pad(std::int32_t first, std::int32_t second);
  [[nodiscard]] std::size_t blocks() const { return was_touching.size(); }
  [[nodiscard]] bool touched(std::size_t candidate) const {
    return (was_touching[candidate / kBlock] >> (candidate % kBlock)) & 1U;
  }
};

/// Which spheres may touch, found in two levels: pairs of bodies whose bounding spheres are near (a grid),
/// then pairs of spheres of these bodies that are near. Both levels hold for as long as no body has moved
/// beyond its share of a skin:
///
/// level 1, gap < s1 when listed, all bodies listed at once: holds while every body has moved less than s1/2.
/// level 2, gap < s2 when listed; a body that has moved is listed anew with all its pairs, the others stay.
/// Of a pair, one body i was just listed and has since moved less than its share p; the other, j, was within
/// p of its own reference then and is now, so that it moved less than 2p: 3p = s2, p = s2/3. The move of a
/// body is that of its fastest sphere: |Δx| + 2 swing sin(θ/2).
///
/// Wall candidates follow the same rule with the gap to the wall and p from each side.
class ContactList {
 public:
  static constexpr double kFarthest = 1e3;  ///< [m]

  struct Skins {
    double bodies = 0.0;   ///< s1 [m]
    double spheres = 0.0;  ///< s2 [m]
  };

  explicit ContactList(Skins skins) : skins_(skins) {}

  /// Brings the list up to date if some body or wall has moved too far since it was listed, or bodies were
  /// added. Contacts that stay keep their history. Returns false, with nothing changed, where a coordinate is
  /// not finite or farther than kFarthest from the origin: the motion has diverged.
  [[nodiscard]] bool update(const Bodies& bodies, std::span<const Wall> walls);
  /// Forces a full listing at the next update.
  void invalidate() { stale_ = true; }
  /// Follows a renumbering of bodies (Bodies::retain); dropped bodies lose their contacts.
  void renumber(std::span<const int> new_index);
  /// Wall candidates of wall `from` become those of wall `to` where the sphere's centre satisfies x·side > 0:
  /// the cylinder parts into halves and contacts keep their history.
  void hand_over_wall(int from, int to, double side);

  /// Places every sphere that a candidate needs: centre = x + Σ_k axes_k · local_k.
  void place_spheres(const Bodies& bodies);

  std::vector<PlacedSphere>
      placed;  ///< grouped by body, ascending; the last entry is a dummy that touches nothing
  CandidateArrays pairs;
  CandidateArrays wall_contacts;

  [[nodiscard]] std::span<const BodyPair> body_pairs() const { return body_pairs_; }
  [[nodiscard]] long updates() const { return updates_; }

 private:
  /// Where bodies stood when they were listed (level 2).
  struct Reference {
    std::vector<double> x, y, z, qw, qx, qy, qz;
    void resize(std::size_t entries);
  };

  [[nodiscard]] bool bodies_moved(const Bodies& bodies) const;
  [[nodiscard]] bool spheres_moved(const Bodies& bodies, double share) const;
  [[nodiscard]] SimdReal move_squared(const Bodies& bodies, std::size_t first) const;
  [[nodiscard]] bool walls_moved(std::span<const Wall> walls) const;
  void list_bodies(const Bodies& bodies);
  void flag_moved(const Bodies& bodies);
  void flag_new_pairs();
  void list_pairs(const Bodies& bodies);
  void keep_pair(std::size_t old_pair);
  void list_pair(const Bodies& bodies, const BodyPair& pair, std::ptrdiff_t old_pair);
  void list_walls(const Bodies& bodies, std::span<const Wall> walls);
  void place_all(const Bodies& bodies, std::size_t i);
  void number_placed(const Bodies& bodies);

  Skins skins_;
  bool stale_ = true;
  long updates_ = 0;

  std::vector<double> listed_x_, listed_y_, listed_z_;  ///< level 1 references
  Reference listed_;                                    ///< level 2 references
  std::vector<Wall> listed_walls_;

  std::vector<std::array<double, 4>> local_;  ///< scaled centres of the placed spheres in their bodies [m]

  std::vector<BodyPair> body_pairs_;
  std::vector<std::size_t> pair_begin_;  ///< candidates of body pair p: pair_begin_[p] … pair_begin_[p+1]−1

  // Scratch of one listing, kept to save allocations.
  std::vector<char> moved_;  ///< bodies to list anew
  std::vector<std::int32_t> near_a_, near_b_;
  std::vector<std::size_t> first_sphere_;  ///< of each body among all spheres
  std::vector<char> all_placed_;           ///< bodies whose spheres are all placed in this listing
  std::vector<PlacedSphere> all_;          ///< every sphere of these bodies
  std::vector<std::int32_t> number_;       ///< placed number of each sphere of all bodies, −1: not needed
  CandidateArrays old_;
  std::vector<BodyPair> old_body_pairs_;
  std::vector<std::size_t> old_pair_begin_;
  std::vector<PlacedSphere> old_placed_;
};

}  // namespace repose
