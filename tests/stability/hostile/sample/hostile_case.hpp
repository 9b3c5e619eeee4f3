#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "engine/scene/case_document.hpp"

namespace repose::hostile {

/// One case of the sample: what a user could write, however unwise.
struct HostileCase {
  CaseDocument::Json json;
  std::uint64_t seed = 1;  ///< of its run
};

/// Case `index` of the sample `seed`: the same on every machine.
///
/// The share of the values that leave the sensible ranges is kBoldness[index % 4]. Far ranges: steps of 0.01
/// to 5 T_R, stiffness 1e-7 to 10, e with 0 and 1 themselves, μs and μr up to 5 with 0 itself, a sphere of
/// 0.03 of its clump's size, diameters of 1 : 20, opening at 0.01 to 100 m/s. A case that would take more
/// than about a second where all goes well is drawn again.
/// @param root  the project's folder, for the clumps
inline constexpr std::array<double, 4> kBoldness{0.03, 0.06, 0.12, 1.0};
HostileCase hostile_case(std::uint64_t seed, std::uint64_t index, const std::string& root);

/// The same case with a quarter of the step.
HostileCase with_a_quarter_of_the_step(HostileCase hostile);
}  // namespace repose::hostile
