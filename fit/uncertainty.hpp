#pragma once

#include <Eigen/Core>

#include "fit/power_law.hpp"
#include "fit/selection.hpp"
#include "fit/solver.hpp"

namespace repose::fit {

/// The scatter about a least-squares fit, split into that of repeats and that of the law (see fit_power_law).
/// Points with as many parameters as there are leave the law's open: the scatter is that of repeats then.
/// Requires more rows than parameters, or repeats.
ErrorModel judge_error(const PowerSolution& fit, const PowerProblem& problem, const Selection& selection);

/// Cov θ of a least-squares fit (see fit_power_law), by QR.
Eigen::MatrixXd least_squares_covariance(const PowerSolution& fit, const Selection& selection,
                                         const ErrorModel& error);

/// Covariance of the minimax θ over refits to angles = least-squares law + normal errors by `error`. Errors
/// drawn from the residuals would do only for statistics that are not made of extremes: intervals from them
/// held in 90 to 93 of 100. The same draws on every machine.
Eigen::MatrixXd minimax_covariance(const PowerProblem& problem, const PowerSolution& least_squares,
                                   const Selection& selection, const ErrorModel& error);

}  // namespace repose::fit
