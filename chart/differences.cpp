#include "chart/differences.hpp"

#include <algorithm>
#include <cmath>

#include "fit/distributions.hpp"

namespace repose::chart {

namespace {

constexpr double kDependenceLevel = 0.05;
constexpr double kConfidence = 0.95;

/// Sets scatter differently: heaps of high friction several times as much as those of low. So every set has a
/// variance of its own, s²/n of its mean, with n − 1 degrees of freedom. V is the covariance of the means:
/// these on the diagonal, and what shared columns add.
class Sets {
 public:
  explicit Sets(const Differences& differences) : estimates_(estimates_of(differences.rows)) {
    const auto size = static_cast<Eigen::Index>(estimates_.size());
    d_.resize(size), own_.resize(size), freedom_.resize(size);
    for (Eigen::Index k = 0; k < size; ++k) {
      const auto set = static_cast<std::size_t>(k);
      d_[k] = estimates_[set].value;
      own_[k] = std::pow(estimates_[set].standard_error, 2);
      freedom_[k] = static_cast<double>(differences.rows[set].size()) - 1.0;
    }
    shared_.setZero(size, size);
    if (differences.shared.covariance.size() > 0) shared_ = differences.shared.covariance;
    freedom_of_shared_ = differences.shared.freedom;
    covariance_ = shared_;
    covariance_.diagonal() += own_;
    for (Eigen::Index k = 0; k < size; ++k)
      estimates_[static_cast<std::size_t>(k)].standard_error = std::sqrt(std::max(0.0, covariance_(k, k)));
  }

  [[nodiscard]] const std::vector<Estimate>& estimates() const { return estimates_; }

  void judge_mean(Judgement& judgement) const {
    const double variance = std::max(0.0, covariance_.sum());
    judgement.mean.value = d_.mean();
    judgement.mean.standard_error = std::sqrt(variance) / count();
    judgement.mean_bound_95 = std::abs(judgement.mean.value);
    if (variance > 0.0)
      judgement.mean_bound_95 +=
          t_of(Eigen::VectorXd::Ones(d_.size()), shared_.sum()) * judgement.mean.standard_error;
  }

  /// dᵀd is a sum of squares of normal numbers with the means δ and the covariance V. It is taken as a
  /// χ'²_k(λ), which has the same mean and variance where
  ///     a (k + λ) = tr V + δᵀδ   and   2 a² k + 4 a² λ = 2 tr V² + 4 δᵀVδ,   a k = tr V,   a λ = δᵀδ,
  /// so a = (tr V² + 2 δᵀVδ)/(tr V + 2 δᵀδ), k = tr V/a; exact where V is a multiple of the identity. δ is
  /// not known. For the lower bound d stands for it; for the upper one |d| + z √V_kk, as far as it may well
  /// be: where d of a set that scatters much happens to be small, d itself would hide its noise (5 and 9
  /// sets, one with 40 times the scatter of the others: the bound held in 86 of 100). The bounds are those of
  /// λ. That V is an estimate is met as in Student's law: a is larger by (t(ν)/z)². The bound is that of dᵀd
  /// = a k at least: differences that happen to be smaller than their noise show nothing smaller than it.
  /// 3000 experiments each of 15 kinds, 1 to 9 sets with 5 runs or more and scatters up to 40 to 1: the upper
  /// bound held in 93.6 to 100 of 100, the lower in 95 to 98.
  void judge_error(Judgement& judgement) const {
    const double squares = d_.squaredNorm();
    judgement.error = std::sqrt(squares / count());
    judgement.low_95 = judgement.bound_95 = judgement.error;
    if (!(covariance_.trace() > 0.0)) return;
    const Spread seen = spread(d_);
    const double z = fit::student_t_quantile(kConfidence, INFINITY);
    const Spread at_most = spread(d_.cwiseAbs() + z * covariance_.diagonal().cwiseMax(0.0).cwiseSqrt());
    const Spread alone = spread(Eigen::VectorXd::Zero(d_.size()));
    judgement.low_95 = seen.error(fit::noncentrality(squares / seen.a, seen.k, kConfidence));
    judgement.bound_95 = at_most.error(
        fit::noncentrality(std::max(squares / at_most.a, at_most.k), at_most.k, 1.0 - kConfidence));
    judgement.noise_bound_95 = alone.error(fit::noncentrality(alone.k, alone.k, 1.0 - kConfidence));
  }

