#include "engine/scene/tidy_path.hpp"

namespace repose {

namespace fs = std::filesystem;

fs::path tidy(const fs::path& path) {
  const fs::path by_letters = path.lexically_normal();
  std::error_code error;
  if (fs::equivalent(path, by_letters, error)) return by_letters;
  const bool names_nothing = !fs::exists(path, error) && !fs::exists(by_letters, error);
  return names_nothing ? by_letters : path;
}

}  // namespace repose
