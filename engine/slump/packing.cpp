#include "engine/slump/packing.hpp"

#include <algorithm>
#include <cmath>

#include "engine/dynamics/cell_grid.hpp"

namespace repose {

namespace {

constexpr int kSweepsPerList = 4;     ///< over the pairs before they are listed anew
constexpr int kListsPerStretch = 50;  ///< before the column is stretched
constexpr double kStretch = 1.05;
constexpr int kMostStretches = 80;  ///< 50 times as high
constexpr double kListSkin = 0.1;   ///< of the mean diameter

/// Where two spheres, or a sphere and a wall, come too near: n points from the other to the body.
struct Touch {
  double depth = 0.0;  ///< by how much, > 0 [m]
  Vec3 n = Vec3::UnitZ();
  Vec3 arm = Vec3::Zero();        ///< from the body's middle to the place
  Vec3 other_arm = Vec3::Zero();  ///< from the other's
};

/// The particles while they are pushed about.
class Pushing {
 public:
  Pushing(const Particles& particles, std::span<const ParticleDraw> draws, double cylinder_radius)
      : particles_(particles), radius_(cylinder_radius), bodies_(draws.size()), placed_(draws.size()) {
    double diameters = 0.0;
    for (std::size_t i = 0; i < draws.size(); ++i) {
      const Clump& shape = particles.shapes[static_cast<std::size_t>(draws[i].shape)];
      bodies_[i].shape = draws[i].shape;
      bodies_[i].scale = draws[i].scale;
      reach_.push_back(draws[i].scale * shape.bounding_radius());
      const double equal_radius = 0.5 * draws[i].scale * shape.equivalent_diameter();
      gyration_.push_back(0.4 * equal_radius * equal_radius);
      volume_ += std::pow(draws[i].scale, 3) * shape.volume;
      diameters += 2.0 * equal_radius;
      mass_.push_back(draws[i].mass);
    }
    diameter_ = diameters / static_cast<double>(draws.size());
  }

  void scatter(double fraction, RandomStream& random) {
    const double height = volume_ / (fraction * kPi * radius_ * radius_);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const double rho = (radius_ - reach_[i]) * std::sqrt(random.uniform());
      const double angle = 2.0 * kPi * random.uniform();
      const double z = reach_[i] + std::max(0.0, height - 2.0 * reach_[i]) * random.uniform();
      bodies_[i].position = {rho * std::cos(angle), rho * std::sin(angle), z};
      bodies_[i].orientation = random.rotation();
      place(i);
    }
  }

  /// Whether no body overlaps another or a wall; the gap between them may be smaller than it should be.
  [[nodiscard]] bool clear(std::span<const BodyPair> pairs) {
    for (const BodyPair& pair : pairs)
      if (touch_of(static_cast<std::size_t>(pair.i), static_cast<std::size_t>(pair.j)).depth >= gap())
        return false;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (touch_of_floor(i).depth >= gap() || touch_of_side(i).depth >= gap()) return false;
    return true;
  }

  /// One pass over all pairs and walls.
  void push_apart(std::span<const BodyPair> pairs) {
    for (const BodyPair& pair : pairs) {
      const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
      const Touch touch = touch_of(i, j);
      if (touch.depth <= 0.0) continue;
      const double share =
          touch.depth / (lightness(i, touch.arm, touch.n) + lightness(j, touch.other_arm, touch.n));
      move(i, touch.arm, share * touch.n);
      move(j, touch.other_arm, -share * touch.n);
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      push_off(i, touch_of_floor(i));
      push_off(i, touch_of_side(i));
    }
  }

  [[nodiscard]] std::vector<BodyPair> pairs() const {
    std::vector<double> x, y, z;
    for (const NewBody& body : bodies_) {
      x.push_back(body.position.x());
      y.push_back(body.position.y());
      z.push_back(body.position.z());
    }
    return near_pairs({x, y, z, reach_}, kListSkin * diameter_);
  }

