#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/heap_snapshot.hpp"

namespace repose {

/// Writes a snapshot for ParaView and returns the files, NAME_spheres.vtp, NAME_bodies.vtp and NAME_walls.vtp
/// in `folder`:
/// - spheres: centre [m], `radius` [m] and `diameter` [m] (scale glyphs by it), `body`, `shape`, `velocity`
/// of the sphere's
///   centre [m/s], `speed` [m/s]
/// - bodies: centre of mass [m], `orientation` (w, x, y, z; body to world), `mass` [kg], `volume` [m³],
/// `shape`, `scale`,
///   `velocity` [m/s], `angular_velocity` [rad/s], `translational_energy` [J]
/// - walls: the base (an unbounded one as a square around the bodies) and what stands of the cylinder, as
/// polygons Throws std::runtime_error naming the file that cannot be written.
std::vector<std::filesystem::path> write_vtk(const HeapSnapshot& heap, const std::filesystem::path& folder,
                                             const std::string& name);

/// Writes the spheres as a LAMMPS text dump of one frame, columns `id type mol x y z radius vx vy vz`: OVITO
/// maps them itself. type = shape + 1, mol = body + 1, SI units; the box holds all spheres.
/// @param step  written as the frame's time step
void write_dump(const HeapSnapshot& heap, const std::filesystem::path& file, long step);

/// A time series that ParaView plays: NAME_spheres.pvd, NAME_bodies.pvd and NAME_walls.pvd in `folder`,
/// frames in `folder`/NAME_frames. The collections are complete after every call, so that an interrupted run
/// still plays.
class FrameSeries {
 public:
  /// Throws std::filesystem::filesystem_error if the folder cannot be made.
  FrameSeries(std::filesystem::path folder, std::string name);
  void add(const HeapSnapshot& heap);
  /// Keeps the frames with keep[k] ≠ 0 and removes the files of the others.
  void retain(const std::vector<char>& keep);
  [[nodiscard]] std::size_t size() const { return frames_.size(); }

 private:
  struct Frame {
    double time = 0.0;
    std::vector<std::filesystem::path> files;
  };
  void write_collections() const;

  std::filesystem::path folder_;
  std::string name_;
  int next_ = 0;
  std::vector<Frame> frames_;
};

}  // namespace repose
