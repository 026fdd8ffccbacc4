// SPDX-License-Identifier: BSD-3-Clause
#include "gradient/gradient_admm.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "barycentric_constraints.h"
#include "cell_geometry.h"
#include "parallel.h"
#include "state_memory.h"

namespace flbc::gradient {
namespace {

// Orthonormal basis of the facet's tangent space, a column per direction.
template <int Dim>
Eigen::Matrix<double, Dim, Dim - 1> tangent_basis(const LbcProblem<Dim>& problem, Index facet) {
  const auto point = [&](int k) {
    return problem.mesh.points.col(problem.topology.facets(k, facet));
  };
  Eigen::Matrix<double, Dim, Dim - 1> tangents;
  tangents.col(0) = (point(1) - point(0)).normalized();
  if constexpr (Dim == 3) {
    const Vector<3> edge = point(2) - point(0);
    tangents.col(1) = (edge - tangents.col(0) * tangents.col(0).dot(edge)).normalized();
  }
  return tangents;
}

}  // namespace

template <class Scalar, int Dim>
GradientAdmm<Scalar, Dim>::GradientAdmm(const LbcProblem<Dim>& problem, double penalty,
                                        double relaxation, const std::vector<Period<Dim>>& periods,
                                        StateStorage* storage)
    : problem_(problem),
      kernel_(select_kernel<Scalar, Dim>()),
      n_(problem.num_control_points()),
      stride_(static_cast<std::size_t>((n_ + kLanes - 1) / kLanes * kLanes)),
      penalty_(penalty),
      relaxation_(relaxation),
      num_periods_(periods.size()),
      copies_(Dim + 2 + static_cast<double>(periods.size())) {
  const auto cells = static_cast<std::size_t>(problem.mesh.num_cells());
  const auto facets = static_cast<std::size_t>(problem.topology.num_facets());
  const auto state = [&](StateArray array, std::size_t elements, std::size_t components) {
    return state_array<Scalar>(storage, array, elements, components, stride_);
  };
  gradient_ = state(StateArray::kGradient, cells, Dim);
  extrapolated_ = state(StateArray::kExtrapolatedGradient, cells, Dim);
  tv_dual_ = state(StateArray::kTvDual, cells, Dim);
  facet_dual_ = state(StateArray::kIntegrabilityDual, facets, Dim - 1);
  set_up_facets(problem);
  set_up_boundary_slopes(problem);
  set_up_constraints(problem);
  set_up_radii(problem);
  set_up_periods(periods, storage);
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::set_up_facets(const LbcProblem<Dim>& problem) {
  const Index num_facets = problem.topology.num_facets();
  tangents_.resize(static_cast<std::size_t>(num_facets) * (Dim - 1) * Dim);
  boundary_slot_.assign(num_facets, -1);
  Index num_boundary = 0;
  for (Index f = 0; f < num_facets; ++f) {
    Eigen::Map<Eigen::Matrix<Scalar, Dim, Dim - 1>>(tangents_.data() + f * (Dim - 1) * Dim) =
        tangent_basis(problem, f).template cast<Scalar>();
    if (problem.topology.is_boundary(f)) boundary_slot_[f] = num_boundary++;
  }
  boundary_slope_ =
      AlignedArray<Scalar>(static_cast<std::size_t>(num_boundary) * (Dim - 1) * stride_);
}

// h of (9): the derivatives of the boundary values along the facet's tangents.
template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::set_up_boundary_slopes(const LbcProblem<Dim>& problem) {
  const auto& facets = problem.topology.facets;
  Eigen::MatrixXd corner_weights(n_, Dim);
  for (Index f = 0; f < problem.topology.num_facets(); ++f) {
    if (boundary_slot_[f] < 0) continue;
    const auto tangents = tangent_basis(problem, f);
    corner_weights.setZero();
    Eigen::Matrix<double, Dim - 1, Dim - 1> edges;  // in tangent coordinates, a column each
    for (int k = 0; k < Dim; ++k) {
      problem.boundary.scatter(problem.boundary.slot[facets(k, f)], corner_weights.col(k));
      if (k == 0) continue;
      edges.col(k - 1) = tangents.transpose() * (problem.mesh.points.col(facets(k, f)) -
                                                 problem.mesh.points.col(facets(0, f)));
    }
    const Eigen::Matrix<double, Eigen::Dynamic, Dim - 1> slopes =
        (corner_weights.template rightCols<Dim - 1>().colwise() - corner_weights.col(0)) *
        edges.inverse();
    for (int t = 0; t < Dim - 1; ++t) {
      for (Index i = 0; i < n_; ++i) {
        boundary_slope_[(static_cast<std::size_t>(boundary_slot_[f]) * (Dim - 1) + t) * stride_ +
                        i] = static_cast<Scalar>(slopes(i, t));
      }
    }
  }
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::set_up_constraints(const LbcProblem<Dim>& problem) {
  const BarycentricConstraints<Dim> constraints(problem.cage.points);
  basis_ = AlignedArray<Scalar>((Dim + 1) * stride_);
  const Eigen::Matrix<double, Dim + 1, Dim> target = constraints.gradient_target();
  for (int k = 0; k <= Dim; ++k) {
    for (Index i = 0; i < n_; ++i) {
      basis_[k * stride_ + i] = static_cast<Scalar>(constraints.basis()(i, k));
    }
    for (int d = 0; d < Dim; ++d) target_[d * (Dim + 1) + k] = static_cast<Scalar>(target(k, d));
  }
}

// phi A / mu: the ball on which the Z-step projects.
template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::set_up_radii(const LbcProblem<Dim>& problem) {
  radius_ = AlignedArray<Scalar>(static_cast<std::size_t>(problem.mesh.num_cells()) * stride_);
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    const double scale = cell_geometry(problem.mesh, s).measure / penalty_;
    for (Index i = 0; i < n_; ++i) {
      radius_[s * stride_ + i] = static_cast<Scalar>(scale * problem.phi(i, s));
    }
  }
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::set_up_periods(const std::vector<Period<Dim>>& periods,
                                               StateStorage* storage) {
  if (!periods.empty()) {
    period_dual_ =
        state_array<Scalar>(storage, StateArray::kPeriodDual, 1, periods.size(), stride_);
  }
  period_values_ = AlignedArray<double>(periods.size() * stride_);
  for (std::size_t p = 0; p < periods.size(); ++p) {
    for (const double number : periods[p].field.reshaped()) {
      period_fields_.push_back(static_cast<Scalar>(number));
    }
    for (Index i = 0; i < n_; ++i) period_values_[p * stride_ + i] = periods[p].values[i];
    period_norms_.push_back(periods[p].norm);
  }
}

// The period constraints' dual step. The field has norm 1, so the dual grows by the violation.
template <class Scalar, int Dim>
double GradientAdmm<Scalar, Dim>::update_periods() {
  double change = 0;
  const Index num_cells = problem_.mesh.num_cells();
  for (std::size_t p = 0; p < num_periods_; ++p) {
    const Scalar* fields = period_fields_.data() + p * num_cells * Dim;
    const Eigen::ArrayXd zero = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(stride_));
    const Eigen::ArrayXd sums = parallel_sum(num_cells, zero, [&](Index begin, Index end) {
      Eigen::ArrayXd sum = zero;
      for (Index row = begin * Dim; row < end * Dim; ++row) {
        const Scalar* gradients = extrapolated_.data() + row * stride_;
        for (std::size_t i = 0; i < stride_; ++i) {
          sum[i] += static_cast<double>(fields[row]) * static_cast<double>(gradients[i]);
        }
      }
      return sum;
    });
    for (std::size_t i = 0; i < stride_; ++i) {
      const double step = period_values_[p * stride_ + i] - sums[i];
      period_dual_[p * stride_ + i] += static_cast<Scalar>(relaxation_ * step);
      change += step * step;
    }
  }
  return change;
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_least_norm() {
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    for (int d = 0; d < Dim; ++d) {
      const std::size_t row = (static_cast<std::size_t>(s) * Dim + d) * stride_;
      for (std::size_t i = 0; i < stride_; ++i) {
        Scalar value = 0;
        for (int k = 0; k <= Dim; ++k)
          value += target_[d * (Dim + 1) + k] * basis_[k * stride_ + i];
        gradient_[row + i] = extrapolated_[row + i] = value;
      }
    }
  }
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_weights(const WeightMatrix& weights) {
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    const auto gradient =
        weight_gradients(problem_.mesh, s, cell_geometry(problem_.mesh, s), weights);
    for (int d = 0; d < Dim; ++d) {
      const std::size_t row = (static_cast<std::size_t>(s) * Dim + d) * stride_;
      for (Index i = 0; i < n_; ++i) {
        gradient_[row + i] = extrapolated_[row + i] = static_cast<Scalar>(gradient(i, d));
      }
    }
  }
}

template <class Scalar, int Dim>
void GradientAdmm<Scalar, Dim>::start_from_duals(const WeightMatrix& weights,
                                                 const VectorsAt<Dim>& flux_density,
                                                 const VectorsAt<Dim>& facet_pull,
                                                 const Eigen::MatrixXd& period_factors) {
  start_from_weights(weights);
  // Rows of an array from those of a matrix, a column each.
  const auto store = [&](AlignedArray<Scalar>& array, Index element, const auto& columns) {
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      const std::size_t row = static_cast<std::size_t>(element * columns.cols() + k) * stride_;
      for (Index i = 0; i < n_; ++i) array[row + i] = static_cast<Scalar>(columns(i, k) / penalty_);
    }
  };
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    store(tv_dual_, s, (-cell_geometry(problem_.mesh, s).measure * flux_density(s)).eval());
  }
#pragma omp parallel for schedule(static)
  for (Index f = 0; f < problem_.topology.num_facets(); ++f) {
    store(facet_dual_, f, (facet_pull(f) * tangent_basis(problem_, f)).eval());
  }
  for (std::size_t p = 0; p < num_periods_; ++p) {
    const auto column = static_cast<Eigen::Index>(p);
    store(period_dual_, static_cast<Index>(p),
          (period_norms_[p] * period_factors.col(column)).eval());
  }
}