  /// Welch's F of the means with their own variances; what columns add is much the same for all sets, and
  /// moves none against another. A set without scatter (the same motion in both tests) has all the weight
  /// that numbers allow.
  [[nodiscard]] double dependence_p() const {
    const double largest = own_.maxCoeff();
    if (d_.size() < 2) return 1.0;
    if (!(largest > 0.0)) return (d_.array() == d_[0]).all();
    const Eigen::ArrayXd weight = own_.array().max(1e-9 * largest).inverse();
    const double all = weight.sum();
    const double centre = (weight * d_.array()).sum() / all;
    const double between = (weight * (d_.array() - centre).square()).sum() / (count() - 1.0);
    const double unsure =
        ((1.0 - weight / all).square() / freedom_.array()).sum() / (count() * count() - 1.0);
    return fit::f_upper_tail(between / (1.0 + 2.0 * (count() - 2.0) * unsure), count() - 1.0,
                             1.0 / (3.0 * unsure));
  }

 private:
  /// dᵀd as a times a χ'²_k, a with Student's widening.
  struct Spread {
    double a, k, sets;
    [[nodiscard]] double error(double lambda) const { return std::sqrt(a * lambda / sets); }
  };
  /// @param delta  what the means of the sets are taken to be
  [[nodiscard]] Spread spread(const Eigen::VectorXd& delta) const {
    const double noise = covariance_.trace();
    const double a = (covariance_.squaredNorm() + 2.0 * delta.dot(covariance_ * delta)) /
                     (noise + 2.0 * delta.squaredNorm());
    const Eigen::VectorXd weight = covariance_.diagonal().array() + 2.0 * delta.array().square();
    const double wider =
        t_of(weight, weight.dot(shared_.diagonal())) / fit::student_t_quantile(kConfidence, INFINITY);
    return {wider * wider * a, noise / a, count()};
  }

  [[nodiscard]] double count() const { return static_cast<double>(d_.size()); }

  /// t(0.95, ν) of a weighted sum of the sets' own variances and of `shared`, with the ν of Satterthwaite
  /// (1946).
  [[nodiscard]] double t_of(const Eigen::VectorXd& weight, double shared) const {
    const Eigen::ArrayXd own = weight.array() * own_.array();
    const double more = std::max(0.0, shared), total = own.sum() + more;
    const double of_each = ((own / total).square() / freedom_.array()).sum();
    const double of_shared = more > 0.0 ? std::pow(more / total, 2) / freedom_of_shared_ : 0.0;
    return fit::student_t_quantile(kConfidence, 1.0 / (of_each + of_shared));
  }

  std::vector<Estimate> estimates_;
  Eigen::VectorXd d_, own_, freedom_;
  Eigen::MatrixXd shared_, covariance_;  ///< what columns add; V
  double freedom_of_shared_ = INFINITY;
};

}  // namespace

Judgement judge(const Differences& differences) {
  const Sets sets(differences);
  Judgement judgement;
  judgement.by_set = sets.estimates();
  const auto worst =
      std::ranges::max_element(judgement.by_set, {}, [](const Estimate& set) { return std::abs(set.value); });
  judgement.worst = *worst;
  judgement.worst_at = static_cast<std::size_t>(worst - judgement.by_set.begin());
  sets.judge_mean(judgement);
  sets.judge_error(judgement);
  judgement.dependence_p = sets.dependence_p();
  judgement.depends_on_friction = judgement.dependence_p < kDependenceLevel;
  return judgement;
}

}  // namespace repose::chart
