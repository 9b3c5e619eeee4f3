#include "fit/solver.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <stdexcept>
#include <vector>

#include "fit/centred_model.hpp"
#include "fit/errors.hpp"

namespace repose::fit {
namespace {

constexpr int kRestarts = 30;
constexpr int kEvaluations = 2000;        // of one NLopt run; ten to fifty are usual
constexpr double kOffsetWanted = 1e-10;   // of the standard errors: far below anything that is printed
constexpr double kOffsetAccepted = 1e-6;  // still a thousand times finer than the data
constexpr double kExactFit = 1e-14;       // residual over response: rounding alone

/// θ = origin + scale · R⁻¹ u with J(origin) = Q R: in u the sum of squares over scale² has a Hessian near 1.
struct Whitened {
  const CentredModel& model;
  Eigen::VectorXd origin;
  Eigen::VectorXd predicted;  ///< at the origin
  Eigen::MatrixXd step;       ///< scale · R⁻¹
  double scale;               ///< [unit of the response]

  Whitened(const CentredModel& law, const Eigen::VectorXd& theta, double scale_of_residuals)
      : model(law), origin(theta), predicted(law.predict(theta)), scale(scale_of_residuals) {
    const Eigen::Index size = theta.size();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(law.jacobian(predicted));
    step = scale * qr.matrixQR().topRows(size).triangularView<Eigen::Upper>().solve(
                       Eigen::MatrixXd::Identity(size, size));
  }

  [[nodiscard]] Eigen::VectorXd theta(const double* u) const {
    return origin + step * Eigen::Map<const Eigen::VectorXd>(u, origin.size());
  }
};

// Σ r² as its change from the origin, d·(r0 + d/2) with d = f0 (exp(Δ ln f) − 1): a sum of squares itself
// would lose the last half of the digits of θ, because it is flat at its minimum.
double change_of_squares(unsigned size, const double* u, double* gradient, void* data) {
  const auto& space = *static_cast<const Whitened*>(data);
  const Eigen::VectorXd shift = space.step * Eigen::Map<const Eigen::VectorXd>(u, size);
  const Eigen::VectorXd change = (space.model.design() * shift)
                                     .unaryExpr([](double x) { return std::expm1(x); })
                                     .cwiseProduct(space.predicted);
  const Eigen::VectorXd residual = space.predicted - space.model.response();
  const double scale2 = space.scale * space.scale;
  if (gradient != nullptr) {
    Eigen::Map<Eigen::VectorXd>(gradient, size) =
        space.step.transpose() *
        (space.model.jacobian(space.predicted + change).transpose() * (residual + change)) / scale2;
  }
  return change.dot(residual + 0.5 * change) / scale2;
}

// NLopt reports "no further progress possible" as an exception; the caller judges the point that was reached.
void run(nlopt::opt& optimiser, std::vector<double>& u) {
  double value = 0.0;
  const std::vector<double> start = u;
  try {
    optimiser.optimize(u, value);
  } catch (const std::runtime_error&) {
    // roundoff_limited or a plain failure: u holds the last point
  }
  if (!std::all_of(u.begin(), u.end(), [](double coordinate) { return std::isfinite(coordinate); }))
    u = start;
}

double relative_offset(const CentredModel& model, const Eigen::VectorXd& predicted) {
  const Eigen::VectorXd residual = predicted - model.response();
  if (residual.norm() <= kExactFit * model.response().norm()) return 0.0;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(model.jacobian(predicted));
  const Eigen::VectorXd rotated = qr.householderQ().transpose() * residual;
  return rotated.head(model.design().cols()).norm() / residual.norm();
}

}  // namespace

Eigen::VectorXd log_linear_start(const PowerProblem& problem) {
  const CentredModel model(problem);
  return model.uncentred(model.design().colPivHouseholderQr().solve(problem.response.array().log().matrix()));
}

PowerSolution solve_least_squares(const PowerProblem& problem, const Eigen::VectorXd& start) {
  const CentredModel model(problem);
  Eigen::VectorXd theta = model.centred(start);
  double offset = relative_offset(model, model.predict(theta));
  for (int restart = 0; restart < kRestarts && offset > kOffsetWanted; ++restart) {
    Whitened space(model, theta, (model.predict(theta) - problem.response).norm());
    nlopt::opt optimiser(nlopt::LD_SLSQP, static_cast<unsigned>(theta.size()));
    optimiser.set_min_objective(change_of_squares, &space);
    optimiser.set_xtol_abs(1e-13);
    optimiser.set_maxeval(kEvaluations);
    std::vector<double> u(static_cast<std::size_t>(theta.size()), 0.0);
    run(optimiser, u);
    const Eigen::VectorXd candidate = space.theta(u.data());
    const double candidate_offset = relative_offset(model, model.predict(candidate));
    const bool stuck = restart > 2 && candidate_offset >= offset;
    if (!stuck) {
      theta = candidate;
      offset = candidate_offset;
    } else if (offset <= kOffsetAccepted) {
      break;
    }
  }
  if (!(offset <= kOffsetAccepted)) {
    throw Unusable("the least-squares fit does not converge: no power law is near these points");
  }
  return model.solution(theta, offset);
}

}  // namespace repose::fit
