#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/case_document.hpp"

namespace repose::sweep {

/// A case that needs nothing beside its own folder.
struct SelfContained {
  struct File {
    std::filesystem::path from;
    std::string to;  ///< relative to the case
  };
  CaseDocument document;  ///< every path in it is one of the files'
  std::vector<File> files;
};

/// The case as it would stand in a folder, with all that it inherits and the clumps, meshes and tables that
/// it names as files/<name>-<hash of the content>. Writes nothing. Throws InputError where a file cannot be
/// read.
SelfContained self_contained(const CaseDocument& document, const std::filesystem::path& folder);

/// Copies the files of a case to a folder, those that are not there yet. Throws
/// std::filesystem::filesystem_error.
void copy_files(const SelfContained& self_contained, const std::filesystem::path& folder);

/// Replaces a file whole: a reader finds the old text or the new, never a part. Throws std::runtime_error.
void replace_file(const std::filesystem::path& file, const std::string& text);

}  // namespace repose::sweep
