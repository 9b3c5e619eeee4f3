#pragma once

#include <Eigen/Core>

#include "fit/solver.hpp"

namespace repose::fit {

/// The law with ln x taken from its mean, which makes ln C nearly independent of the exponents.
class CentredModel {
 public:
  explicit CentredModel(const PowerProblem& problem)
      : response_(problem.response), mean_(problem.log_factors.colwise().mean()) {
    design_.resize(problem.log_factors.rows(), problem.log_factors.cols() + 1);
    design_.col(0).setOnes();
    design_.rightCols(problem.log_factors.cols()) = problem.log_factors.rowwise() - mean_;
  }

  [[nodiscard]] const Eigen::MatrixXd& design() const { return design_; }
  [[nodiscard]] const Eigen::VectorXd& response() const { return response_; }
  [[nodiscard]] Eigen::VectorXd predict(const Eigen::VectorXd& theta) const {
    return (design_ * theta).array().exp();
  }
  [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& predicted) const {
    return predicted.asDiagonal() * design_;
  }
  [[nodiscard]] Eigen::VectorXd centred(Eigen::VectorXd theta) const {
    theta(0) += mean_.dot(theta.tail(mean_.size()));
    return theta;
  }
  [[nodiscard]] Eigen::VectorXd uncentred(Eigen::VectorXd theta) const {
    theta(0) -= mean_.dot(theta.tail(mean_.size()));
    return theta;
  }

  /// What a solver hands out for a θ of the centred law.
  [[nodiscard]] PowerSolution solution(const Eigen::VectorXd& theta, double optimality) const {
    const Eigen::VectorXd predicted = predict(theta);
    PowerSolution result;
    result.theta = uncentred(theta);
    result.residual = predicted - response_;
    result.jacobian = jacobian(predicted);
    result.jacobian.rightCols(mean_.size()) += predicted * mean_;
    result.optimality = optimality;
    return result;
  }

 private:
  Eigen::VectorXd response_;
  Eigen::RowVectorXd mean_;
  Eigen::MatrixXd design_;
};

}  // namespace repose::fit
