#include "contract/solver_contract_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

namespace nbvopt::testing_contract {
namespace {

const Eigen::Vector3d kSteepness(1.0, 2.0, 0.5);

ResidualFunction quadratic_residuals(const Eigen::Vector3d& optimum) {
  return [optimum](const Point& x, Eigen::VectorXd& residuals, Eigen::MatrixXd& jacobian) {
    residuals = kSteepness.cwiseProduct(x - optimum);
    jacobian = kSteepness.asDiagonal();
  };
}

Box cube(Eigen::Index dimension, double lower, double upper) {
  return {Point::Constant(dimension, lower), Point::Constant(dimension, upper)};
}

/// The surrogate of a problem: residuals a hundredth or so away.
Textbook surrogate_of(Textbook textbook) {
  constexpr double kError = 0.02;
  textbook.residuals = [true_residuals = std::move(textbook.residuals)](
                           const Point& x, Eigen::VectorXd& residuals, Eigen::MatrixXd& jacobian) {
    true_residuals(x, residuals, jacobian);
    for (Eigen::Index i = 0; i < residuals.size(); ++i) {
      const double phase = 2.0 * x[0] + static_cast<double>(i);
      residuals[i] += kError * std::sin(phase);
      jacobian(i, 0) += 2.0 * kError * std::cos(phase);
    }
  };
  textbook.has_surrogate = false;
  return textbook;
}

}  // namespace

TextbookProblem::TextbookProblem(Textbook textbook) : textbook_(std::move(textbook)) {
  if (!textbook_.has_surrogate) return;
  surrogate_ = std::make_unique<TextbookProblem>(surrogate_of(textbook_));
}

void TextbookProblem::use_threads(std::size_t threads) {
  threads_ = threads;
  if (surrogate_) surrogate_->use_threads(threads);
}

double TextbookProblem::period(Eigen::Index coordinate) const {
  if (coordinate != textbook_.periodic_coordinate) return 0.0;
  return box().upper[coordinate] - box().lower[coordinate];
}

double TextbookProblem::value(const Point& x) const {
  Eigen::VectorXd residuals;
  return value_and_residuals(x, residuals, nullptr);
}

void TextbookProblem::values(std::span<const Point> points, std::span<double> values) const {
  const auto evaluate_share = [&](std::size_t thread) {
    for (std::size_t i = thread; i < points.size(); i += threads_) values[i] = value(points[i]);
  };
  if (threads_ == 1) return evaluate_share(0);
  std::vector<std::jthread> workers;
  for (std::size_t thread = 0; thread < threads_; ++thread) {
    workers.emplace_back(evaluate_share, thread);
  }
}

double TextbookProblem::value_and_gradient(const Point& x, Point& gradient) const {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  const double value = value_and_residuals(x, residuals, &jacobian);
  gradient = -2.0 * jacobian.transpose() * residuals;
  return value;
}

double TextbookProblem::value_and_residuals(const Point& x, Eigen::VectorXd& residuals,
                                            Eigen::MatrixXd* jacobian) const {
  const std::size_t number = [&] {
    const std::lock_guard lock(mutex_);
    return ++evaluations_;
  }();
  before_evaluation(number);
  Eigen::MatrixXd own_jacobian;
  textbook_.residuals(x, residuals, jacobian ? *jacobian : own_jacobian);
  const double value = kTop - residuals.squaredNorm();
  const std::lock_guard lock(mutex_);
  records_.push_back({x, value});
  return value;
}

TextbookProblem quadratic(const Eigen::Vector3d& optimum) {
  return TextbookProblem(
      {.box = cube(3, -1.0, 2.0), .residual_count = 3, .residuals = quadratic_residuals(optimum)});
}

TextbookProblem rastrigin() {
  // Rastrigin's sum of y^2 + 10 (1 - cos 2 pi y) is a sum of squares: y and sqrt(20) sin pi y.
  const auto residual_function = [](const Point& x, Eigen::VectorXd& residuals,
                                    Eigen::MatrixXd& jacobian) {
    const Eigen::Array2d y = x.array() - Eigen::Array2d(1.3, -0.7);
    const double amplitude = std::sqrt(20.0);
    residuals.resize(4);
    residuals << y.matrix(), (amplitude * (std::numbers::pi * y).sin()).matrix();
    const Eigen::Vector2d slope = amplitude * std::numbers::pi * (std::numbers::pi * y).cos();
    jacobian.resize(4, 2);
    jacobian << Eigen::Matrix2d::Identity(), slope.asDiagonal().toDenseMatrix();
  };
  return TextbookProblem(
      {.box = cube(2, -4.0, 5.0), .residual_count = 4, .residuals = residual_function});
}

TextbookProblem plateau() {
  const auto residual_function = [](const Point& x, Eigen::VectorXd& residuals,
                                    Eigen::MatrixXd& jacobian) {
    const Eigen::Array2d offset = x.array() - 0.5;
    const Eigen::Array2d outside = (offset.abs() - 0.6).max(0.0);
    residuals = outside;
    jacobian = (outside > 0.0).select(offset.sign(), 0.0).matrix().asDiagonal();
  };
  return TextbookProblem(
      {.box = cube(2, -2.0, 2.0), .residual_count = 2, .residuals = residual_function});
}

TextbookProblem quadratic_with_nan(std::function<bool(const Point&)> is_nan) {
  const auto residual_function =
      [is_nan = std::move(is_nan), regular = quadratic_residuals({0.2, 0.3, 0.4})](
          const Point& x, Eigen::VectorXd& residuals, Eigen::MatrixXd& jacobian) {
        regular(x, residuals, jacobian);
        if (!is_nan(x)) return;
        residuals.setConstant(std::numeric_limits<double>::quiet_NaN());
        jacobian.setConstant(std::numeric_limits<double>::quiet_NaN());
      };
  return TextbookProblem(
      {.box = cube(3, -1.0, 2.0), .residual_count = 3, .residuals = residual_function});
}

TextbookProblem quadratic_over(Box box) {
  return TextbookProblem({.box = std::move(box),
                          .residual_count = 3,
                          .residuals = quadratic_residuals({0.2, 0.3, 0.4})});
}

}  // namespace nbvopt::testing_contract
