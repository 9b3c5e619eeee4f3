#pragma once

#include <filesystem>
#include <string>

#include "engine/base/input_error.hpp"

namespace repose::program {

/// A fault if files could not be written into the folder (it or the nearest folder above it that exists is no
/// folder or is not writable). Changes nothing on the disk.
void check_folder(Faults& faults, const std::filesystem::path& folder);
/// The same for a file that is to be written.
void check_output_file(Faults& faults, const std::filesystem::path& file);

/// Makes the folder and those above it. Throws InputError where that fails.
void make_folder(const std::filesystem::path& folder);

/// Writes the whole file or nothing: under a name beside it, then renamed. Throws std::runtime_error.
void write_file(const std::filesystem::path& file, const std::string& text);

}  // namespace repose::program
