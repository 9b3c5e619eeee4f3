#include "engine/slump/packing.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/dynamics/cell_grid.hpp"
#include "engine/dynamics/place_sphere.hpp"
#include "engine/dynamics/reaching.hpp"

namespace repose {

namespace {

constexpr int kSweepsPerList = 4;     ///< over the pairs before they are listed anew
constexpr int kListsPerStretch = 50;  ///< before the column is stretched
constexpr double kStretch = 1.05;
constexpr int kMostStretches = 80;   ///< 50 times as high
constexpr double kListSkin = 0.1;    ///< of the mean diameter
constexpr std::size_t kBlock = 256;  ///< bodies that a thread takes at a time
constexpr double kMostLayers = 1e4;  ///< the last one holds all above

/// Where two spheres, or a sphere and a wall, come too near: n points from the other to the body.
struct Touch {
  double depth = 0.0;  ///< by how much, > 0 [m]
  Vec3 n = Vec3::UnitZ();
  Vec3 arm = Vec3::Zero();        ///< from the body's middle to the place
  Vec3 other_arm = Vec3::Zero();  ///< from the other's
};

/// Spheres of the two bodies of a pair that come near.
struct NearSpheres {
  Reaching i, j;
};

/// The particles while they are pushed about.
class Pushing {
 public:
  Pushing(const Particles& particles, std::span<const ParticleDraw> draws, double cylinder_radius, Crew& crew)
      : crew_(crew),
        local_(particles.shapes),
        radius_(cylinder_radius),
        bodies_(draws.size()),
        axes_(draws.size()) {
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

  /// Pairs that are near now, by layers. A pair belongs to the layer of its lower body.
  void list() {
    std::vector<double> x, y, z;
    for (const NewBody& body : bodies_) {
      x.push_back(body.position.x());
      y.push_back(body.position.y());
      z.push_back(body.position.z());
    }
    const double skin = kListSkin * diameter_;
    const CellGrid grid({x, y, z, reach_}, skin);
    std::vector<std::vector<BodyPair>> of_block(blocks());
    crew_.each(blocks(), [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < end_of(block); ++i) grid.append_pairs_of(i, of_block[block]);
    });
    const double height = 2.0 * *std::max_element(reach_.begin(), reach_.end()) + skin;
    const double low = *std::min_element(z.begin(), z.end());
    for (std::vector<BodyPair>& layer : layers_) layer.clear();
    for (const std::vector<BodyPair>& pairs : of_block)
      for (const BodyPair& pair : pairs) {
        const double lower =
            std::min(z[static_cast<std::size_t>(pair.i)], z[static_cast<std::size_t>(pair.j)]);
        const auto layer = static_cast<std::size_t>(std::min(kMostLayers, (lower - low) / height));
        if (layer >= layers_.size()) layers_.resize(layer + 1);
        layers_[layer].push_back(pair);
      }
  }

  /// Whether no body overlaps another or a wall; the gap between them may be smaller than it should be.
  [[nodiscard]] bool clear() {
    std::atomic<bool> clear = true;
    crew_.each(layers_.size(), [&](std::size_t layer) {
      NearSpheres near;
      for (const BodyPair& pair : layers_[layer]) {
        if (!clear.load(std::memory_order_relaxed)) return;
        if (touch_of(pair, near).depth >= gap()) clear = false;
      }
    });
    for (std::size_t i = 0; i < bodies_.size() && clear; ++i)
      clear = touch_of_floor(i).depth < gap() && touch_of_side(i).depth < gap();
    return clear;
  }

  /// One pass over all pairs and walls.
  void push_apart() {
    for (const std::size_t odd : {std::size_t{0}, std::size_t{1}})
      crew_.each((layers_.size() + 1 - odd) / 2, [&](std::size_t k) { push_apart(layers_[2 * k + odd]); });
    crew_.each(blocks(), [&](std::size_t block) {
      for (std::size_t i = block * kBlock; i < end_of(block); ++i) {
        push_off(i, touch_of_floor(i));
        push_off(i, touch_of_side(i));
      }
    });
  }

