#include "tools/bench/peer/templates.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/input_error.hpp"
#include "engine/slump/pour.hpp"

namespace repose::peer {

namespace {

Clump scaled(Clump clump, double s) {
  for (Sphere& sphere : clump.spheres) {
    sphere.centre *= s;
    sphere.radius *= s;
  }
  clump.volume *= s * s * s;
  clump.inertia *= s * s * s * s * s;
  return clump;
}

}  // namespace

std::vector<Template> templates_of(const Scene& scene, std::uint64_t seed) {
  for (const SizeClass& size : scene.particles.size_classes)
    if (size.volume_min != size.volume_max)
      throw InputError(
          {"", "/particles/size_classes", "",
           "LIGGGHTS has no sizes drawn from a range: give one diameter, or leave size_classes out"});
  std::vector<Template> templates;
  const Pour pour(scene, seed);
  for (const ParticleDraw& draw : pour.particles()) {
    auto found = std::find_if(templates.begin(), templates.end(), [&](const Template& known) {
      return known.shape == draw.shape && known.scale == draw.scale;
    });
    if (found == templates.end()) {
      Template fresh;
      fresh.shape = draw.shape;
      fresh.scale = draw.scale;
      fresh.clump = scaled(scene.particles.shapes[static_cast<std::size_t>(draw.shape)], draw.scale);
      fresh.mass = draw.mass;
      fresh.volume = fresh.clump.volume;
      found = templates.insert(templates.end(), fresh);
    }
    ++found->count;
  }
  return templates;
}

bool all_spheres(const std::vector<Template>& templates) {
  return std::all_of(templates.begin(), templates.end(), [](const Template& kind) {
    return kind.clump.spheres.size() == 1 && kind.clump.spheres.front().centre.norm() == 0.0;
  });
}

double largest_reach(const std::vector<Template>& templates) {
  double reach = 0.0;
  for (const Template& kind : templates) reach = std::max(reach, kind.clump.bounding_radius());
  return reach;
}

}  // namespace repose::peer
