// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/gradient/gradient_admm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/flush_denormals.h"
#include "base/instantiate.h"
#include "base/parallel.h"
#include "mesh/cell_geometry.h"

namespace flbc::gradient {
namespace {

// The columns of a cell or facet.
template <int Columns, class FieldOf>
auto columns_of(FieldOf& field, Index element) {
  return field.template middleCols<Columns>(Eigen::Index{Columns} * element);
}

// Moves a dual by its over-relaxed step. \param sides  number of copies with this dual
template <class Dual, class Step, class Scalar>
Change move_dual(Dual dual, const Step& step, Scalar relaxation, int sides) {
  dual += relaxation * step;
  return {sides * static_cast<double>(step.squaredNorm()), 0, 0};
}

}  // namespace

template <class Scalar, int Dim>
GradientAdmm<Scalar, Dim>::GradientAdmm(const LbcProblem<Dim>& problem, double penalty,
                                        double relaxation, std::vector<Period<Dim>> periods)
    : problem_(problem),
      n_(problem.num_control_points()),
      penalty_(penalty),
      relaxation_(static_cast<Scalar>(relaxation)),
      periods_(std::move(periods)),
      M_(Dim + 2 + static_cast<double>(periods_.size())),
      data_(make_constraint_data<Scalar>(problem, penalty)) {
  const Eigen::Index rows = data_.basis.rows();
  const auto columns = Eigen::Index{Dim} * problem.mesh.num_cells();
  gradient_.setZero(rows, columns);
  extrapolated_.setZero(rows, columns);
  tv_dual_.setZero(rows, columns);
  facet_dual_.setZero(rows, Eigen::Index{Dim - 1} * problem.topology.num_facets());
  period_dual_.setZero(rows, static_cast<Eigen::Index>(periods_.size()));
}

template <class Scalar, int Dim>
template <class GradientsOf>
void GradientAdmm<Scalar, Dim>::start(const GradientsOf& gradients_of) {
  parallel_for(problem_.mesh.num_cells(), [&](Index s) {
    columns_of<Dim>(gradient_, s).topRows(n_) = gradients_of(s);
    columns_of<Dim>(extrapolated_, s) = columns_of<Dim>(gradient_, s);
  });
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_least_norm() {
  const Vectors least = data_.basis.topRows(n_) * data_.target;
  start([&](Index) -> const Vectors& { return least; });
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_weights(const WeightMatrix& weights) {
  start([&](Index s) -> Vectors {
    return weight_gradients(problem_.mesh, s, cell_geometry(problem_.mesh, s), weights)
        .template cast<Scalar>();
  });
}

// Sums the changes by steps at all elements, in parallel. Every step flushes denormal numbers,
// because they are slow.
template <class Scalar, int Dim>
template <class Step>
Change GradientAdmm<Scalar, Dim>::for_all(Index count, const Step& step) {
  return parallel_sum(count, Change{}, [&](Index begin, Index end) {
    const FlushDenormals scope;
    Scratch scratch;
    Change change;
    for (Index k = begin; k < end; ++k) change += step(k, scratch);
    return change;
  });
}

template <class Scalar, int Dim>
Change GradientAdmm<Scalar, Dim>::iterate(int count) {
  Change change;
  for (int k = 0; k < count; ++k) {
    change = for_all(problem_.topology.num_facets(), [&](Index facet, Scratch& scratch) {
      return problem_.topology.is_boundary(facet) ? x_step(facet, scratch) : y_step(facet, scratch);
    });
    for (std::size_t p = 0; p < periods_.size(); ++p) change += period_step(p);
    change += for_all(problem_.mesh.num_cells(), [&](Index cell, Scratch& scratch) {
      Change of_cell = z_step(cell, scratch);
      return of_cell += g_step(cell, scratch);
    });
  }
  return change;
}

// (9): the dual grows by the violation of t . g = h.
template <class Scalar, int Dim>
Change GradientAdmm<Scalar, Dim>::x_step(Index facet, Scratch& scratch) {
  const auto e = columns_of<Dim>(extrapolated_, problem_.topology.sides(0, facet));
  auto& step = scratch.tangential;
  step = columns_of<Dim - 1>(data_.boundary_slope, data_.boundary_index[facet]) -
         e.lazyProduct(data_.tangents[facet]);
  return move_dual(columns_of<Dim - 1>(facet_dual_, facet), step, relaxation_, 1);
}

// (10): the dual grows by half the jump of the tangential gradient.
template <class Scalar, int Dim>
Change GradientAdmm<Scalar, Dim>::y_step(Index facet, Scratch& scratch) {
  const auto sides = problem_.topology.sides.col(facet);
  auto& half_jump = scratch.vectors;
  auto& step = scratch.tangential;
  half_jump = Scalar(0.5) *
              (columns_of<Dim>(extrapolated_, sides[1]) - columns_of<Dim>(extrapolated_, sides[0]));
  step.noalias() = half_jump.lazyProduct(data_.tangents[facet]);
  return move_dual(columns_of<Dim - 1>(facet_dual_, facet), step, relaxation_, 2);
}

// Multiplies the vectors of a cell by theta + (1 - theta) min(1, radius / length), where theta is
// the smoothing of the cell and the radius is phi A / mu.
template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::shrink(Index cell, Vectors& vectors, Factors& factors) const {
  const auto radius = data_.radius.col(cell).array();
  const Scalar theta = data_.smoothing[cell];
  factors = vectors.col(0).array().square();
  for (int d = 1; d < Dim; ++d) factors += vectors.col(d).array().square();
  factors = factors.max(radius.square() + std::numeric_limits<Scalar>::min());
  factors = theta + (Scalar(1) - theta) * radius / factors.sqrt();
  for (int d = 0; d < Dim; ++d) vectors.col(d).array() *= factors;
}

// (7): the dual of Z = G is u - e, shortened.
template <class Scalar, int Dim>
Change GradientAdmm<Scalar, Dim>::z_step(Index cell, Scratch& scratch) {
  auto dual = columns_of<Dim>(tv_dual_, cell);
  auto& step = scratch.vectors;
  step = dual - columns_of<Dim>(extrapolated_, cell);
  shrink(cell, step, scratch.factors);
  step -= dual;
  return move_dual(dual, step, relaxation_, 1);
}

// The field of a period has norm 1, so its dual grows by the violation.
template <class Scalar, int Dim>
Change GradientAdmm<Scalar, Dim>::period_step(std::size_t period) {
  const auto& constraint = periods_[period];
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n_);
  const auto add_up = [&](Index begin, Index end) {
    Eigen::VectorXd sum = zero;
    for (Index s = begin; s < end; ++s) {
      sum += columns_of<Dim>(extrapolated_, s).topRows(n_).template cast<double>() *
             constraint.field.col(s);
    }
    return sum;
  };
  const Eigen::VectorXd step =
      constraint.values - parallel_sum(problem_.mesh.num_cells(), zero, add_up);
  period_dual_.col(static_cast<Eigen::Index>(period)).head(n_) +=
      relaxation_ * step.template cast<Scalar>();
  return {step.squaredNorm(), 0, 0};
}

// r_s of (11): g + (sum of its duals) / M.
template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::average_candidates(Index cell, Vectors& average) const {
  using Row = Eigen::Matrix<Scalar, 1, Dim>;
  average = columns_of<Dim>(tv_dual_, cell);
  for (const Index facet : problem_.topology.cell_facets.col(cell)) {
    const auto sign = Scalar(problem_.topology.sides(0, facet) == cell ? 1 : -1);
    const Eigen::Matrix<Scalar, Dim - 1, Dim> tangents = sign * data_.tangents[facet].transpose();
    average.noalias() += columns_of<Dim - 1>(facet_dual_, facet).lazyProduct(tangents);
  }
  for (std::size_t p = 0; p < periods_.size(); ++p) {
    const Row field = periods_[p].field.col(cell).transpose().template cast<Scalar>();
    average.noalias() += period_dual_.col(static_cast<Eigen::Index>(p)).lazyProduct(field);
  }
  average = columns_of<Dim>(gradient_, cell) + static_cast<Scalar>(1 / M_) * average;
}

// (8), (11): the average r, projected as r - Q (Q^T r - target).
template <class Scalar, int Dim>
Change GradientAdmm<Scalar, Dim>::g_step(Index cell, Scratch& scratch) {
  auto g = columns_of<Dim>(gradient_, cell);
  auto e = columns_of<Dim>(extrapolated_, cell);
  auto& projected = scratch.vectors;
  auto& step = scratch.step;
  average_candidates(cell, projected);
  const Eigen::Matrix<Scalar, Dim + 1, Dim> excess =
      data_.basis.transpose().lazyProduct(projected) - data_.target;
  projected.noalias() -= data_.basis.lazyProduct(excess);
  step = projected - g;
  const auto lead = relaxation_ == 1 ? (e - projected).squaredNorm() : Scalar(0);
  e = projected + step;
  g += relaxation_ * step;
  return {0, static_cast<double>(step.squaredNorm()), static_cast<double>(lead)};
}

template <class Scalar, int Dim>
Residuals GradientAdmm<Scalar, Dim>::residuals(const Change& change) const {
  // The duals of the paper, updated with the new G, differ from these duals by G_before - G. That
  // difference is orthogonal to the result of the G-step
  // (docs/explanation/method/gradient_admm.md), so Pythagoras applies.
  const double primal = relaxation_ == 1 ? change.dual - M_ * change.lead : change.dual;
  return {std::sqrt(std::max(primal, 0.0)), penalty_ * std::sqrt(M_ * change.gradient)};
}

template <class Scalar, int Dim>
double GradientAdmm<Scalar, Dim>::num_residual_components() const {
  return static_cast<double>(n_) * Dim * M_ * problem_.mesh.num_cells();
}

template <class Scalar, int Dim>
CellFieldView<Scalar, Dim> GradientAdmm<Scalar, Dim>::flux() const {
  flux_.resizeLike(tv_dual_);
  parallel_for(problem_.mesh.num_cells(), [&](Index begin, Index end) {
    Scratch scratch;
    for (Index s = begin; s < end; ++s) {
      scratch.vectors = columns_of<Dim>(extrapolated_, s) - columns_of<Dim>(tv_dual_, s);
      shrink(s, scratch.vectors, scratch.factors);
      columns_of<Dim>(flux_, s) = static_cast<Scalar>(penalty_) * scratch.vectors;
    }
  });
  return view(flux_);
}

template <class Scalar, int Dim>
double GradientAdmm<Scalar, Dim>::state_scalars_per_cell() const {
  const Eigen::Index numbers =
      gradient_.size() + extrapolated_.size() + tv_dual_.size() + facet_dual_.size();
  return static_cast<double>(numbers / gradient_.rows()) / problem_.mesh.num_cells();
}

FLBC_INSTANTIATE_SCALAR_CLASS(GradientAdmm)

}  // namespace flbc::gradient
