#include "engine/scene/scene_reader.hpp"

#include "engine/scene/checked_case.hpp"
#include "engine/scene/sections.hpp"

namespace repose {

Scene read_scene(const CaseDocument& document, Faults& faults, ShapeCache& shapes) {
  CheckedCase checked(document, faults);
  Scene scene;
  scene.title = checked.text("/title").value_or("");
  scene.particles = read_particles(checked, shapes);
  scene.walls = read_material(checked, "/walls");
  scene.contact = read_contact(checked);
  scene.test = read_test(checked);
  scene.numerics = read_numerics(checked);
  scene.measure = read_measure(checked);
  check_arithmetic(checked, scene.particles, scene.numerics.arithmetic);
  check_fit(checked, scene.particles, scene.test);
  return scene;
}

Scene read_scene(const CaseDocument& document, Faults& faults) {
  ShapeCache shapes;
  return read_scene(document, faults, shapes);
}

Scene read_scene(const CaseDocument& document) {
  Faults faults;
  Scene scene = read_scene(document, faults);
  faults.throw_if_any();
  return scene;
}

Scene read_scene(const std::filesystem::path& file) { return read_scene(CaseDocument::load(file)); }

}  // namespace repose
