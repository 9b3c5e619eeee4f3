#pragma once

#include <vector>

#include "engine/base/input_error.hpp"
#include "engine/scene/case_document.hpp"

namespace repose::sweep {

/// What makes two cases different tests, one fault for each difference (none: runs of both may stand in one
/// study). The design, the title and the three friction values of particles do not count, nor does how a case
/// is written: keys in another order, a default given or left out, 1 or 1.0, a file of the same content
/// elsewhere.
/// @param of_study  the case of a study, as its folder holds it
/// Throws InputError where a file that `given` names cannot be read.
std::vector<Fault> differences(const CaseDocument& of_study, const CaseDocument& given);

}  // namespace repose::sweep
