#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/crew.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/local_spheres.hpp"
#include "engine/dynamics/reaching.hpp"
#include "engine/dynamics/section.hpp"
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
/// used up its share of the gap between them. Of a body that has, those pairs are found anew whose two may by
/// then have moved against each other by more than their lists allow (Tether): most neighbours in a flow go
/// the same way.
///
/// 1: a share is skins.bodies/2; the neighbours of bodies that have used it up, or nearly so, are found anew.
/// 2: a share is skins.spheres/4, more for a fast body; the candidates of a pair are right while the two have
///    moved against each other by skins.spheres, and those at walls while the body has travelled
///    skins.spheres/2. Of a fast body these are longer by twice what its share is.
/// 3: a share is what the body travels in some steps at its present pace. A candidate is near unless its
///    gap is beyond what both bodies have left of their shares. At rest a look lasts thousands of steps.
///
/// Wall candidates follow the same rules with the wall as the second body. Candidates are sorted by bodies
/// and spheres, so that results do not depend on skins or shares to the last bit. They are kept by sections
/// of bodies, which the members of a crew work through at the same time.
class ContactList {
 public:
  static constexpr double kFarthest = 1e3;  ///< [m]
  /// What is added to a threshold against rounding [m]: far above that of coordinates of kFarthest.
  static constexpr double kRounding = 1e-12;

  struct Skins {
    double bodies = 0.0;   ///< s1 [m]
    double spheres = 0.0;  ///< s2 [m]
  };

  /// @param shapes          those of the bodies (Bodies::shapes)
  /// @param dt              Δt [s]
  /// @param rolls           contacts remember a rolling spring
  /// @param section_bodies  of each section, a multiple of Bodies::kPadding
  ContactList(std::span<const Clump> shapes, Skins skins, double dt, bool rolls, std::size_t section_bodies)
      : skins_(skins), dt_(dt), rolls_(rolls), section_bodies_(section_bodies), local_(shapes) {}

  /// Brings all levels up to date where some body or wall has used up its share. Contacts that stay keep
  /// their history. Returns false, with nothing changed, where a coordinate is not finite or farther than
  /// kFarthest from the origin: the motion has diverged.
  [[nodiscard]] bool update(const Bodies& bodies, std::span<const Wall> walls, Crew& crew);
  /// A body was appended (Bodies::add).
  void add_body(const Bodies& bodies);
  /// Follows a renumbering of bodies (Bodies::retain); dropped bodies lose their contacts.
  void renumber(const Bodies& bodies, std::span<const int> new_index, Crew& crew);
  /// Wall candidates of wall `from` become those of wall `to` where the sphere's centre satisfies x·side > 0:
  /// the cylinder parts into halves and contacts keep their history.
  void hand_over_wall(int from, int to, double side);

  /// Places every sphere of a section that a near candidate needs.
  void place_spheres(const Bodies& bodies, const Section& section);

  /// The spheres that near candidates need, behind the dummy at 0 that touches nothing. Those of a section
  /// lie side by side, in the order of Section::needed; there is room for all its spheres, of which only what
  /// is used is ever touched. As of the last step.
  RecordVector<PlacedSphere> placed{1};
  std::vector<Section> sections;  ///< by their bodies; only the last is not full

  /// visit(list, k) for every pair that touched at the last step, ascending.
  template <class Visit>
  void for_each_pair(Visit visit) const {
    for (const Section& section : sections) section.near_pairs.for_each_touched(visit);
  }
  /// The same for spheres at walls.
  template <class Visit>
  void for_each_at_wall(Visit visit) const {
    for (const Section& section : sections) section.near_walls.for_each_touched(visit);
  }

  [[nodiscard]] long updates() const { return updates_; }  ///< of candidates
  [[nodiscard]] long looks() const { return looks_; }      ///< of near candidates
  /// Grows whenever sections or what is near in them change.
  [[nodiscard]] long changes() const { return changes_; }

 private:
  /// What a body may travel before it is looked at again, as a value of Bodies::travel [m]; +∞ behind the
  /// last body, −1 for a new one. `walls`: until its candidates at walls are found anew. near ≤ spheres ≤
  /// bodies, walls.
  struct Until {
    std::vector<double> bodies, spheres, walls, near;
    void resize(std::size_t count, std::size_t padded);
  };

