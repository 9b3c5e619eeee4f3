#pragma once

#include <filesystem>

namespace repose {

/// A path without "." and ".." where it then still names the same file: behind a folder that is a link, ".."
/// leads to the parent of the folder that the link names. A path that names nothing is tidied by its letters.
std::filesystem::path tidy(const std::filesystem::path& path);

}  // namespace repose
