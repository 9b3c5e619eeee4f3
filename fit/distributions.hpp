#pragma once

namespace repose::fit {

// The laws of Boost.Math, by the names that this house uses.

/// The t with P(T ≤ t) = probability of Student's law.
/// @param probability         0 < p < 1
/// @param degrees_of_freedom  ν > 0 (any real number), infinity allowed: the normal law
double student_t_quantile(double probability, double degrees_of_freedom);

/// P(F ≥ ratio) of the F law with d1 and d2 > 0 degrees of freedom: the significance of a ratio of two mean
/// squares. 1 for a ratio ≤ 0, 0 for an infinite one.
double f_upper_tail(double ratio, double d1, double d2);

/// The noncentrality λ ≥ 0 with P(χ'² ≤ x) = probability, where χ'² is the sum of the squares of k normal
/// numbers of variance 1 whose squared means sum to λ; 0 where even λ = 0 gives less. Decreases with the
/// probability: λ(0.05) is the upper, λ(0.95) the lower 95 % bound of what a sum x was scattered from.
/// Beyond x = 1000 √x is taken as normal about √(λ + k − 1), which is within 2e-4 of λ there.
/// @param x            ≥ 0
/// @param k            > 0, any real number
/// @param probability  0 < p < 1
double noncentrality(double x, double k, double probability);

}  // namespace repose::fit
