// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/vertex_linear_program.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "polytope/nearest_point_in_hull.h"
#include "polytope/scaling.h"

namespace flbc {
namespace {

// Smaller pivots, relative to 1, are rounding errors.
constexpr double kLeastPivot = 1e-9;
// Minimum pivot for a control point to enter the initial basis.
constexpr double kIndependent = 1e-6;
constexpr double kDependent = 1e-13;
// Smaller negative values of basic variables are rounding errors.
constexpr double kInfeasible = 1e-9;

}  // namespace

template <int Dim>
VertexLinearProgram<Dim>::VertexLinearProgram(const PointList<Dim>& control_points)
    : points_(control_points),
      scale_(scale_of<Dim>(control_points)),
      columns_(control_points.cols(), kRows) {
  columns_.col(0).setOnes();
}

template <int Dim>
double VertexLinearProgram<Dim>::lower_bound(const Vector<Dim>& point, const Eigen::VectorXd& costs,
                                             const Eigen::VectorXd& start) {
  columns_.template rightCols<Dim>() = scaled_offsets<Dim>(points_, point, scale_).transpose();
  best_multipliers_.setZero();
  bool started = start_from(start, costs);
  if (!started) {
    started = start_from(vertex_of(nearest_point_in_hull(points_, point), costs.size()), costs);
  }
  if (started) iterate(costs);
  return rigorous_bound(costs);
}

// Makes a feasible basis of no higher cost from feasible weights. Each weight outside the basis is
// moved in the direction of decreasing cost until a weight reaches zero.
template <int Dim>
bool VertexLinearProgram<Dim>::start_from(const Eigen::VectorXd& start,
                                          const Eigen::VectorXd& costs) {
  if (!choose_basis(start)) return false;
  for (int k = 0; k < kRows; ++k) values_[k] = std::max(0.0, start[basis_[k]]);
  const auto chosen = basis_;
  for (Index i = 0; i < static_cast<Index>(start.size()); ++i) {
    if (!(start[i] > 0) || std::find(chosen.begin(), chosen.end(), i) != chosen.end()) continue;
    push_to_zero(i, start[i], costs);
  }
  factor();
  return values_.minCoeff() >= -kInfeasible;
}

// Chooses large weights far from the affine hull of the previous choices. If they do not span space
// (for example on a facet of the hull), other distant control points are added.
template <int Dim>
bool VertexLinearProgram<Dim>::choose_basis(const Eigen::VectorXd& start) {
  rest_ = columns_;
  for (int k = 0; k < kRows; ++k) {
    const Eigen::ArrayXd distances = rest_.rowwise().norm();
    Eigen::Index next;
    const double largest =
        (distances > kIndependent).select(distances * start.array(), 0).maxCoeff(&next);
    if (!(largest > 0) && !(distances.maxCoeff(&next) > kDependent)) return false;
    basis_[k] = static_cast<Index>(next);
    const Sums direction = rest_.row(next).transpose().normalized();
    for (int pass = 0; pass < 2; ++pass) rest_ -= (rest_ * direction) * direction.transpose();
  }
  factor();
  return true;
}

template <int Dim>
void VertexLinearProgram<Dim>::push_to_zero(Index entering, double value,
                                            const Eigen::VectorXd& costs) {
  const Sums column = lu_.solve(columns_.row(entering).transpose());
  // The basic variables change by column * step when the entering one changes by -step.
  const bool grows = costs[entering] < basic_costs(costs).dot(column);
  double step = grows ? std::numeric_limits<double>::infinity() : value;
  int leaving = -1;
  for (int k = 0; k < kRows; ++k) {
    const double falls = grows ? column[k] : -column[k];
    if (falls <= kLeastPivot || values_[k] >= step * falls) continue;
    step = std::max(0.0, values_[k]) / falls;
    leaving = k;
  }
  if (leaving < 0 && grows) return;
  values_ += (grows ? -step : step) * column;
  if (leaving < 0) return;
  const Sums values = values_;
  basis_[leaving] = entering;
  factor();
  values_ = values;  // of the given point, not of the basic solution
  values_[leaving] = grows ? value + step : value - step;
}

template <int Dim>
void VertexLinearProgram<Dim>::iterate(const Eigen::VectorXd& costs) {
  const Eigen::Index limit = 100 + 10 * costs.size();
  const double tolerance = 1e-14 * costs.cwiseAbs().maxCoeff();
  double best = -std::numeric_limits<double>::infinity();
  int steps_in_place = 0;
  for (Eigen::Index step = 0; step < limit; ++step) {
    const Sums multipliers = lu_.solve_transposed(basic_costs(costs));
    reduced_costs_ = costs;
    reduced_costs_.noalias() -= columns_ * multipliers;
    const double bound = multipliers[0] + reduced_costs_.minCoeff();
    if (bound > best) {
      best = bound;
      best_multipliers_ = multipliers;
    }
    // Bland's rule cannot cycle, but takes longer.
    const bool first = steps_in_place > 2 * kRows;
    const Eigen::Index entering = choose_entering(first, tolerance);
    if (entering < 0) return;
    const Sums column = lu_.solve(columns_.row(entering).transpose());
    const int leaving = choose_leaving(column, first);
    if (leaving < 0) return;
    steps_in_place = values_[leaving] > 0 ? 0 : steps_in_place + 1;
    basis_[leaving] = static_cast<Index>(entering);
    factor();
    values_ = (values_.array() > kDependent).select(values_, 0);
  }
}

// The most negative reduced cost, or the first negative one; -1 at the optimum.
template <int Dim>
Eigen::Index VertexLinearProgram<Dim>::choose_entering(bool first, double tolerance) const {
  Eigen::Index least;
  if (!(reduced_costs_.minCoeff(&least) < -tolerance)) return -1;
  if (first) {
    least = 0;
    while (!(reduced_costs_[least] < -tolerance)) ++least;
  }
  const bool is_basic = std::find(basis_.begin(), basis_.end(), least) != basis_.end();
  return is_basic ? -1 : least;  // rounding, if it is basic
}

// The basic variable that reaches zero first. Ties go to the largest pivot, or to the first one.
template <int Dim>
int VertexLinearProgram<Dim>::choose_leaving(const Sums& column, bool first) const {
  double least = std::numeric_limits<double>::infinity();
  int leaving = -1;
  for (int k = 0; k < kRows; ++k) {
    if (column[k] <= kLeastPivot) continue;
    const double ratio = values_[k] / column[k];
    const bool preferred =
        leaving >= 0 && (first ? basis_[k] < basis_[leaving] : column[k] > column[leaving]);
    if (ratio > least || (ratio == least && !preferred)) continue;
    least = ratio;
    leaving = k;
  }
  return leaving;
}

// Factors the basis and computes its values.
template <int Dim>
void VertexLinearProgram<Dim>::factor() {
  Square matrix;
  for (int k = 0; k < kRows; ++k) matrix.col(k) = columns_.row(basis_[k]).transpose();
  lu_.compute(matrix);
  values_ = lu_.solve(Sums::Unit(0));
}

// The error of each operation is at most half an epsilon of its result; there are 3 Dim + 1
// operations.
template <int Dim>
double VertexLinearProgram<Dim>::rigorous_bound(const Eigen::VectorXd& costs) {
  constexpr double kErrorOfSum = (3 * Dim + 4) * std::numeric_limits<double>::epsilon();
  const auto bound_with = [&](const Sums& multipliers) {
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < costs.size(); ++i) {
      double value = costs[i], magnitude = std::abs(costs[i]);
      for (int k = 1; k < kRows; ++k) {
        const double product = multipliers[k] * columns_(i, k);
        value -= product;
        magnitude += std::abs(product);
      }
      least = std::min(least, value - kErrorOfSum * magnitude);
    }
    return least;
  };
  if (!best_multipliers_.allFinite()) best_multipliers_.setZero();
  return bound_with(best_multipliers_);
}

template class VertexLinearProgram<2>;
template class VertexLinearProgram<3>;

}  // namespace flbc