  [[nodiscard]] bool any_used_up(const Bodies& bodies) const;
  [[nodiscard]] static bool walls_moved(std::span<const Wall> now, std::span<const Wall> then, double share);
  [[nodiscard]] std::size_t local_row(const Bodies& bodies, std::size_t i, std::size_t sphere) const;
  [[nodiscard]] PlacedSphere placed_now(const Bodies& bodies, std::size_t i, std::size_t sphere) const;
  template <class Work>
  void each_section(Crew& crew, Work work) {
    crew.each(sections.size(), [&](std::size_t s) { work(sections[s]); });
  }

  // Bodies that go.
  struct Renumbering;
  Renumbering move_spheres(std::span<const int> new_index);
  void move_lists(const Renumbering& to, std::size_t first_section);
  void move_placed(const Renumbering& from);
  void move_candidates(const Renumbering& to, const Section& from);
  void move_contacts(const Renumbering& to, const Section& from);
  [[nodiscard]] Section& section_of(std::size_t body) { return sections[body / section_bodies_]; }

  // Level 1.
  [[nodiscard]] static SearchSpheres search_spheres(const Bodies& bodies);

  // Level 2.
  struct Relist {
    bool bodies = false;  ///< level 1 first
    bool walls = false;   ///< the wall candidates of all bodies
  };
  void list_candidates(const Bodies& bodies, std::span<const Wall> walls, Relist anew, Crew& crew);
  /// Of its candidates: skins.spheres, and the more if it has a longer share.
  [[nodiscard]] double skin_of(std::size_t i) const { return skins_.spheres + 2.0 * more_[i]; }
  void share_out_pairs(const Bodies& bodies);
  void flag_searched(const Bodies& bodies);
  void search(const CellGrid& grid, Section& section) const;
  [[nodiscard]] std::vector<BodyPair> found_for(const Section& section) const;
  void take_found(Section& section);
  [[nodiscard]] bool in_reach(const Bodies& bodies, const BodyPair& pair, double skin) const;
  void list_pairs(const Bodies& bodies, Section& section);
  void list_walls(const Bodies& bodies, std::span<const Wall> walls, bool all, Section& section);
  void list_walls_of(const Bodies& bodies, std::size_t i, std::span<const Wall> walls,
                     CandidateArrays& to) const;
  void list_pair(const Bodies& bodies, const BodyPair& pair, double skin, Reaching& of_i, Reaching& of_j,
                 CandidateArrays& to) const;

  // Level 3.
  void look_near(const Bodies& bodies, std::span<const Wall> walls, bool all_walls, Crew& crew);
  void share_out(const Bodies& bodies, const Section& section);
  void share_out_walls(std::span<const Wall> walls);
  void look_at(const Bodies& bodies, bool all_walls, Section& section);
  void find_near(const Bodies& bodies, Section& section, std::size_t pair, double slack) const;
  void look_at_walls(const Bodies& bodies, Section& section, std::size_t i) const;
  void find_places(const Bodies& bodies, Crew& crew);
  void flag_needed(const Section& section);
  void collect_needed(const Bodies& bodies, Section& section);
  [[nodiscard]] double left(const Bodies& bodies, std::size_t i) const {
    return until_.near[i] - bodies.travel[i];
  }

  Skins skins_;
  double dt_;
  bool rolls_;
  std::size_t section_bodies_;
  bool renumbered_ = true;  ///< bodies or walls have other numbers than when candidates were listed
  long updates_ = 0, looks_ = 0, changes_ = 0;

  Until until_;
  std::vector<Wall> listed_walls_;  ///< as of the last listing
  std::vector<Wall> looked_walls_;  ///< as of the last look at all of them
  std::vector<double> more_;        ///< of each body, by how much its last share on level 2 was longer [m]
  std::vector<TetherEnd> ends_;     ///< of the bodies, for the level under way
  double wall_share_ = 0.0;         ///< what a wall may move until the next look [m]

  /// Spheres of all bodies are numbered body by body, from 1 on: of each body the first, and one past the
  /// last.
  std::vector<std::size_t> first_sphere_{1};
  std::vector<std::int32_t> place_of_{0};  ///< of each sphere that is needed, in `placed`
  LocalSpheres local_;

  // Flags of bodies and spheres; those that several sections may raise are raised by raise().
  using Flag = std::uint8_t;
  static void raise(Flag& flag);
  std::vector<Flag> is_needed_{0};  ///< spheres
  std::vector<Flag> is_searched_;   ///< bodies whose pairs are found anew
  std::vector<Flag> is_looked_;
};

}  // namespace repose