  void stretch() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].position.z() *= kStretch;
      place(i);
    }
  }

  [[nodiscard]] double top() const {
    double top = 0.0;
    for (const std::vector<Sphere>& spheres : placed_)
      for (const Sphere& sphere : spheres) top = std::max(top, sphere.centre.z() + sphere.radius);
    return top;
  }
  [[nodiscard]] std::vector<NewBody>& bodies() { return bodies_; }

 private:
  [[nodiscard]] double gap() const { return kPackingGap * diameter_; }

  void place(std::size_t i) {
    const NewBody& body = bodies_[i];
    const Mat3 turn = body.scale * body.orientation.toRotationMatrix();
    const std::vector<Sphere>& local = particles_.shapes[static_cast<std::size_t>(body.shape)].spheres;
    placed_[i].resize(local.size());
    for (std::size_t s = 0; s < local.size(); ++s)
      placed_[i][s] = {body.position + turn * local[s].centre, body.scale * local[s].radius};
  }

  /// (1 + |arm × n|²/ρ²)/m: how far the place at `arm` gives way along n under a unit push.
  [[nodiscard]] double lightness(std::size_t i, const Vec3& arm, const Vec3& n) const {
    return (1.0 + arm.cross(n).squaredNorm() / gyration_[i]) / mass_[i];
  }

  void push_off(std::size_t i, const Touch& touch) {
    if (touch.depth > 0.0) move(i, touch.arm, touch.depth / lightness(i, touch.arm, touch.n) * touch.n);
  }

  void move(std::size_t i, const Vec3& arm, const Vec3& push) {
    NewBody& body = bodies_[i];
    body.position += push / mass_[i];
    const Vec3 turn = arm.cross(push) / (mass_[i] * gyration_[i]);
    const Quat change(1.0, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z());
    body.orientation = (change * body.orientation).normalized();
    place(i);
  }

  /// Spheres of body i that come near body j.
  void near_spheres(std::size_t i, std::size_t j, std::vector<const Sphere*>& list) const {
    list.clear();
    for (const Sphere& sphere : placed_[i]) {
      const double reach = sphere.radius + reach_[j] + gap();
      if ((sphere.centre - bodies_[j].position).squaredNorm() < reach * reach) list.push_back(&sphere);
    }
  }

  [[nodiscard]] Touch touch_of(std::size_t i, std::size_t j) {
    Touch touch;
    const double apart = reach_[i] + reach_[j] + gap();
    if ((bodies_[i].position - bodies_[j].position).squaredNorm() >= apart * apart) return touch;
    near_spheres(i, j, near_i_);
    if (near_i_.empty()) return touch;
    near_spheres(j, i, near_j_);
    for (const Sphere* a : near_i_) {
      for (const Sphere* b : near_j_) {
        const Vec3 between = a->centre - b->centre;
        const double reach = a->radius + b->radius + gap();
        const double squared = between.squaredNorm();
        if (squared >= reach * reach) continue;
        const double distance = std::sqrt(squared);
        if (reach - distance <= touch.depth) continue;
        touch.depth = reach - distance;
        touch.n = distance > 0.0 ? Vec3(between / distance) : Vec3::UnitZ();
        touch.arm = a->centre - a->radius * touch.n - bodies_[i].position;
        touch.other_arm = b->centre + b->radius * touch.n - bodies_[j].position;
      }
    }
    return touch;
  }

  [[nodiscard]] Touch touch_of_floor(std::size_t i) const {
    Touch touch;
    if (bodies_[i].position.z() >= reach_[i] + gap()) return touch;
    for (const Sphere& sphere : placed_[i]) {
      const double depth = sphere.radius + gap() - sphere.centre.z();
      if (depth <= touch.depth) continue;
      touch.depth = depth;
      touch.arm = sphere.centre - sphere.radius * touch.n - bodies_[i].position;
    }
    return touch;
  }

  [[nodiscard]] Touch touch_of_side(std::size_t i) const {
    Touch touch;
    const Vec3& position = bodies_[i].position;
    if (std::hypot(position.x(), position.y()) <= radius_ - reach_[i] - gap()) return touch;
    for (const Sphere& sphere : placed_[i]) {
      const double rho = std::hypot(sphere.centre.x(), sphere.centre.y());
      const double depth = rho + sphere.radius + gap() - radius_;
      if (depth <= touch.depth || !(rho > 0.0)) continue;
      touch.depth = depth;
      touch.n = {-sphere.centre.x() / rho, -sphere.centre.y() / rho, 0.0};
      touch.arm = sphere.centre - sphere.radius * touch.n - position;
    }
    return touch;
  }

  const Particles& particles_;
  double radius_;
  std::vector<NewBody> bodies_;
  std::vector<std::vector<Sphere>> placed_;
  std::vector<double> reach_;
  std::vector<double> gyration_;  ///< ρ² [m²]
  std::vector<double> mass_;
  double volume_ = 0.0;    ///< of all particles [m³]
  double diameter_ = 0.0;  ///< mean [m]
  std::vector<const Sphere*> near_i_, near_j_;
};

}  // namespace

Packing pack_cylinder(const Particles& particles, std::span<const ParticleDraw> draws, double cylinder_radius,
                      double fraction, RandomStream& random) {
  Pushing pushing(particles, draws, cylinder_radius);
  pushing.scatter(fraction, random);
  Packing packing;
  for (int stretch = 0; stretch < kMostStretches && !packing.clear; ++stretch) {
    if (stretch > 0) pushing.stretch();
    for (int list = 0; list < kListsPerStretch && !packing.clear; ++list) {
      const std::vector<BodyPair> pairs = pushing.pairs();
      packing.clear = pushing.clear(pairs);
      for (int sweep = 0; sweep < kSweepsPerList && !packing.clear; ++sweep) pushing.push_apart(pairs);
    }
  }
  packing.top = pushing.top();
  packing.bodies = std::move(pushing.bodies());
  return packing;
}

}  // namespace repose
