// The worst error made smallest, by exchange of the points that bound it.
//
// |f_i − y_i| ≤ t is, in logarithms, s x_i·θ ≤ s ln(y_i + s t) for s = ±1 with x_i = (1, ln x): linear in θ.
// Take p + 1 such rows k with weights λ_k ≥ 0 and Σ λ_k s_k x_k = 0. Summed, they say that no θ has a worst
// error below the root t of
//     φ(t) = Σ λ_k s_k ln(y_k + s_k t) = 0,   φ rising in t,
// and the θ that meets the p + 1 rows with equality has just that error on them. Where no other point is
// worse, bound and error agree and θ is the optimum, whatever the start. Otherwise the worst point enters,
// the one whose weight falls to zero first leaves, and t rises: the exchange of Remez and Stiefel, here for a
// power law. A gradient method on the same problem (SLSQP) stalls in one table of five, because it is nearly
// a linear programme.

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fit/centred_model.hpp"
#include "fit/solver.hpp"

namespace repose::fit {
namespace {

constexpr double kExact = 1e-13;      // error over angle that is rounding
constexpr double kGap = 1e-12;        // between error and bound, relative
constexpr double kNoWeight = 1e-12;   // a weight that is zero but for rounding
constexpr int kExchangesAPoint = 20;  // ten exchanges in all are usual

/// p + 1 rows (point, sign) and their weights.
struct Reference {
  std::vector<Eigen::Index> point;
  Eigen::VectorXd sign;
  Eigen::VectorXd weight;

  [[nodiscard]] Eigen::MatrixXd columns(const CentredModel& model) const {
    Eigen::MatrixXd result(model.design().cols(), sign.size());
    for (Eigen::Index k = 0; k < sign.size(); ++k) {
      result.col(k) = sign(k) * model.design().row(point[static_cast<std::size_t>(k)]).transpose();
    }
    return result;
  }
  [[nodiscard]] double response(const CentredModel& model, Eigen::Index k) const {
    return model.response()(point[static_cast<std::size_t>(k)]);
  }
};

/// Begins with independent rows (pivoted QR) and the worst of the other points.
Reference first_reference(const CentredModel& model, const Eigen::VectorXd& theta) {
  const Eigen::Index size = model.design().cols();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(model.design().transpose());
  const auto& order = qr.colsPermutation().indices();
  const Eigen::VectorXd error = (model.predict(theta) - model.response()).cwiseAbs();
  Reference reference;
  for (Eigen::Index k = 0; k < size; ++k) reference.point.push_back(order(k));
  Eigen::Index worst = order(size);
  for (Eigen::Index k = size; k < order.size(); ++k) {
    if (error(order(k)) > error(worst)) worst = order(k);
  }
  reference.point.push_back(worst);
  reference.sign = Eigen::VectorXd::Ones(size + 1);
  // The one dependence among p + 1 rows of rank p.
  Eigen::VectorXd dependence(size + 1);
  const Eigen::MatrixXd columns = reference.columns(model);
  dependence << columns.leftCols(size).fullPivLu().solve(columns.col(size)), -1.0;
  double at_zero = 0.0;
  for (Eigen::Index k = 0; k <= size; ++k) at_zero += dependence(k) * std::log(reference.response(model, k));
  if (at_zero > 0.0) dependence = -dependence;  // so that φ(0) ≤ 0
  for (Eigen::Index k = 0; k <= size; ++k) reference.sign(k) = dependence(k) < 0.0 ? -1.0 : 1.0;
  reference.weight = dependence.cwiseAbs() / dependence.cwiseAbs().sum();
  return reference;
}

/// y_k + s_k t, where a row of a point smaller than t bounds nothing: only that the law is not quite zero
/// there.
double edge_of(const CentredModel& model, const Reference& reference, Eigen::Index k, double t) {
  const double response = reference.response(model, k);
  return std::max(response + reference.sign(k) * t, kExact * response);
}

struct Slope {
  double value;
  double derivative;
};

Slope phi(const CentredModel& model, const Reference& reference, double t) {
  Slope sum{0.0, 0.0};
  for (Eigen::Index k = 0; k < reference.sign.size(); ++k) {
    const double edge = edge_of(model, reference, k, t);
    sum.value += reference.weight(k) * reference.sign(k) * std::log(edge);
    if (edge > kExact * reference.response(model, k)) sum.derivative += reference.weight(k) / edge;
  }
  return sum;
}

/// The root of φ at or above `low`: Newton's steps within a bracket.
double bound_of(const CentredModel& model, const Reference& reference, double low) {
  double high = std::max(low, model.response().maxCoeff());
  while (phi(model, reference, high).value < 0.0 && high < 1e300) high *= 2.0;
  double t = low;
  for (int i = 0; i < 200; ++i) {
    const Slope at = phi(model, reference, t);
    (at.value < 0.0 ? low : high) = t;
    double next = t - at.value / at.derivative;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == t || high - low <= std::numeric_limits<double>::epsilon() * high) break;
    t = next;
  }
  return t;
}

/// θ that has the error t on every row of the reference.
Eigen::VectorXd theta_of(const CentredModel& model, const Reference& reference, double t) {
  Eigen::VectorXd edge(reference.sign.size());
  for (Eigen::Index k = 0; k < edge.size(); ++k) {
    edge(k) = reference.sign(k) * std::log(edge_of(model, reference, k, t));
  }
  return reference.columns(model).transpose().colPivHouseholderQr().solve(edge);
}

/// Takes (point, sign) in and lets the row go whose weight falls to zero first.
void exchange(const CentredModel& model, Reference& reference, Eigen::Index point, double sign) {
  const Eigen::VectorXd entering = sign * model.design().row(point).transpose();
  const Eigen::VectorXd change = reference.columns(model).colPivHouseholderQr().solve(-entering);
  Eigen::Index leaving = 0;
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < change.size(); ++k) {
    const bool weightless = reference.weight(k) <= kNoWeight;
    if (weightless && change(k) >= -kNoWeight) continue;
    const double ratio =
        weightless ? -std::numeric_limits<double>::infinity() : change(k) / reference.weight(k);
    if (ratio < smallest) {
      smallest = ratio;
      leaving = k;
    }
  }
  double entering_weight = 0.0;
  if (std::isfinite(smallest)) {
    reference.weight = (change - smallest * reference.weight).cwiseMax(0.0);
    entering_weight = 1.0;
  }
  reference.point[static_cast<std::size_t>(leaving)] = point;
  reference.sign(leaving) = sign;
  reference.weight(leaving) = entering_weight;
  reference.weight /= reference.weight.sum();
}