template <class Scalar, int Dim>
Eigen::Matrix<double, Eigen::Dynamic, Dim> GradientAdmm<Scalar, Dim>::facet_pull(
    Index facet) const {
  Eigen::Matrix<double, Eigen::Dynamic, Dim - 1> dual(n_, Dim - 1);
  for (int t = 0; t < Dim - 1; ++t) {
    const Scalar* row =
        facet_dual_.data() + (static_cast<std::size_t>(facet) * (Dim - 1) + t) * stride_;
    for (Index i = 0; i < n_; ++i) dual(i, t) = penalty_ * static_cast<double>(row[i]);
  }
  return dual * tangent_basis(problem_, facet).transpose();
}

template <class Scalar, int Dim>
Eigen::MatrixXd GradientAdmm<Scalar, Dim>::period_factors() const {
  Eigen::MatrixXd factors(n_, num_periods_);
  for (std::size_t p = 0; p < num_periods_; ++p) {
    for (Index i = 0; i < n_; ++i) {
      factors(i, static_cast<Eigen::Index>(p)) =
          penalty_ * static_cast<double>(period_dual_[p * stride_ + i]) / period_norms_[p];
    }
  }
  return factors;
}

template <class Scalar, int Dim>
Change GradientAdmm<Scalar, Dim>::iterate() {
  const auto state = arrays();
  const auto over = [&](Index count, auto loop) {
    return parallel_sum(count, Change{},
                        [&](Index begin, Index end) { return loop(state, begin, end); });
  };
  Change change = over(problem_.topology.num_facets(), kernel_.update_facets);
  change.dual += update_periods();
  change += over(problem_.mesh.num_cells(), kernel_.update_cells);
  return change;
}

