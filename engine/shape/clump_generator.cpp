#include "engine/shape/clump_generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/input_error.hpp"
#include "engine/base/random.hpp"
#include "engine/shape/clump_fit.hpp"
#include "engine/shape/clump_mass.hpp"
#include "engine/shape/medial_balls.hpp"

namespace repose {

namespace {

// Settings of the search, in units of the equivalent diameter where they are lengths. Measured in README.md.
constexpr double kBallTolerance = 0.02;   ///< a detected ball may stand out by so much
constexpr std::size_t kCandidates = 400;  ///< balls offered to one start, at least
constexpr std::size_t kCandidatesPerSphere = 4;
constexpr std::size_t kSamples = 1600;  ///< points of the surface, at least
constexpr std::size_t kSamplesPerSphere = 40;
constexpr std::size_t kMostBalls = 4000;  ///< their search costs the square of their number
constexpr int kFailedExchanges = 12;      ///< exchanges in a row without gain that end a start
constexpr int kMostExchanges = 400;       ///< of one start, kept or not, at least
constexpr int kMostExchangesPerSphere = 20;
/// A sphere may be this much larger than the largest ball inside the body, or than one of N equal balls of
/// the body's volume, whichever is larger.
constexpr double kRoomForRadius = 1.5;
constexpr double kMassWeight = 30.0;
constexpr double kNoSphere = 1.0;  ///< gap where there is no sphere: the body's own size

/// Body and candidates in units of the equivalent diameter, shared by every number of spheres that is tried.
class Generator {
 public:
  Generator(const Mesh& mesh, const ClumpOptions& options)
      : options_(options), body_(in_principal_frame(mesh)), measures_(measure(body_)) {
    const double diameter = measures_.equivalent_diameter();
    Mesh unit = body_;
    for (Vec3& vertex : unit.vertices) vertex /= diameter;
    const std::size_t most =
        options.spheres.value_or(40) > 0 ? static_cast<std::size_t>(options.spheres.value_or(40)) : 1;
    const SurfaceSamples samples = sample_surface(unit, std::max(kSamples, kSamplesPerSphere * most));
    target_.points = samples.points;
    target_.volume = kPi / 6.0;
    target_.moments = measure(unit).inertia().diagonal();
    target_.min_radius = options.min_radius / diameter;
    balls_ = medial_balls(sample_surface(unit, std::min(kMostBalls, samples.points.size())), kBallTolerance);
    for (const Vec3& vertex : unit.vertices) target_.room.extend(vertex);
    for (const Sphere& ball : balls_) largest_ball_ = std::max(largest_ball_, ball.radius);
    // Samples that lie farther apart than a sheet is thick miss that a ball comes out on the other side.
    largest_ball_ = std::min({largest_ball_, 0.5, 0.5 * target_.room.sizes().minCoeff()});
  }

  GeneratedClump make(int count) {
    target_.max_radius = kRoomForRadius * std::max(largest_ball_, 0.5 / std::cbrt(count));
    std::vector<Sphere> best;
    double best_value = std::numeric_limits<double>::infinity();
    for (int start = 0; start < std::max(1, options_.starts); ++start) {
      std::vector<Sphere> spheres = detect(count, start);
      exchange(spheres);
      const double value = fit_spheres(spheres, target_, {.iterations = 25, .mass_weight = kMassWeight});
      if (value < best_value) {
        best_value = value;
        best = std::move(spheres);
      }
    }
    fit_spheres(best, target_, {.iterations = 120, .mass_weight = kMassWeight, .tolerance = 1e-6});
    return finished(std::move(best));
  }

 private:
  /// Squared gaps that a further ball would take away.
  double gain(const Sphere& ball, const std::vector<double>& gaps) const {
    double sum = 0.0;
    for (std::size_t s = 0; s < gaps.size(); ++s) {
      const double reach = gaps[s] + ball.radius;
      const double square = (target_.points[s] - ball.centre).squaredNorm();
      if (reach <= 0.0 || square >= reach * reach) continue;
      const double gap = std::sqrt(square) - ball.radius;
      sum += gaps[s] * gaps[s] - gap * gap;
    }
    return sum;
  }

  const Sphere& best_ball(const std::vector<double>& gaps) const {
    const Sphere* best = &offered_.front();
    double best_gain = gain(*best, gaps);
    for (const Sphere& ball : offered_) {
      const double own = gain(ball, gaps);
      if (own <= best_gain) continue;
      best_gain = own;
      best = &ball;
    }
    return *best;
  }

  std::vector<Sphere> detect(int count, int start) {
    RandomStream random(options_.seed, static_cast<std::uint64_t>(start));
    offered_.clear();
    const std::size_t offers = std::max(kCandidates, kCandidatesPerSphere * static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < std::min(offers, balls_.size()); ++i)
      offered_.push_back(balls_[random.below(balls_.size())]);
    std::vector<Sphere> spheres;
    // No gap is larger than the body: a bound instead of infinity lets the first ball be judged like the
    // others.
    std::vector<double> gaps(target_.points.size(), 1.0);
    while (std::ssize(spheres) < count) {
      spheres.push_back(best_ball(gaps));
      gaps = surface_gaps(spheres, target_.points).gap;
    }
    return spheres;
  }

