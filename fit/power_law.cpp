#include "fit/power_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fit/distributions.hpp"
#include "fit/selection.hpp"
#include "fit/solver.hpp"
#include "fit/two_fidelities.hpp"
#include "fit/uncertainty.hpp"

namespace repose::fit {
namespace {

constexpr double kGapWorthSaying = 1e-6;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Estimate& exponent_of(PowerLaw& law, Factor factor) {
  switch (factor) {
    case Factor::e:
      return law.a;
    case Factor::mu_r:
      return law.b;
    default:
      return law.c;
  }
}

Domain domain_of(const std::vector<Observation>& rows) {
  const auto range = [&rows](auto&& value) {
    Range r{value(rows.front()), value(rows.front())};
    for (const Observation& row : rows) {
      r.low = std::min(r.low, value(row));
      r.high = std::max(r.high, value(row));
    }
    return r;
  };
  return {range([](const Observation& row) { return row.e; }),
          range([](const Observation& row) { return row.mu_s; }),
          range([](const Observation& row) { return row.mu_r; }),
          range([](const Observation& row) { return row.angle; })};
}

// θ of the solver holds the varying factors alone; here each goes to its place among (ln C, a, b, c).
void place_parameters(PowerLaw& law, const Selection& selection, const Eigen::VectorXd& theta,
                      const Eigen::MatrixXd& covariance) {
  std::vector<Eigen::Index> place = {0};
  for (const Factor factor : selection.varying) place.push_back(1 + static_cast<Eigen::Index>(factor));
  for (std::size_t i = 0; i < place.size(); ++i) {
    for (std::size_t j = 0; j < place.size(); ++j) {
      law.covariance(place[i], place[j]) =
          covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  const double t = student_t_quantile(0.975, law.error.degrees_of_freedom);
  const auto estimate = [t](double value, double standard_error) {
    return Estimate{value, standard_error, {value - t * standard_error, value + t * standard_error}, true};
  };
  law.a = law.b = law.c = Estimate{0.0, kNaN, {kNaN, kNaN}, false};
  const double C = std::exp(theta(0));
  law.C = estimate(C, C * std::sqrt(law.covariance(0, 0)));
  for (std::size_t i = 1; i < place.size(); ++i) {
    exponent_of(law, selection.varying[i - 1]) =
        estimate(theta(static_cast<Eigen::Index>(i)), std::sqrt(law.covariance(place[i], place[i])));
  }
}

void place_errors(PowerLaw& law, const std::vector<Observation>& rows, const Eigen::VectorXd& residual) {
  Eigen::Index worst = 0;
  law.worst_error = residual.cwiseAbs().maxCoeff(&worst);
  law.worst_point = rows[static_cast<std::size_t>(worst)];
  Eigen::VectorXd observed(residual.size());
  for (Eigen::Index i = 0; i < observed.size(); ++i) observed(i) = rows[static_cast<std::size_t>(i)].angle;
  const double sum = residual.squaredNorm();
  const double total = (observed.array() - observed.mean()).matrix().squaredNorm();
  law.rms_error = std::sqrt(sum / static_cast<double>(observed.size()));
  law.r_squared = total > 0.0 ? 1.0 - sum / total : kNaN;
}

void add_remarks(PowerLaw& law, const Selection& selection) {
  for (const Factor factor : kFactors) {
    if (std::find(selection.varying.begin(), selection.varying.end(), factor) != selection.varying.end())
      continue;
    law.remarks.push_back(fmt::format(
        "{} is {} in every point: its exponent cannot be found and is set to 0, C holds its effect",
        name_of(factor), range_of(law.domain, factor).low));
  }
  if (law.error.lack_of_fit_p < 0.05) {
    law.remarks.push_back(
        fmt::format("the law misses the angles by more than the scatter of repeats ({:.2f} deg) explains (P "
                    "= {:.2g}): its "
                    "errors are those of its form, and more repeats do not make them smaller",
                    law.error.pure_error, law.error.lack_of_fit_p));
  }
}

/// Where the reference's points do not reach as far as the cheap ones.
void remark_on_reach(PowerLaw& law, const Selection& selection, const Domain& reference) {
  constexpr double kSame = 1e-9;
  for (const Factor factor : selection.varying) {
    const Range& all = range_of(law.domain, factor);
    const Range& own = range_of(reference, factor);
    if (own.low > all.low * (1.0 + kSame) || own.high < all.high * (1.0 - kSame))
      law.remarks.push_back(fmt::format(
          "the reference's points reach from {} = {:.4g} to {:.4g} only: beyond, the correction is "
          "carried on from there",
          name_of(factor), own.low, own.high));
  }
}

PowerLaw fit_both_tests(Selection selection, Loss loss) {
  if (loss != Loss::least_squares)
    throw Unusable("rows of a cheap test and of a reference are fitted together by least squares only");
  const TwoFidelityFit fit = solve_two_fidelities(selection);
  const Selection reference = reference_rows(selection);
  PowerLaw law;
  law.error = fit.error;
  law.domain = domain_of(selection.used);
  const Domain own = domain_of(reference.used);
  law.domain.angle = own.angle;
  law.points = static_cast<int>(selection.used.size());
  law.distinct_points = selection.distinct_points;
  law.correction = fit.correction;
  place_parameters(law, selection, fit.theta, fit.covariance);
  place_errors(law, reference.used, fit.residual);
  add_remarks(law, selection);
  remark_on_reach(law, selection, own);
  law.excluded = std::move(selection.excluded);
  return law;
}

}  // namespace

const char* name_of(Loss loss) { return loss == Loss::minimax ? "minimax" : "least-squares"; }

Loss loss_named(const std::string& name) {
  for (const Loss loss : {Loss::least_squares, Loss::minimax}) {
    if (name == name_of(loss)) return loss;
  }
  throw Unusable(fmt::format("loss '{}': must be least-squares or minimax", name));
}

Eigen::Vector4d PowerLaw::log_row(const Factors& factors) const {
  return {1.0, a.identified ? std::log(factors.e) : 0.0, b.identified ? std::log(factors.mu_r) : 0.0,
          c.identified ? std::log(factors.mu_s) : 0.0};
}

double PowerLaw::predict(const Factors& factors) const {
  return C.value * std::exp(log_row(factors).dot(Eigen::Vector4d(0.0, a.value, b.value, c.value)));
}

double PowerLaw::standard_error_at(const Factors& factors) const {
  const Eigen::Vector4d h = log_row(factors);
  return predict(factors) * std::sqrt(std::max(0.0, h.dot(covariance * h)));
}

Eigen::Matrix4d PowerLaw::correlation() const {
  const Eigen::Vector4d deviation = covariance.diagonal().cwiseSqrt();
  Eigen::Matrix4d result = covariance.cwiseQuotient(deviation * deviation.transpose());
  const auto all = parameters();
  for (Eigen::Index i = 0; i < 4; ++i) {
    if (all[static_cast<std::size_t>(i)]->identified) {
      result(i, i) = 1.0;
    } else {
      result.row(i).setConstant(kNaN);
      result.col(i).setConstant(kNaN);
    }
  }
  return result;
}

PowerLaw fit_power_law(std::span<const Observation> table, Loss loss) {
  Selection selection = select_points(table);
  if (has_cheap_rows(selection)) return fit_both_tests(std::move(selection), loss);
  const PowerProblem problem = problem_of(selection);
  const PowerSolution least_squares = solve_least_squares(problem, log_linear_start(problem));

  PowerLaw law;
  law.loss = loss;
  law.error = judge_error(least_squares, problem, selection);
  law.domain = domain_of(selection.used);
  law.points = static_cast<int>(selection.used.size());
  law.distinct_points = selection.distinct_points;
  if (loss == Loss::minimax) {
    const PowerSolution minimax = solve_minimax(problem, least_squares.theta);
    place_parameters(law, selection, minimax.theta,
                     minimax_covariance(problem, least_squares, selection, law.error));
    place_errors(law, selection.used, minimax.residual);
    if (minimax.optimality > kGapWorthSaying) {
      law.remarks.push_back(fmt::format("the worst error may be up to {:.2g} % above the smallest possible",
                                        100.0 * minimax.optimality));
    }
  } else {
    place_parameters(law, selection, least_squares.theta,
                     least_squares_covariance(least_squares, selection, law.error));
    place_errors(law, selection.used, least_squares.residual);
  }
  add_remarks(law, selection);
  law.excluded = std::move(selection.excluded);
  return law;
}

}  // namespace repose::fit
