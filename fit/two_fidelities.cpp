#include "fit/two_fidelities.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "fit/distributions.hpp"
#include "fit/solver.hpp"
#include "fit/uncertainty.hpp"

namespace repose::fit {
namespace {

// Columns that are this close to dependent leave no digit of their parameters.
constexpr double kSameDirection = 1e-7;
// Errors below this, relative to the mean angle, are those of the arithmetic: exact data prefer no model.
constexpr double kExactData = 1e-9;

/// Factors of `varying` whose exponent is corrected, by their number there.
using Terms = std::vector<Eigen::Index>;

class Problem {
 public:
  explicit Problem(const Selection& selection) : selection_(selection), plain_(problem_of(selection)) {
    reference_.resize(plain_.response.size());
    std::set<int> points;
    for (Eigen::Index i = 0; i < reference_.size(); ++i) {
      const auto row = static_cast<std::size_t>(i);
      reference_(i) = selection.used[row].cheap ? 0.0 : 1.0;
      if (!selection.used[row].cheap) points.insert(selection.point_of[row]);
    }
    reference_points_ = static_cast<int>(points.size());
  }

  [[nodiscard]] PowerProblem with(const Terms& terms) const {
    PowerProblem problem = plain_;
    const Eigen::Index k = plain_.log_factors.cols();
    problem.log_factors.conservativeResize(Eigen::NoChange, k + 1 + static_cast<Eigen::Index>(terms.size()));
    problem.log_factors.col(k) = reference_;
    for (std::size_t t = 0; t < terms.size(); ++t)
      problem.log_factors.col(k + 1 + static_cast<Eigen::Index>(t)) =
          reference_.cwiseProduct(plain_.log_factors.col(terms[t]));
    return problem;
  }

