#include "engine/shape/rock.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "engine/base/input_error.hpp"
#include "engine/base/random.hpp"

namespace repose {

namespace {

constexpr Eigen::Index kFigures = 5;
constexpr Eigen::Index kEntries = 9;

constexpr double kAccepted = 1e-3;   ///< what a body must reach
constexpr double kConverged = 1e-9;  ///< where the iteration ends

/// Directions spread over the sphere: each the candidate farthest from those before it (Mitchell 1991).
std::vector<Vec3> spread_directions(std::size_t count, RandomStream& random) {
  std::vector<Vec3> chosen;
  while (chosen.size() < count) {
    Vec3 best = Vec3::UnitX();
    double best_cosine = 2.0;
    for (int attempt = 0; attempt < 4; ++attempt) {
      const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
      double cosine = -1.0;
      for (const Vec3& other : chosen) cosine = std::max(cosine, direction.dot(other));
      if (cosine < best_cosine) {
        best_cosine = cosine;
        best = direction;
      }
    }
    chosen.push_back(best);
  }
  return chosen;
}

struct Wave {
  Vec3 number;
  double phase;
};

/// Vertices of a random rock around the origin, of about unit radius, on the directions of an icosphere.
std::vector<Vec3> random_rock(const Mesh& sphere, const RockOptions& options, RandomStream& random) {
  const std::vector<Vec3> normals = spread_directions(10 + random.below(9), random);
  std::vector<double> distances(normals.size());
  for (double& distance : distances) distance = random.uniform(0.75, 1.15);
  std::vector<Wave> waves(24);
  for (Wave& wave : waves)
    wave = {random.rotation() * Vec3(random.uniform(4.0, 12.0), 0.0, 0.0), random.uniform(0.0, 2.0 * kPi)};

  const double amplitude = options.roughness * std::sqrt(2.0 / static_cast<double>(waves.size()));
  std::vector<Vec3> vertices;
  vertices.reserve(sphere.vertices.size());
  for (const Vec3& direction : sphere.vertices) {
    double sum = 0.0;
    for (std::size_t i = 0; i < normals.size(); ++i)
      sum += std::pow(std::max(0.0, normals[i].dot(direction) / distances[i]), options.sharpness);
    double rough = 1.0;
    for (const Wave& wave : waves) rough += amplitude * std::cos(wave.number.dot(direction) + wave.phase);
    vertices.push_back(std::pow(sum, -1.0 / options.sharpness) * rough * direction);
  }
  return vertices;
}

/// Logarithms of figure over wanted figure: extents, volume, area of the mapped shape.
Eigen::VectorXd figure_errors(const Mat3& map, const std::vector<Vec3>& shape,
                              const std::vector<Facet>& facets, double shape_volume,
                              const BodyFigures& wanted) {
  std::vector<Vec3> mapped(shape.size());
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
  Vec3 high = -low;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    mapped[i] = map * shape[i];
    low = low.cwiseMin(mapped[i]);
    high = high.cwiseMax(mapped[i]);
  }
  double area = 0.0;
  for (const auto& [a, b, c] : facets)
    area += 0.5 * (mapped[b] - mapped[a]).cross(mapped[c] - mapped[a]).norm();
  Eigen::VectorXd errors(kFigures);
  errors.head<3>() = (high - low).cwiseQuotient(wanted.extents).array().log();
  errors[3] = std::log(std::abs(map.determinant()) * shape_volume / wanted.volume);
  errors[4] = std::log(area / wanted.area);
  return errors;
}

struct Fit {
  Mat3 map = Mat3::Identity();
  double error = std::numeric_limits<double>::infinity();
};

/// Gauss–Newton in the nine entries of the map, relative to the body's size; the step of least norm, halved
/// until the errors fall.
Fit fit_map(const std::vector<Vec3>& shape, const std::vector<Facet>& facets, double shape_volume,
            const BodyFigures& wanted, const Mat3& start) {
  const auto errors_of = [&](const Mat3& map) {
    return figure_errors(map, shape, facets, shape_volume, wanted);
  };
  const double scale = std::cbrt(wanted.volume / shape_volume);
  Fit fit{start};
  Eigen::VectorXd errors = errors_of(fit.map);
  for (int iteration = 0; iteration < 60 && errors.cwiseAbs().maxCoeff() > kConverged; ++iteration) {
    Eigen::MatrixXd jacobian(kFigures, kEntries);
    for (Eigen::Index k = 0; k < kEntries; ++k) {
      Mat3 shifted = fit.map;
      shifted(k / 3, k % 3) += 1e-6 * scale;
      jacobian.col(k) = (errors_of(shifted) - errors) / 1e-6;
    }
    const Eigen::VectorXd step = -jacobian.completeOrthogonalDecomposition().solve(errors);
    double fraction = std::min(1.0, 0.3 / step.norm());
    for (int halving = 0;; ++halving, fraction *= 0.5) {
      if (halving == 12) return fit;
      const Mat3 next = fit.map + fraction * scale * Mat3(step.reshaped(3, 3).transpose());
      const Eigen::VectorXd next_errors = errors_of(next);
      if (next.determinant() > 0.0 && next_errors.norm() < errors.norm()) {
        fit.map = next;
        errors = next_errors;
        break;
      }
    }
    fit.error = errors.cwiseAbs().maxCoeff();
  }
  return fit;
}

double stretch_of(const Mat3& map) {
  const Vec3 stretches = Eigen::JacobiSVD<Mat3>(map).singularValues();
  return stretches[0] / stretches[2];
}

void check_figures(const BodyFigures& figures, const std::string& file, const std::string& pointer) {
  Faults faults;
  if (!(figures.extents.minCoeff() > 0.0 && figures.volume > 0.0 && figures.area > 0.0)) {
    faults.add(file, pointer, "", "extents, volume and surface area must be > 0");
  } else {
    if (figures.volume >= figures.extents.prod())
      faults.add(file, pointer, "", "the volume must be below that of the box of its extents");
    if (36.0 * kPi * figures.volume * figures.volume > std::pow(figures.area, 3))
      faults.add(file, pointer, "",
                 "no body of this volume has so small a surface: the sphericity exceeds 1");
  }
  faults.throw_if_any();
}

}  // namespace

Rock make_rock(const BodyFigures& figures, const RockOptions& options, const std::string& file,
               const std::string& pointer) {
  check_figures(figures, file, pointer);
  const Mesh sphere = icosphere(options.subdivision);
  Rock best;
  best.stretch = std::numeric_limits<double>::infinity();
  for (int candidate = 0; candidate < options.candidates; ++candidate) {
    RandomStream random(options.seed, static_cast<std::uint64_t>(candidate));
    Mesh shape{options.name, random_rock(sphere, options, random), sphere.facets};
    const double shape_volume = measure(shape).volume;
    const Mat3 start = std::cbrt(figures.volume / shape_volume) * random.rotation().toRotationMatrix();
    const Fit fit = fit_map(shape.vertices, shape.facets, shape_volume, figures, start);
    if (fit.error > kAccepted || stretch_of(fit.map) >= best.stretch) continue;
    for (Vec3& vertex : shape.vertices) vertex = fit.map * vertex;
    best = {std::move(shape), fit.error, stretch_of(fit.map)};
  }
  if (best.mesh.facets.empty())
    throw InputError(
        {file, pointer, "", "no body was found that has these extents, this volume and this surface"});
  return best;
}

}  // namespace repose
