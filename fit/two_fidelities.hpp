#pragma once

#include <Eigen/Core>

#include "fit/power_law.hpp"
#include "fit/selection.hpp"

namespace repose::fit {

/// Whether a selection holds rows of a cheap test (Observation::cheap).
bool has_cheap_rows(const Selection& selection);

/// Rows of the reference alone; `varying` stays that of the whole.
Selection reference_rows(const Selection& selection);

/// The reference's law from many rows of a cheap test and few of the reference.
struct TwoFidelityFit {
  Eigen::VectorXd theta;       ///< (ln C, exponents of the varying factors) of the reference
  Eigen::MatrixXd covariance;  ///< of theta
  ErrorModel error;
  Correction correction;
  Eigen::VectorXd residual;  ///< predicted − observed of the reference's rows [deg]
};

/// One least-squares problem for both tests: with δ = 1 in the reference's rows and 0 elsewhere,
///
///   ln α = ln C + Σ p_k ln x_k + δ (ln C' + Σ p'_k ln x_k),
///
/// solved in degrees as fit_power_law() does, the scatter of both taken as equal. The reference's parameters
/// are the sums p + p', and their covariance follows from that of all, so that the errors of the cheap law
/// and of the correction are both in it.
///
/// Of the corrections p' those are taken that AICc (Hurvich & Tsai 1989) finds worth their price, over all
/// subsets that the reference's points can tell apart with at least one to spare; ln C' is always there. Its
/// penalty counts the rows and parameters of the correction alone, however many cheap rows there are: few
/// rows give a factor, more give exponents.
///
/// Throws Unusable: no row of the reference; a factor that changes only between the two tests.
TwoFidelityFit solve_two_fidelities(const Selection& selection);

}  // namespace repose::fit
