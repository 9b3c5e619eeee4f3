#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/case_document.hpp"
#include "sweep/store.hpp"

namespace repose::sweep {

/// Copy of the case in a study's folder, and the folder for the files that it names.
inline constexpr const char* kCaseFile = "case.json";
inline constexpr const char* kCaseFiles = "files";

/// A study's folder: the store and the case. The folder holds all that the study needs and can be moved: the
/// case in it inherits from nothing, and the clumps, meshes and tables that it names are copied to files/,
/// under names that end in a hash of their content.
struct Study {
  std::filesystem::path folder;
  Store store;
  CaseDocument document;  ///< paths in it are found from the folder
};

/// Opens a study. Throws InputError as Store::open() does, and where it holds no case.
Study open_study(const std::filesystem::path& folder);

/// Opens the study of a case in a folder, or makes it. A study goes on with a case whose design has changed:
/// only /sweep, the title and the three friction values (e_pp, mu_s, mu_r: every run records them) may differ
/// from the case that it was made from. The case in the folder is then replaced. Throws InputError, and
/// changes nothing: the folder is a file, holds another case's study (each difference is named) or a
/// case.json that belongs to no study; the store cannot be used (Store::open).
Study open_or_create_study(const std::filesystem::path& folder, const CaseDocument& document);

/// The runs of a study, by point and replicate; a run that a later version of the program has made again, or
/// a build for another instruction set (succeeds()), or whose place in the design another has taken, is
/// marked `superseded`.
std::vector<StoredRun> runs_of(const Store& store);

}  // namespace repose::sweep
