#include "tools/program/output_folder.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace repose::program {

namespace fs = std::filesystem;

namespace {

/// The folder itself or the nearest above it that exists.
fs::path nearest_existing(const fs::path& folder) {
  fs::path at = fs::absolute(folder).lexically_normal();
  std::error_code error;
  while (!fs::exists(at, error) && at.has_parent_path() && at != at.parent_path()) at = at.parent_path();
  return at;
}

}  // namespace

void check_folder(Faults& faults, const fs::path& folder) {
  if (folder.empty()) {
    faults.add("--out", "", "", "needs the name of a folder");
    return;
  }
  const fs::path existing = nearest_existing(folder);
  if (!fs::is_directory(existing))
    faults.add(folder.string(), "", "", "cannot be written: " + existing.string() + " is not a folder");
  else if (access(existing.c_str(), W_OK | X_OK) != 0)
    faults.add(folder.string(), "", "",
               "cannot be written: " + existing.string() + ": " + std::strerror(errno));
}

void check_output_file(Faults& faults, const fs::path& file) {
  if (fs::is_directory(file)) {
    faults.add(file.string(), "", "", "cannot be written: it is a folder");
    return;
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
    faults.add(file.string(), "", "", "cannot be written: there is no folder " + folder.string());
  else if (access(folder.c_str(), W_OK | X_OK) != 0 || (fs::exists(file) && access(file.c_str(), W_OK) != 0))
    faults.add(file.string(), "", "", std::string("cannot be written: ") + std::strerror(errno));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError({folder.string(), "", "", "cannot be written: " + error.message()});
}

void write_file(const fs::path& file, const std::string& text) {
  const fs::path part = file.string() + ".part";
  std::ofstream stream(part, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(part.string() + ": cannot be written");
  fs::rename(part, file);
}

}  // namespace repose::program
