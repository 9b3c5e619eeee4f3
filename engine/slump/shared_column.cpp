#include "engine/slump/shared_column.hpp"

namespace repose {

Scene scene_of_column(const Scene& scene) {
  Scene made = scene;
  made.contact.particle_particle = scene.test.shared_columns->contact;
  made.test.shared_columns.reset();
  return made;
}

std::uint64_t number_of_column(const SharedColumns& columns, std::uint64_t seed) {
  return seed % static_cast<std::uint64_t>(columns.count);
}

std::vector<NewBody> turned(const std::vector<NewBody>& bodies, double angle) {
  const Quat turn(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  std::vector<NewBody> result = bodies;
  for (NewBody& body : result) {
    body.position = turn * body.position;
    body.orientation = (turn * body.orientation).normalized();
  }
  return result;
}

std::shared_ptr<ColumnShelf::Place> ColumnShelf::place(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (const auto found = places_.find(name); found != places_.end()) return found->second;
  if (order_.size() == kMost) {
    places_.erase(order_.front());
    order_.pop_front();
  }
  order_.push_back(name);
  return places_[name] = std::make_shared<Place>();
}

std::shared_ptr<const SharedColumn> ColumnShelf::get(const std::string& name,
                                                     const std::function<SharedColumn()>& make) {
  const std::shared_ptr<Place> here = place(name);
  const std::lock_guard lock(here->making);
  if (here->column) return here->column;
  auto column = std::make_shared<const SharedColumn>(make());
  if (column->verdict.outcome != Outcome::interrupted) here->column = column;
  return column;
}

}  // namespace repose
