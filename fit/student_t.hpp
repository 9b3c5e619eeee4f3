#pragma once

namespace repose::fit {

/// Regularised incomplete beta function I_x(a, b).
/// @param a, b  > 0
/// @param x     0 … 1
/// Source: DLMF 8.17.22 (continued fraction), summed by Lentz's method.
double incomplete_beta(double a, double b, double x);

/// P(T ≤ t) of Student's t with ν > 0 degrees of freedom (any real number; infinity is the normal law).
double student_t_cdf(double t, double degrees_of_freedom);

/// The t with P(T ≤ t) = probability, to twelve digits for a few degrees of
/// freedom and nine for millions.
/// @param probability         0 < p < 1
/// @param degrees_of_freedom  ν > 0, infinity allowed
double student_t_quantile(double probability, double degrees_of_freedom);

/// P(F ≥ ratio) of the F law with d1 and d2 degrees of freedom: the significance of a ratio of two mean
/// squares.
double f_upper_tail(double ratio, double d1, double d2);

}  // namespace repose::fit