template <class Scalar, int Dim>
Residuals GradientAdmm<Scalar, Dim>::residuals(const Change& change) const {
  // The paper's duals, stepped with the new G, differ from the ones kept here by G_before - G, and
  // that difference is orthogonal to what the G-step leaves (docs/method.md): Pythagoras.
  const double primal = relaxation_ == 1 ? change.dual - copies_ * change.lead : change.dual;
  return {std::sqrt(std::max(primal, 0.0)), penalty_ * std::sqrt(copies_ * change.gradient)};
}

template <class Scalar, int Dim>
double GradientAdmm<Scalar, Dim>::num_residual_components() const {
  return static_cast<double>(n_) * Dim * copies_ * problem_.mesh.num_cells();
}

template <class Scalar, int Dim>
CellFieldView<Scalar, Dim> GradientAdmm<Scalar, Dim>::flux() {
  using Rows = Eigen::Map<Eigen::Array<Scalar, Dim, Eigen::Dynamic, Eigen::RowMajor>>;
  using ConstRow = Eigen::Map<const Eigen::Array<Scalar, 1, Eigen::Dynamic>>;
  const auto columns = static_cast<Eigen::Index>(stride_);
  flux_ = AlignedArray<Scalar>(tv_dual_.size());
#pragma omp parallel for schedule(static)
  for (Index s = 0; s < problem_.mesh.num_cells(); ++s) {
    const std::size_t block = static_cast<std::size_t>(s) * Dim * stride_;
    Rows flux(flux_.data() + block, Dim, columns);
    flux = Rows(extrapolated_.data() + block, Dim, columns) -
           Rows(tv_dual_.data() + block, Dim, columns);
    const auto length =
        flux.square().colwise().sum().sqrt().max(std::numeric_limits<Scalar>::min());
    const ConstRow radius(radius_.data() + s * stride_, columns);
    const Eigen::Array<Scalar, 1, Eigen::Dynamic> shrink =
        static_cast<Scalar>(penalty_) * (radius / length).min(Scalar(1));
    flux.rowwise() *= shrink;
  }
  return {flux_.data(), stride_, n_};
}

template <class Scalar, int Dim>
double GradientAdmm<Scalar, Dim>::numbers_per_cell() const {
  const std::size_t numbers =
      gradient_.size() + extrapolated_.size() + tv_dual_.size() + facet_dual_.size();
  return static_cast<double>(numbers) / static_cast<double>(stride_) / problem_.mesh.num_cells();
}

template <class Scalar, int Dim>
Arrays<Scalar, Dim> GradientAdmm<Scalar, Dim>::arrays() {
  return {stride_,
          gradient_.data(),
          extrapolated_.data(),
          tv_dual_.data(),
          period_dual_.data(),
          facet_dual_.data(),
          radius_.data(),
          boundary_slope_.data(),
          tangents_.data(),
          problem_.topology.sides.data(),
          boundary_slot_.data(),
          problem_.topology.cell_facets.data(),
          period_fields_.data(),
          num_periods_,
          static_cast<std::size_t>(problem_.mesh.num_cells()),
          static_cast<Scalar>(1 / copies_),
          basis_.data(),
          target_,
          static_cast<Scalar>(relaxation_)};
}

template class GradientAdmm<float, 2>;
template class GradientAdmm<float, 3>;
template class GradientAdmm<double, 2>;
template class GradientAdmm<double, 3>;

}  // namespace flbc::gradient