  /// Whether the rows tell all parameters apart, with a point of the reference to spare for the exponents.
  [[nodiscard]] bool determines(const Terms& terms) const {
    if (!terms.empty() && reference_points_ < static_cast<int>(terms.size()) + 2) return false;
    const PowerProblem problem = with(terms);
    if (problem.response.size() <= problem.log_factors.cols() + 1) return false;
    Eigen::MatrixXd columns = problem.log_factors.rowwise() - problem.log_factors.colwise().mean();
    for (Eigen::Index c = 0; c < columns.cols(); ++c) {
      if (!(columns.col(c).norm() > 0.0)) return false;
      columns.col(c).normalize();
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
    qr.setThreshold(kSameDirection);
    return qr.rank() == columns.cols();
  }

  [[nodiscard]] const Selection& selection() const { return selection_; }
  [[nodiscard]] Eigen::Index varying() const { return plain_.log_factors.cols(); }
  [[nodiscard]] const Eigen::VectorXd& reference() const { return reference_; }

 private:
  const Selection& selection_;
  PowerProblem plain_;
  Eigen::VectorXd reference_;  ///< δ
  int reference_points_ = 0;   ///< distinct
};

/// AICc with the correction's own rows and parameters in its penalty.
/// @param terms  exponents that are corrected
double criterion_of(const PowerSolution& solution, const PowerProblem& problem, double reference_rows,
                    std::size_t terms) {
  const auto n = static_cast<double>(problem.response.size());
  const double parameters = static_cast<double>(terms) + 2.0;  // with ln C' and the variance
  const double least = n * std::pow(kExactData * problem.response.mean(), 2);
  const double fit = n * std::log(std::max(solution.residual.squaredNorm(), least) / n);
  const double spare = reference_rows - parameters - 1.0;
  if (terms == 0 && !(spare > 0.0)) return fit;  // the one that is always there
  if (!(spare > 0.0)) return std::numeric_limits<double>::infinity();
  return fit + 2.0 * parameters + 2.0 * parameters * (parameters + 1.0) / spare;
}

struct Chosen {
  Terms terms;
  PowerProblem problem;
  PowerSolution solution;
};

Chosen best_of_all_subsets(const Problem& problem) {
  std::optional<Chosen> best;
  double least = 0.0;
  for (unsigned subset = 0; subset < 1U << static_cast<unsigned>(problem.varying()); ++subset) {
    Terms terms;
    for (Eigen::Index k = 0; k < problem.varying(); ++k)
      if (subset >> static_cast<unsigned>(k) & 1U) terms.push_back(k);
    if (!problem.determines(terms)) continue;
    PowerProblem rows = problem.with(terms);
    PowerSolution solution = solve_least_squares(rows, log_linear_start(rows));
    const double criterion = criterion_of(solution, rows, problem.reference().sum(), terms.size());
    if (best && !(criterion < least)) continue;
    least = criterion;
    best = Chosen{std::move(terms), std::move(rows), std::move(solution)};
  }
  if (!best)
    throw Unusable(
        "the rows of the cheap test and those of the reference cannot be told apart from a factor that they "
        "differ in: give reference points at factors that the cheap test has too");
  return *std::move(best);
}

Correction correction_of(const Chosen& chosen, const Problem& problem, const Eigen::MatrixXd& covariance,
                         double degrees_of_freedom) {
  Correction correction;
  const double t = student_t_quantile(0.975, degrees_of_freedom);
  const Eigen::Index k = problem.varying();
  const auto estimate = [&](double value, double standard_error) {
    return Estimate{value, standard_error, {value - t * standard_error, value + t * standard_error}, true};
  };
  const double factor = std::exp(chosen.solution.theta(k + 1));
  correction.C = estimate(factor, factor * std::sqrt(covariance(k + 1, k + 1)));
  for (std::size_t term = 0; term < chosen.terms.size(); ++term) {
    const Eigen::Index at = k + 2 + static_cast<Eigen::Index>(term);
    const Factor which = problem.selection().varying[static_cast<std::size_t>(chosen.terms[term])];
    (which == Factor::e      ? correction.a
     : which == Factor::mu_r ? correction.b
                             : correction.c) =
        estimate(chosen.solution.theta(at), std::sqrt(covariance(at, at)));
  }
  for (const Observation& row : problem.selection().used)
    ++(row.cheap ? correction.cheap_rows : correction.reference_rows);
  return correction;
}

}  // namespace

bool has_cheap_rows(const Selection& selection) {
  return std::ranges::any_of(selection.used, &Observation::cheap);
}

Selection reference_rows(const Selection& selection) {
  Selection rows = selection;
  std::erase_if(rows.used, [](const Observation& row) { return row.cheap; });
  return rows;
}

TwoFidelityFit solve_two_fidelities(const Selection& selection) {
  if (std::ranges::all_of(selection.used, &Observation::cheap))
    throw Unusable("every usable row is of the cheap test: a correction needs rows of the reference");
  const Problem problem(selection);
  const Chosen chosen = best_of_all_subsets(problem);

  TwoFidelityFit fit;
  fit.error = judge_error(chosen.solution, chosen.problem, selection);
  const Eigen::MatrixXd covariance = least_squares_covariance(chosen.solution, selection, fit.error);
  fit.correction = correction_of(chosen, problem, covariance, fit.error.degrees_of_freedom);

  // The reference's parameters are sums of the cheap law's and the correction's.
  const Eigen::Index k = problem.varying();
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(k + 1, chosen.solution.theta.size());
  sums.leftCols(k + 1).setIdentity();
  sums(0, k + 1) = 1.0;
  for (std::size_t term = 0; term < chosen.terms.size(); ++term)
    sums(1 + chosen.terms[term], k + 2 + static_cast<Eigen::Index>(term)) = 1.0;
  fit.theta = sums * chosen.solution.theta;
  fit.covariance = sums * covariance * sums.transpose();

  fit.residual.resize(fit.correction.reference_rows);
  Eigen::Index at = 0;
  for (Eigen::Index i = 0; i < chosen.solution.residual.size(); ++i)
    if (problem.reference()(i) > 0.0) fit.residual(at++) = chosen.solution.residual(i);
  return fit;
}

}  // namespace repose::fit
