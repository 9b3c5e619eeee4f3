#pragma once

#include <string>

#include "engine/scene/scene.hpp"

namespace repose {

/// Everything of a scene that can change a result, as one line of JSON whose doubles round-trip: the spheres
/// and the mass properties of the shapes included, names and the title left out. Two scenes have the same
/// text exactly if they are the same to the engine.
std::string canonical_text(const Scene& scene);

/// 32 hexadecimal digits: XXH3 with 128 bits. The same text has the same digest on every machine.
std::string digest(const std::string& text);

}  // namespace repose