/// Where repeats alone decide the worst error, many θ share it: goes as far towards `wish` as it stays the
/// same. The θ within an error are convex, so that halving finds the end.
Eigen::VectorXd drawn_towards(const CentredModel& model, const Eigen::VectorXd& theta,
                              const Eigen::VectorXd& wish, double error) {
  const auto holds = [&](double share) {
    const Eigen::VectorXd at = theta + share * (wish - theta);
    return (model.predict(at) - model.response()).cwiseAbs().maxCoeff() <= error;
  };
  if (holds(1.0)) return wish;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return theta + low * (wish - theta);
}

}  // namespace

PowerSolution solve_minimax(const PowerProblem& problem, const Eigen::VectorXd& start) {
  const CentredModel model(problem);
  const Eigen::VectorXd wish = model.centred(start);
  Reference reference = first_reference(model, wish);
  Eigen::VectorXd best = wish;
  double best_error = (model.predict(wish) - model.response()).cwiseAbs().maxCoeff();
  double bound = 0.0;
  const double rounding = kExact * model.response().maxCoeff();
  const int most = kExchangesAPoint * static_cast<int>(model.response().size());
  for (int i = 0; i < most; ++i) {
    bound = bound_of(model, reference, bound);
    const Eigen::VectorXd theta = theta_of(model, reference, bound);
    const Eigen::VectorXd residual = model.predict(theta) - model.response();
    Eigen::Index worst = 0;
    const double error = residual.cwiseAbs().maxCoeff(&worst);
    if (error < best_error) {
      best = theta;
      best_error = error;
    }
    if (best_error <= bound * (1.0 + kGap) + rounding) break;
    exchange(model, reference, worst, residual(worst) > 0.0 ? 1.0 : -1.0);
  }
  best = drawn_towards(model, best, wish, best_error);
  return model.solution(best, (best_error - bound) / std::max(best_error, rounding));
}

}  // namespace repose::fit
