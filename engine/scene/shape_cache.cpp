#include "engine/scene/shape_cache.hpp"

#include "engine/base/input_error.hpp"
#include "engine/shape/clump_generator.hpp"
#include "engine/shape/mesh_file.hpp"

namespace repose {

namespace {

template <class Key, class Make>
const Clump& found_or_made(std::map<Key, Clump>& clumps, const Key& key, Make make) {
  const auto found = clumps.find(key);
  return found != clumps.end() ? found->second : clumps.emplace(key, make()).first->second;
}

}  // namespace

const Clump& ShapeCache::clump(const std::filesystem::path& file) {
  return found_or_made(clumps_, {file.string(), 0, 0.0}, [&] { return read_clump(file); });
}

const Clump& ShapeCache::clump_of_mesh(const std::filesystem::path& file, int spheres,
                                       std::optional<double> metres_per_unit) {
  return found_or_made(clumps_, {file.string(), spheres, metres_per_unit.value_or(0.0)}, [&] {
    ClumpOptions options;
    options.spheres = spheres;
    const Mesh mesh = read_mesh(file, metres_per_unit);
    try {
      return generate_clump(mesh, options).clump;
    } catch (const InputError& error) {
      throw error.in_file(file.string());
    }
  });
}

}  // namespace repose
