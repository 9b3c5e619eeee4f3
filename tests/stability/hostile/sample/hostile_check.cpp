#include "stability/hostile/sample/hostile_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace repose::hostile {

namespace {

constexpr double kRolling = 0.02;    // of half the bodies, m g d
constexpr double kClosed = 0.25;     // a ledger, of what was put in (MotionDiagnosis::kMostImbalance)
constexpr double kMeanDepth = 0.04;  // of a diameter; a settled column is refused at 0.03
constexpr double kDeepest = 0.25;    // of a diameter, of any contact
constexpr double kDensest = 0.9;     // solid fraction; spheres of 1 : 20 pack to 0.85

double diameter_of(const BodySnapshot& body) { return std::cbrt(6.0 * body.volume / kPi); }

bool over_base(const HeapSnapshot& heap, const BodySnapshot& body) {
  return std::hypot(body.position.x(), body.position.y()) <= heap.base_radius;
}

class Faulty {
 public:
  void require(bool holds, const std::string& text) {
    if (!holds) faults_.push_back(text);
  }
  std::vector<std::string> take() { return std::move(faults_); }

 private:
  std::vector<std::string> faults_;
};

void check_angle(Faulty& faulty, const HeapMeasurement& measured) {
  const auto slope = [](double angle) { return angle > 0.0 && angle < 0.5 * kPi; };
  faulty.require(slope(measured.angle), fmt::format("angle {}", degrees(measured.angle)));
  faulty.require(std::isfinite(measured.standard_error), "standard error is not finite");
  for (const Flank& flank : measured.flanks)
    faulty.require(flank.angle > -0.5 * kPi && flank.angle < 0.5 * kPi && std::isfinite(flank.standard_error),
                   fmt::format("flank {}", degrees(flank.angle)));
}

/// Which bodies touch another.
std::vector<char> touching(const HeapSnapshot& heap) {
  std::vector<char> touches(heap.bodies.size(), 0);
  for (std::size_t i = 0; i < heap.spheres.size(); ++i)
    for (std::size_t j = i + 1; j < heap.spheres.size(); ++j) {
      const SphereSnapshot &a = heap.spheres[i], &b = heap.spheres[j];
      if (a.body == b.body || (a.centre - b.centre).norm() > a.radius + b.radius) continue;
      touches[static_cast<std::size_t>(a.body)] = touches[static_cast<std::size_t>(b.body)] = 1;
    }
  return touches;
}

/// Median of the kinetic energy over m g d, rotation with the sphere's 2/5 m r², of the bodies that touch
/// another: those that roll for themselves belong to no heap.
double median_motion(const HeapSnapshot& heap) {
  const std::vector<char> touches = touching(heap);
  std::vector<double> ratios;
  for (std::size_t i = 0; i < heap.bodies.size(); ++i) {
    const BodySnapshot& body = heap.bodies[i];
    const double d = diameter_of(body);
    const double twice = body.velocity.squaredNorm() + 0.1 * d * d * body.angular_velocity.squaredNorm();
    if (touches[i]) ratios.push_back(0.5 * twice / (kGravity * d));
  }
  if (ratios.empty()) return 0.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

void check_places(Faulty& faulty, const Scene& scene, const HeapSnapshot& heap) {
  // A body that falls from the rim, is thrown as fast as it is poured and pulled along by a wall flies no
  // faster.
  const SlumpTest& test = scene.test;
  const double speed = std::hypot(test.pour_speed, std::sqrt(2.0 * kGravity * test.cylinder_height)) +
                       2.0 * test.opening_speed;
  const double reach = test.cylinder_radius + speed * heap.time;
  for (const BodySnapshot& body : heap.bodies) {
    const double rho = std::hypot(body.position.x(), body.position.y());
    const double d = diameter_of(body);
    faulty.require(!(over_base(heap, body) && rho < heap.base_radius - d && body.position.z() < 0.0),
                   fmt::format("a body is under the base, z = {} m", body.position.z()));
    faulty.require(rho < reach && body.position.z() < test.cylinder_height + speed * speed / (2.0 * kGravity),
                   fmt::format("a body is at {} m, {} m", rho, body.position.z()));
  }
}

void check_overlaps(Faulty& faulty, const HeapSnapshot& heap) {
  double sum = 0.0, deepest = 0.0;
  int count = 0;
  const auto take = [&](double overlap, double d) {
    if (!(overlap > 0.0)) return;
    sum += overlap / d;
    deepest = std::max(deepest, overlap / d);
    ++count;
  };
  std::vector<double> diameters;
  for (const BodySnapshot& body : heap.bodies) diameters.push_back(diameter_of(body));
  for (std::size_t i = 0; i < heap.spheres.size(); ++i) {
    const SphereSnapshot& a = heap.spheres[i];
    const double d = diameters[static_cast<std::size_t>(a.body)];
    if (std::hypot(a.centre.x(), a.centre.y()) < heap.base_radius) take(a.radius - a.centre.z(), d);
    for (std::size_t j = i + 1; j < heap.spheres.size(); ++j) {
      const SphereSnapshot& b = heap.spheres[j];
      if (a.body == b.body) continue;
      take(a.radius + b.radius - (a.centre - b.centre).norm(),
           0.5 * (d + diameters[static_cast<std::size_t>(b.body)]));
    }
  }
  if (count == 0) return;
  faulty.require(sum / count < kMeanDepth, fmt::format("mean overlap of {:.2g} diameters", sum / count));
  faulty.require(deepest < kDeepest, fmt::format("an overlap of {:.2g} diameters", deepest));
}

void check_masses(Faulty& faulty, const Scene& scene, const RunResult& result) {
  double on_base = 0.0, heaviest = 0.0;
  for (const BodySnapshot& body : result.heap.bodies) {
    if (body.position.z() > 0.0 && over_base(result.heap, body)) on_base += body.mass;
    heaviest = std::max(heaviest, body.mass);
  }
  const Responses& responses = result.responses;
  const double poured = responses.mass_on_base + responses.mass_lost;
  faulty.require(std::abs(on_base - responses.mass_on_base) < 1e-9 * on_base, "mass on the base");
  faulty.require(std::abs(poured - scene.particles.total_mass) < heaviest, "mass poured");
  faulty.require(responses.mass_lost > -1e-9 * poured, "mass gained");
  const bool nowhere = std::isinf(scene.test.base_radius) && result.motion.spilled == 0;
  faulty.require(!nowhere || responses.mass_lost < 1e-9 * poured, "mass lost from an unbounded base");
  const double solid = responses.bulk_density / scene.particles.material.density;
  faulty.require(solid >= 0.0 && solid < kDensest, fmt::format("column of solid fraction {}", solid));
  // A heap has slid from a column of its own mass: no higher, but for a diameter at either end.
  if (solid > 0.0) {
    const double area = kPi * scene.test.cylinder_radius * scene.test.cylinder_radius;
    const double column = poured / (responses.bulk_density * area);
    const double d = result.heap.bodies.empty() ? 0.0 : diameter_of(result.heap.bodies.front());
    faulty.require(responses.peak_height < 1.2 * column + 3.0 * d,
                   fmt::format("heap of {} m from a column of {} m", responses.peak_height, column));
  }
}

}  // namespace

std::vector<std::string> faults_of(const Scene& scene, const RunResult& result) {
  Faulty faulty;
  if (result.outcome != Outcome::completed) {
    faulty.require(!result.reason.empty(), "no reason");
    faulty.require(result.outcome != Outcome::interrupted, "did not end in time");
    return faulty.take();
  }
  faulty.require(result.reason.empty(), "a reason for a run that is completed");
  faulty.require(std::abs(result.energy.relative_imbalance()) <= kClosed,
                 fmt::format("ledger open by {:.2g}", result.energy.relative_imbalance()));
  const double motion = median_motion(result.heap);
  // Where the angle's standing still ends a run early, single bodies may still roll on the heap.
  const double most = scene.numerics.rest_angle_change ? kRolling : 2.0 * scene.numerics.rest_energy_ratio;
  faulty.require(motion < most, fmt::format("bodies still move with {:.2g} m g d", motion));
  check_angle(faulty, result.measurement);
  check_places(faulty, scene, result.heap);
  check_overlaps(faulty, result.heap);
  check_masses(faulty, scene, result);
  return faulty.take();
}

bool motion_is_questioned(const RunResult& result) {
  static const std::set<std::string> names{"coarse_step", "energy_error",   "soft_contacts",
                                           "tiny_sphere", "coarse_opening", "no_restitution"};
  return std::any_of(result.warnings.begin(), result.warnings.end(),
                     [](const Warning& warning) { return names.contains(warning.name); });
}

}  // namespace repose::hostile
