#pragma once

#include <filesystem>

#include "engine/scene/case_document.hpp"
#include "sweep/ladder.hpp"

namespace repose::chart {

/// A case that inherits from another and sets what a reference and a rung set on top of it: to be written
/// into `folder`, from which its paths are relative. It holds what differs, and null for what is not there
/// any more; lists whole, because a case replaces the lists that it inherits.
/// @param document   of the case that it inherits from, document.file()
/// @param variants   in their order, with absolute paths; Override::place tells their settings apart, so that
///                   of two rival keys the later removes the earlier
CaseDocument::Json chosen_case(const CaseDocument& document, const std::vector<sweep::Variant>& variants,
                               const std::filesystem::path& folder, const std::string& title);

}  // namespace repose::chart
