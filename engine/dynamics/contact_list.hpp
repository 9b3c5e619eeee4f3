#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/candidates.hpp"
#include "engine/dynamics/cell_grid.hpp"
#include "engine/dynamics/wall.hpp"

namespace repose {

/// Which spheres may touch, found in three levels, each a small part of the one above:
///
/// 1 bodies      pairs of bodies whose bounding spheres are nearer than skins.bodies (a grid);
/// 2 candidates  pairs of spheres of these bodies that are nearer than skins.spheres;
/// 3 near        candidates that may touch before one of their bodies is looked at again. Only these cost
///               time in a step.
///
/// What bounds a body's motion is Bodies::travel, the path of its fastest point. At each level a body may
/// travel its share of a gap before it is looked at again, and two bodies cannot meet before one of them has
/// used up its share of the gap between them:
///
/// 1: a share is skins.bodies/2; all bodies are listed at once.
/// 2: a share is skins.spheres/2; a body that has used it up is listed anew with all its pairs.
/// 3: a share is what the body travels in some steps at its present pace. A candidate is near unless its
///    gap is beyond what both bodies have left of their shares. At rest a look lasts thousands of steps.
///
/// Wall candidates follow the same rules with the wall as the second body. Candidates are sorted by bodies
/// and spheres, so that results do not depend on skins or shares to the last bit.
class ContactList {
 public:
  static constexpr double kFarthest = 1e3;  ///< [m]

  struct Skins {
    double bodies = 0.0;   ///< s1 [m]
    double spheres = 0.0;  ///< s2 [m]
  };

  /// @param dt     Δt [s]
  /// @param rolls  contacts remember a rolling spring
  ContactList(Skins skins, double dt, bool rolls)
      : near_pairs(false, rolls),
        near_walls(true, rolls),
        skins_(skins),
        dt_(dt),
        old_near_pairs_(false, rolls),
        old_near_walls_(true, rolls) {}

  /// Brings all levels up to date where some body or wall has used up its share. Contacts that stay keep
  /// their history. Returns false, with nothing changed, where a coordinate is not finite or farther than
  /// kFarthest from the origin: the motion has diverged.
  [[nodiscard]] bool update(const Bodies& bodies, std::span<const Wall> walls);
  /// A body was appended (Bodies::add).
  void add_body(const Bodies& bodies);
  /// Follows a renumbering of bodies (Bodies::retain); dropped bodies lose their contacts.
  void renumber(const Bodies& bodies, std::span<const int> new_index);
  /// Wall candidates of wall `from` become those of wall `to` where the sphere's centre satisfies x·side > 0:
  /// the cylinder parts into halves and contacts keep their history.
  void hand_over_wall(int from, int to, double side);

  /// Places every sphere that a near candidate needs: centre = x + Σ_k axes_k · local_k.
  void place_spheres(const Bodies& bodies);

  /// All spheres, grouped by body, ascending, behind the dummy at 0 that touches nothing. Up to date where a
  /// near candidate needs it. Only lines that are needed are ever touched, which is why the array may hold
  /// all.
  std::vector<PlacedSphere> placed{1};
  NearList near_pairs;
  NearList near_walls;

  [[nodiscard]] std::span<const BodyPair> body_pairs() const { return body_pairs_; }
  [[nodiscard]] long updates() const { return updates_; }  ///< of candidates
  [[nodiscard]] long looks() const { return looks_; }      ///< of near candidates

 private:
  /// What a body may travel before it is looked at again, as a value of Bodies::travel [m]; +∞ behind the
  /// last body, −1 for a new one. near ≤ spheres ≤ bodies.
  struct Until {
    std::vector<double> bodies, spheres, near;
    void resize(std::size_t count, std::size_t padded);
  };

