#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/shape/clump.hpp"

namespace repose {

// A clump for other programs. Each gives the text of one file; lengths in m. Inner spheres are left out, as
// nothing touches them.

/// VTK legacy polydata: one point a sphere with its radius. ParaView draws it with Glyph, sphere, scaled by
/// `radius` times 2.
std::string vtk_text(const Clump& clump);

/// LIGGGHTS: file of `fix particletemplate/multisphere … spheres file`, a line x y z r a sphere. The mass
/// properties of the mesh stand in the comment as the keywords that hand them over (mass, inertia_tensor,
/// use_density); without them LIGGGHTS samples the union of spheres.
std::string liggghts_text(const Clump& clump, double density);

/// YADE: file of `ymport.textClumps`, a line x y z r clumpId a sphere.
std::string yade_text(const Clump& clump);

/// MercuryDPM: the files of one clump as its MClump tool leaves them (Clump/Clump.txt, Inertia/Mass.txt,
/// Inertia/TOI.txt, Inertia/PD.txt), written into a folder of the clump's name below `folder`.
/// Throws InputError where a file cannot be written.
void write_mercury(const std::filesystem::path& folder, const Clump& clump, double density);

/// Writes a text to a file, whose folder is made. Throws InputError where it cannot be written.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace repose
