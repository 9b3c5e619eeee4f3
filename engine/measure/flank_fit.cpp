#include "engine/measure/flank_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "engine/base/vec3.hpp"
#include "engine/measure/residual_density.hpp"

namespace repose {

namespace {

constexpr double kLeastSlope = 1e-4;
constexpr double kRidge = 1e-9;    // of the trace: keeps the lines of flanks without tops where they are
constexpr double kStep = 0.7;      // of a scoring step, which alone overshoots where the density is rough
constexpr double kSettled = 1e-7;  // change of the slopes below which the iteration ends

using Vector8 = Eigen::Matrix<double, 8, 1>;
using Matrix8 = Eigen::Matrix<double, 8, 8>;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Derivatives of a point's height by the lines: ∂/∂z0_f = 1 and those by the slopes of its two flanks.
struct Gradient {
  double own = 0.0;
  double side = 0.0;
};

Gradient slope_gradient(const FlankPoint& p, const FlankLines& lines) {
  const double a = lines.slope[at(p.flank)] * p.u;
  const double b = lines.slope[at(p.side)] * p.v;
  const double drop = std::max(std::sqrt(a * a + b * b), 1e-300);
  return {-a * p.u / drop, -b * p.v / drop};
}

/// Normal equations Σ w g gᵀ step = Σ s g over the eight parameters (z0 0 … 3, slopes 4 … 7).
class NormalEquations {
 public:
  void add(const FlankPoint& p, const FlankLines& lines, double weight, double right_side) {
    const Gradient g = slope_gradient(p, lines);
    const std::array<int, 3> index{p.flank, 4 + p.flank, 4 + p.side};
    const std::array<double, 3> value{1.0, g.own, g.side};
    for (std::size_t a = 0; a < 3; ++a) {
      right_side_[index[a]] += right_side * value[a];
      for (std::size_t b = 0; b < 3; ++b) matrix_(index[a], index[b]) += weight * value[a] * value[b];
    }
  }

  /// Moves the lines by factor × the solution; returns the largest change of a slope.
  double move(FlankLines& lines, double factor) {
    // Heights and slopes differ by a length; the ridge is measured against each parameter's own scale.
    for (int k = 0; k < 8; ++k) matrix_(k, k) += kRidge * std::max(matrix_(k, k), 1e-30);
    const Vector8 step = factor * matrix_.ldlt().solve(right_side_);
    double change = 0.0;
    for (int f = 0; f < 4; ++f) {
      if (!std::isfinite(step[f]) || !std::isfinite(step[4 + f])) continue;
      lines.z0[at(f)] += step[f];
      lines.slope[at(f)] = std::max(kLeastSlope, lines.slope[at(f)] + step[4 + f]);
      change = std::max(change, std::abs(step[4 + f]));
    }
    return change;
  }

 private:
  Matrix8 matrix_ = Matrix8::Zero();
  Vector8 right_side_ = Vector8::Zero();
};

std::vector<double> distances(const std::vector<FlankPoint>& points, const FlankLines& lines) {
  std::vector<double> e(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) e[i] = points[i].z - lines.height(points[i]);
  return e;
}

/// Weighted mean and variance.
struct Moments {
  double total = 0.0;
  double mean = 0.0;
  double variance = 0.0;
};

Moments moments(const std::vector<double>& e, const std::vector<double>& w) {
  Moments m;
  for (std::size_t i = 0; i < e.size(); ++i) {
    m.total += w[i];
    m.mean += w[i] * e[i];
  }
  m.mean /= m.total;
  for (std::size_t i = 0; i < e.size(); ++i) m.variance += w[i] * (e[i] - m.mean) * (e[i] - m.mean);
  m.variance /= m.total;
  return m;
}

}  // namespace

double FlankLines::height(const FlankPoint& p) const {
  return z0[at(p.flank)] - slope[at(p.flank)] * reduced_radius(p);
}

double FlankLines::reduced_radius(const FlankPoint& p) const {
  const double ratio = slope[at(p.side)] / slope[at(p.flank)];
  return std::sqrt(p.u * p.u + ratio * ratio * p.v * p.v);
}

FlankPoint flank_point(const SurfaceTop& top, double x0, double y0) {
  const double x = top.x - x0;
  const double y = top.y - y0;
  const int along_x = x > 0.0 ? 0 : 1;
  const int along_y = y > 0.0 ? 2 : 3;
  FlankPoint p;
  const bool in_x = std::abs(x) > std::abs(y);
  p.flank = in_x ? along_x : along_y;
  p.side = in_x ? along_y : along_x;
  p.u = std::max(std::abs(x), std::abs(y));
  p.v = std::min(std::abs(x), std::abs(y));
  p.z = top.z;
  p.phi = std::atan2(y, x);
  return p;
}

FlankLines fit_robust(const std::vector<FlankPoint>& points, FlankLines lines, double reach, int iterations) {
  for (int k = 0; k < iterations; ++k) {
    NormalEquations equations;
    for (const FlankPoint& p : points) {
      const double e = p.z - lines.height(p);
      const double u = e / reach;
      const double weight = std::abs(u) < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
      if (weight > 0.0) equations.add(p, lines, weight, weight * e);
    }
    if (equations.move(lines, 1.0) < kSettled) break;
  }
  return lines;
}

FlankLines fit_adaptive(const std::vector<FlankPoint>& points, const std::vector<double>& weights,
                        FlankLines lines, double bandwidth, int iterations) {
  for (int k = 0; k < iterations; ++k) {
    const std::vector<double> e = distances(points, lines);
    const Moments spread = moments(e, weights);
    const ResidualDensity density(e, weights, bandwidth);
    double information = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double psi = density.score(e[i]);
      information += weights[i] * psi * psi / spread.total;
    }
    // The curvature of a Gaussian of this spread seen through the kernel is the least that a step may assume.
    information = std::max(information, 1.0 / (bandwidth * bandwidth + spread.variance));
    NormalEquations equations;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (weights[i] > 0.0) {
        equations.add(points[i], lines, weights[i], weights[i] * density.score(e[i]) / information);
      }
    }
    if (equations.move(lines, kStep) < kSettled) break;
  }
  const double offset = moments(distances(points, lines), weights).mean;
  for (double& z0 : lines.z0) z0 += offset;
  return lines;
}

}  // namespace repose