  [[nodiscard]] bool any_used_up(const Bodies& bodies) const;
  [[nodiscard]] static bool walls_moved(std::span<const Wall> now, std::span<const Wall> then, double share);
  void append_spheres(const Bodies& bodies, std::size_t i);
  void copy_shapes(const Bodies& bodies);
  struct Renumbering;
  Renumbering move_spheres(std::span<const int> new_index);
  void renumber_candidates(const Renumbering& to);
  void place(const Bodies& bodies, std::size_t sphere);

  // Level 1.
  void list_bodies(const Bodies& bodies);
  void link_pairs(std::size_t count);

  // Level 2.
  /// Returns whether the walls' candidates were all listed anew.
  bool list_candidates(const Bodies& bodies, std::span<const Wall> walls, bool bodies_listed);
  void flag_moved(const Bodies& bodies);
  void flag_new_pairs();
  void list_pairs(const Bodies& bodies);
  void list_pair(const Bodies& bodies, const BodyPair& pair);
  bool list_walls(const Bodies& bodies, std::span<const Wall> walls);
  void list_walls_of(const Bodies& bodies, std::size_t i, std::span<const Wall> walls);
  void place_all(const Bodies& bodies, std::size_t i);
  /// Spheres of one body that reach into the bounding sphere of another.
  struct Reaching {
    std::vector<std::int32_t> sphere;     ///< in `placed`
    std::vector<double> x, y, z, radius;  ///< padded to whole vectors with spheres that are far from all
    std::size_t count = 0;
  };
  void find_reaching(const Bodies& bodies, std::size_t of, std::size_t into, Reaching& found) const;

  // Level 3.
  void look_near(const Bodies& bodies, std::span<const Wall> walls, bool walls_used_up);
  void share_out(const Bodies& bodies);
  void look_at_pair(const Bodies& bodies, std::size_t pair);
  void look_at_walls(const Bodies& bodies, std::size_t i);
  void gather_near();
  [[nodiscard]] double left(const Bodies& bodies, std::size_t i) const {
    return until_.near[i] - bodies.travel[i];
  }

  Skins skins_;
  double dt_;
  bool renumbered_ = true;  ///< bodies or walls have other numbers than when candidates were listed
  long updates_ = 0, looks_ = 0;

  Until until_;
  std::vector<Wall> listed_walls_;  ///< as of the last listing
  std::vector<Wall> looked_walls_;  ///< as of the last look at all of them
  double wall_share_ = 0.0;         ///< what a wall may move until the next look [m]

  std::vector<std::size_t> first_sphere_{1};  ///< of each body in `placed`, and one past the last
  std::vector<LocalSphere> local_;            ///< of all shapes, of scale 1
  std::vector<std::int32_t> local_of_shape_;  ///< where each shape's begin
  CandidateArrays pairs_, walls_;             ///< of pairs of bodies, of bodies and walls
  std::vector<BodyPair> body_pairs_;          ///< sorted
  std::vector<std::size_t> pair_first_;  ///< pairs with body i as first: pair_first_[i] … pair_first_[i+1]−1
  std::vector<std::size_t> second_first_, second_;  ///< pairs with body i as second, in the same way
  std::vector<std::size_t> pair_begin_{
      0};  ///< candidates of body pair p: pair_begin_[p] … pair_begin_[p+1]−1
  std::vector<std::size_t> wall_begin_{0};  ///< wall candidates of body i, in the same way
  std::vector<std::int32_t> needed_;        ///< placed spheres that a near candidate needs
  std::vector<std::uint8_t> is_needed_{0};

  // Scratch of one listing or look, kept to save allocations.
  std::vector<char> moved_;       ///< bodies to list anew
  std::vector<char> all_placed_;  ///< bodies whose spheres are all placed in this listing
  std::vector<std::size_t> looked_;
  std::vector<char> is_looked_;
  std::vector<std::size_t> next_;
  Reaching reach_a_, reach_b_;
  CandidateArrays old_;
  NearList old_near_pairs_, old_near_walls_;
  std::vector<BodyPair> old_body_pairs_;
  std::vector<std::size_t> old_pair_begin_, old_wall_begin_;
};

}  // namespace repose
