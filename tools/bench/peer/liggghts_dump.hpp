#pragma once

#include <filesystem>
#include <vector>

#include "engine/scene/heap_snapshot.hpp"
#include "engine/scene/scene.hpp"
#include "tools/bench/peer/templates.hpp"

namespace repose::peer {

/// Reads the last frame of a LAMMPS or LIGGGHTS text dump as bodies of the kinds given.
///
/// Columns, in any order: id x y z radius; id_multisphere groups spheres into bodies (without it, or where it
/// is negative, each sphere is a body); vx vy vz omegax omegay omegaz give velocities (0 where they are
/// missing). The spheres of a body, in the order of their ids, are those of its kind; position and
/// orientation are the rigid motion that takes the kind's spheres to them (least squares, Umeyama 1991).
/// Bodies that are below the base's top as a whole are left out, as Repose does. Throws InputError: a column
/// or frame missing, a body that is of no kind or not rigid.
HeapSnapshot read_liggghts_dump(const std::filesystem::path& file, const std::vector<Template>& kinds,
                                const SlumpTest& test);

/// Mean kinetic energy of a body over m g d, d the diameter of the sphere of equal volume: what Repose calls
/// rest is below Numerics::rest_energy_ratio. Bodies beyond the edge of the base do not count.
double energy_ratio(const HeapSnapshot& heap, const std::vector<Template>& kinds, double density);

}  // namespace repose::peer