  /// Spheres by what the surface would lose without them, least first: every point that a sphere owns falls
  /// to the next nearest.
  std::vector<std::size_t> least_useful(const std::vector<Sphere>& spheres) const {
    const SurfaceGaps gaps = surface_gaps(spheres, target_.points);
    std::vector<double> next(target_.points.size(), kNoSphere);
    for (std::size_t k = 0; k < spheres.size(); ++k)
      for (std::size_t s = 0; s < next.size(); ++s)
        if (gaps.owner[s] != k)
          next[s] = std::min(next[s], (target_.points[s] - spheres[k].centre).norm() - spheres[k].radius);
    std::vector<double> loss(spheres.size(), 0.0);
    for (std::size_t s = 0; s < next.size(); ++s)
      loss[gaps.owner[s]] += next[s] * next[s] - gaps.gap[s] * gaps.gap[s];
    std::vector<std::size_t> order(spheres.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return loss[a] < loss[b]; });
    return order;
  }

  void exchange(std::vector<Sphere>& spheres) const {
    const FitOptions surface_only = {.iterations = 25};
    double value = fit_spheres(spheres, target_, surface_only);
    std::vector<std::size_t> order = least_useful(spheres);
    const std::size_t most_failures = std::min<std::size_t>(kFailedExchanges, spheres.size());
    const int most = std::max(kMostExchanges, kMostExchangesPerSphere * static_cast<int>(spheres.size()));
    std::size_t failed = 0;
    for (int tried = 0; tried < most && failed < most_failures; ++tried) {
      std::vector<Sphere> trial = spheres;
      trial.erase(trial.begin() + static_cast<std::ptrdiff_t>(order[failed]));
      trial.push_back(best_ball(surface_gaps(trial, target_.points).gap));
      const double trial_value = fit_spheres(trial, target_, surface_only);
      if (trial_value < value * (1.0 - 1e-4)) {
        value = trial_value;
        spheres = std::move(trial);
        order = least_useful(spheres);
        failed = 0;
      } else {
        ++failed;
      }
    }
  }

  GeneratedClump finished(std::vector<Sphere> spheres) const {
    const double diameter = measures_.equivalent_diameter();
    for (Sphere& sphere : spheres) {
      sphere.centre *= diameter;
      sphere.radius *= diameter;
    }
    std::sort(spheres.begin(), spheres.end(),
              [](const Sphere& a, const Sphere& b) { return a.radius > b.radius; });
    GeneratedClump made;
    made.errors = clump_errors(spheres, body_);
    const std::vector<double> exposed = unite(spheres, 400).exposed;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      std::vector<Sphere>& carried = made.clump.spheres;
      const bool again = std::find(carried.begin(), carried.end(), spheres[k]) != carried.end();
      (exposed[k] > 0.0 && !again ? carried : made.inner).push_back(spheres[k]);
    }
    made.clump.name = body_.name;
    made.clump.volume = measures_.volume;
    made.clump.inertia = principal_frame(measures_.inertia()).moments;
    return made;
  }

  ClumpOptions options_;
  Mesh body_;
  MeshMeasures measures_;
  FitTarget target_;
  std::vector<Sphere> balls_;
  double largest_ball_ = 0.0;  ///< radius of the largest ball inside the body
  std::vector<Sphere> offered_;
};

bool meets(const ClumpErrors& errors, const ClumpOptions& options) {
  const auto within = [](double error, const std::optional<double>& bound) {
    return !bound || error <= *bound;
  };
  return within(errors.volume_error, options.volume_error) && within(errors.eit_error, options.eit_error) &&
         within(errors.mean_distance, options.surface_error);
}

void check(const ClumpOptions& options, double diameter) {
  Faults faults;
  const auto bound = [&](const char* name, const std::optional<double>& value) {
    if (value && !(*value > 0.0 && *value < 1.0))
      faults.add("", name, fmt::format("{:g}", *value), "must be between 0 and 1");
  };
  bound("volume error", options.volume_error);
  bound("EIT error", options.eit_error);
  bound("surface error", options.surface_error);
  if (options.spheres && (*options.spheres < 1 || *options.spheres > kMostSpheres))
    faults.add("", "spheres", fmt::format("{}", *options.spheres),
               fmt::format("must be 1 to {}", kMostSpheres));
  if (options.max_spheres < 1 || options.max_spheres > kMostSpheres)
    faults.add("", "most spheres", fmt::format("{}", options.max_spheres),
               fmt::format("must be 1 to {}", kMostSpheres));
  const bool bounded = options.volume_error || options.eit_error || options.surface_error;
  if (options.spheres.has_value() == bounded)
    faults.add("", "", "", "give either a number of spheres or at least one bound on an error");
  if (!(options.min_radius >= 0.0 && options.min_radius < 0.5 * diameter))
    faults.add("", "smallest radius", fmt::format("{:g} m", options.min_radius),
               fmt::format("must be at least 0 and below half the body's equivalent diameter, {:g} m",
                           0.5 * diameter));
  faults.throw_if_any();
}

}  // namespace

GeneratedClump generate_clump(const Mesh& mesh, const ClumpOptions& options) {
  check(options, measure(mesh).equivalent_diameter());
  Generator generator(mesh, options);
  if (options.spheres) {
    GeneratedClump made = generator.make(*options.spheres);
    if (!mass_faults(made.clump).empty())
      throw InputError({mesh.name, "spheres", fmt::format("{}", *options.spheres),
                        "is too few for a body as thin as this: so few cannot have its mass and moments"});
    return made;
  }
  for (int count = 1;; ++count) {
    GeneratedClump made = generator.make(count);
    made.met = meets(made.errors, options) && mass_faults(made.clump).empty();
    if (made.met || count >= options.max_spheres) return made;
  }
}

}  // namespace repose
