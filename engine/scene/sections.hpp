#pragma once

#include "engine/scene/checked_case.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/shape_cache.hpp"

// One reader a section of a case. Each adds the faults that its values make together and returns what could
// be read.

namespace repose {

/// Where the size classes of a case stand.
inline constexpr const char* kClasses = "/particles/size_classes";

/// Density, modulus and Poisson's ratio of "/particles" or "/walls".
Material read_material(const CheckedCase& checked, const std::string& section);
Particles read_particles(CheckedCase& checked, ShapeCache& shapes);
std::vector<SizeClass> read_size_classes(CheckedCase& checked);
ContactModel read_contact(const CheckedCase& checked);
SlumpTest read_test(CheckedCase& checked);
Numerics read_numerics(CheckedCase& checked);
MeasureOptions read_measure(CheckedCase& checked);

/// Rules between the particles and the precision that they are computed in.
void check_arithmetic(CheckedCase& checked, const Particles& particles, Arithmetic arithmetic);
/// Rules between the particles and the test that they are poured into.
void check_fit(CheckedCase& checked, const Particles& particles, const SlumpTest& test);

}  // namespace repose
