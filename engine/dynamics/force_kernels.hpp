#pragma once

#include <bit>
#include <span>
#include <vector>

#include "engine/contact/contact_law.hpp"
#include "engine/dynamics/bodies.hpp"
#include "engine/dynamics/contact_list.hpp"
#include "engine/dynamics/simd_records.hpp"

namespace repose {

/// Everything that the force kernels of one step read and write.
struct ForceStep {
  LawParameters pair_law;
  LawParameters wall_law;
  double dt = 0.0;
  bool leads = false;  ///< damping is given velocities with Bodies::lead added (velocity_verlet)
  double lag = 0.0;    ///< ContactTiming::lag
  bool booked = true;  ///< whether the kernels return their work; zero otherwise
};

/// Work of all contacts of one step, see ContactPower; `wall` is what moving walls did on the bodies [J].
struct ContactWork {
  double normal_damping = 0.0, tangential_damping = 0.0, spring = 0.0, rolling = 0.0, wall = 0.0;

  ContactWork& operator+=(const ContactWork& more) {
    normal_damping += more.normal_damping, tangential_damping += more.tangential_damping;
    spring += more.spring, rolling += more.rolling, wall += more.wall;
    return *this;
  }
};

/// The contacts of a step, ascending by candidate, as offsets of their records in doubles; padded with the
/// last one to whole vectors. Kept from step to step, so that a step allocates nothing.
struct TouchingList {
  std::vector<std::int32_t> history;             ///< of SpringRecord and RollingRecord
  std::vector<std::int32_t> placed_a, placed_b;  ///< of PlacedSphere; at a wall b is the wall's number
  std::vector<std::int32_t> body_a, body_b;      ///< of BodyMotion, BodyLoad and BodyLead
  std::size_t count = 0;

  void start(std::size_t most);
  /// Appends the candidates of a block whose bit is set.
  void take(const NearList& near, std::size_t block, unsigned bits) {
    const std::size_t first = block * NearList::kBlock;
    const KeptLanes kept(bits);
    kept.copy_multiples(NearList::kRecord, static_cast<std::int32_t>(first), history.data() + count);
    kept.copy(near.placed_a.data() + first, placed_a.data() + count);
    kept.copy(near.placed_b.data() + first, placed_b.data() + count);
    kept.copy(near.body_a.data() + first, body_a.data() + count);
    kept.copy(near.body_b.data() + first, body_b.data() + count);
    count += static_cast<std::size_t>(std::popcount(bits));
  }
  void finish();
};

/// What contacts of one share put on bodies of others, in the order of the contacts. These bodies have
/// smaller numbers than those of the share, because a contact belongs to its body of the greater number. So a
/// body's loads are added up in one order whatever the shares: first its own contacts, then those with bodies
/// of greater numbers, ascending.
struct LoadsBeyond {
  std::int32_t first = 0;          ///< offset of the first BodyLoad of the share
  std::vector<std::int32_t> body;  ///< offset of the BodyLoad of each of the others
  std::vector<BodyLoad> load;

  void start(std::int32_t first_of_share) { first = first_of_share, body.clear(), load.clear(); }
};

struct TouchingWalls : TouchingList {
  std::vector<double> nx, ny, nz, overlap;  ///< geometry at the wall
};

/// The kernels of one rolling model. Each returns the work of a section's contacts, adds forces and torques
/// to Bodies::load, or to `beyond`, and brings the history of its contacts to this step; contacts are taken
/// in the order of the candidates, so sums do not depend on how they are grouped.
struct ForceKernels {
  using Placed = std::span<const PlacedSphere>;
  ContactWork (*pairs)(const ForceStep&, Bodies&, Placed, NearList& near, TouchingList&,
                       LoadsBeyond& beyond) = nullptr;
  ContactWork (*walls)(const ForceStep&, Bodies&, Placed, NearList& near, std::span<const Wall>,
                       TouchingWalls&) = nullptr;
};

/// The kernels for a rolling model, chosen once per run. Contacts at walls, few beside those of pairs, are
/// computed in double precision always.
ForceKernels force_kernels(RollingModel model, Arithmetic arithmetic);

template <RollingModel kModel>
ForceKernels make_force_kernels(Arithmetic arithmetic);

}  // namespace repose
