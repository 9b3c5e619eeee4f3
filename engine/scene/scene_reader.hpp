#pragma once

#include <filesystem>

#include "engine/base/input_error.hpp"
#include "engine/scene/case_document.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/shape_cache.hpp"

namespace repose {

/// Turns a case into a scene: lengths into metres, diameters into radii, percentages into shares by number,
/// names into choices; shapes are read from their files or made. Keys, units, ranges and defaults: README.md.
///
/// Every fault of the case is added, each with its file, pointer, value and rule; after one the scene
/// returned is incomplete and must not be used. "sweep" is known here but read elsewhere.
/// @param shapes  holds the shapes already read; with one cache, the scenes of a sweep cost no reading of
/// files
Scene read_scene(const CaseDocument& document, Faults& faults, ShapeCache& shapes);
Scene read_scene(const CaseDocument& document, Faults& faults);

/// The same; throws InputError with every fault.
Scene read_scene(const CaseDocument& document);

/// Reads the case of a file. Throws InputError.
Scene read_scene(const std::filesystem::path& file);

}  // namespace repose