  void stretch() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].position.z() *= kStretch;
      place(i);
    }
  }

  [[nodiscard]] double top() const {
    double top = 0.0;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      for_each_sphere(i, [&](const Vec3& centre, double r) { top = std::max(top, centre.z() + r); });
    return top;
  }
  [[nodiscard]] std::vector<NewBody>& bodies() { return bodies_; }

 private:
  [[nodiscard]] double gap() const { return kPackingGap * diameter_; }
  [[nodiscard]] std::size_t blocks() const { return (bodies_.size() + kBlock - 1) / kBlock; }
  [[nodiscard]] std::size_t end_of(std::size_t block) const {
    return std::min((block + 1) * kBlock, bodies_.size());
  }

  void push_apart(std::span<const BodyPair> pairs) {
    NearSpheres near;
    for (const BodyPair& pair : pairs) {
      const Touch touch = touch_of(pair, near);
      if (touch.depth <= 0.0) continue;
      const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
      const double share =
          touch.depth / (lightness(i, touch.arm, touch.n) + lightness(j, touch.other_arm, touch.n));
      move(i, touch.arm, share * touch.n);
      move(j, touch.other_arm, -share * touch.n);
    }
  }

  void place(std::size_t i) {
    const NewBody& body = bodies_[i];
    axes_[i] = body_axes(body.position, body.orientation.toRotationMatrix(), body.scale);
  }

  /// visit(centre, radius) for every sphere of a body.
  template <class Visit>
  void for_each_sphere(std::size_t i, Visit visit) const {
    const auto shape = static_cast<std::size_t>(bodies_[i].shape);
    for (std::int32_t row = local_.first_row[shape]; row < local_.first_row[shape + 1]; ++row) {
      PlacedSphere sphere;
      place_sphere(axes_[i], local_.rows[static_cast<std::size_t>(row)], sphere);
      visit(Vec3(sphere.centre), sphere.radius);
    }
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

  [[nodiscard]] Touch touch_of(const BodyPair& pair, NearSpheres& near) const {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    Touch touch;
    const Vec3 origin = bodies_[i].position, apart = bodies_[j].position - origin;
    const double bounds = reach_[i] + reach_[j] + gap();
    if (apart.squaredNorm() >= bounds * bounds) return touch;
    const auto find = [&](std::size_t of, std::size_t into, Reaching& found) {
      found.find(local_, {bodies_[of].shape, axes_[of], bodies_[of].position}, bodies_[into].position,
                 reach_[into] + gap(), origin);
    };
    find(i, j, near.i);
    if (near.i.count == 0) return touch;
    find(j, i, near.j);
    const auto centre = [](const Reaching& of, std::size_t k) { return Vec3(of.x[k], of.y[k], of.z[k]); };
    for_each_near(near.i, near.j, gap(), [&](std::size_t a, std::size_t b) {
      const Vec3 between = centre(near.i, a) - centre(near.j, b);
      const double distance = between.norm();
      const double depth = near.i.radius[a] + near.j.radius[b] + gap() - distance;
      if (depth <= touch.depth) return;
      touch.depth = depth;
      touch.n = distance > 0.0 ? Vec3(between / distance) : Vec3::UnitZ();
      touch.arm = centre(near.i, a) - near.i.radius[a] * touch.n;
      touch.other_arm = centre(near.j, b) - apart + near.j.radius[b] * touch.n;
    });
    return touch;
  }

  [[nodiscard]] Touch touch_of_floor(std::size_t i) const {
    Touch touch;
    const Vec3& position = bodies_[i].position;
    if (position.z() >= reach_[i] + gap()) return touch;
    for_each_sphere(i, [&](const Vec3& centre, double r) {
      const double depth = r + gap() - centre.z();
      if (depth <= touch.depth) return;
      touch.depth = depth;
      touch.arm = centre - r * touch.n - position;
    });
    return touch;
  }

  [[nodiscard]] Touch touch_of_side(std::size_t i) const {
    Touch touch;
    const Vec3& position = bodies_[i].position;
    const double inside = radius_ - reach_[i] - gap();
    if (inside >= 0.0 && position.head<2>().squaredNorm() <= inside * inside) return touch;
    for_each_sphere(i, [&](const Vec3& centre, double r) {
      const double rho = centre.head<2>().norm();
      const double depth = rho + r + gap() - radius_;
      if (depth <= touch.depth || !(rho > 0.0)) return;
      touch.depth = depth;
      touch.n = {-centre.x() / rho, -centre.y() / rho, 0.0};
      touch.arm = centre - r * touch.n - position;
    });
    return touch;
  }

  Crew& crew_;
  LocalSpheres local_;
  double radius_;
  std::vector<NewBody> bodies_;
  std::vector<BodyAxes> axes_;
  std::vector<double> reach_;
  std::vector<double> gyration_;  ///< ρ² [m²]
  std::vector<double> mass_;
  double volume_ = 0.0;    ///< of all particles [m³]
  double diameter_ = 0.0;  ///< mean [m]
  std::vector<std::vector<BodyPair>> layers_;
};

}  // namespace

Packing pack_cylinder(const Particles& particles, std::span<const ParticleDraw> draws, double cylinder_radius,
                      double fraction, RandomStream& random, Crew& crew) {
  Pushing pushing(particles, draws, cylinder_radius, crew);
  pushing.scatter(fraction, random);
  Packing packing;
  for (int stretch = 0; stretch < kMostStretches && !packing.clear; ++stretch) {
    if (stretch > 0) pushing.stretch();
    for (int list = 0; list < kListsPerStretch && !packing.clear; ++list) {
      pushing.list();
      packing.clear = pushing.clear();
      for (int sweep = 0; sweep < kSweepsPerList && !packing.clear; ++sweep) pushing.push_apart();
    }
  }
  packing.top = pushing.top();
  packing.bodies = std::move(pushing.bodies());
  return packing;
}

}  // namespace repose
