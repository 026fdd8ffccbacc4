// SPDX-License-Identifier: BSD-3-Clause
#include "problem/laplacian.h"

#include "mesh/cell_geometry.h"

namespace flbc {

template <int Dim>
Eigen::SparseMatrix<double> stiffness_matrix(const DomainMesh<Dim>& mesh) {
  std::vector<Eigen::Triplet<double, Index>> entries;
  entries.reserve((Dim + 1) * (Dim + 1) * static_cast<std::size_t>(mesh.num_cells()));
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    const auto geometry = cell_geometry(mesh, s);
    const Eigen::Matrix<double, Dim + 1, Dim + 1> local =
        geometry.measure * geometry.hat_gradients.transpose() * geometry.hat_gradients;
    for (int a = 0; a <= Dim; ++a) {
      for (int b = 0; b <= Dim; ++b) {
        entries.emplace_back(mesh.cells(a, s), mesh.cells(b, s), local(a, b));
      }
    }
  }
  Eigen::SparseMatrix<double> stiffness(mesh.num_vertices(), mesh.num_vertices());
  stiffness.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

template <int Dim>
Eigen::VectorXd lumped_mass(const DomainMesh<Dim>& mesh) {
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(mesh.num_vertices());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    const double share = cell_geometry(mesh, s).measure / (Dim + 1);
    for (int k = 0; k <= Dim; ++k) mass[mesh.cells(k, s)] += share;
  }
  return mass;
}

template <int Dim>
Eigen::MatrixXd boundary_matrix(const BoundaryValues<Dim>& boundary, Index n) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(n, boundary.vertices.size());
  for (Eigen::Index b = 0; b < values.cols(); ++b) {
    boundary.scatter(static_cast<Index>(b), values.col(b));
  }
  return values;
}

template <int Dim>
DirichletProblem<Dim>::DirichletProblem(const DomainMesh<Dim>& mesh,
                                        const BoundaryValues<Dim>& boundary,
                                        LinearSolver solver)
    : interior_(boundary.interior_vertices()), boundary_(boundary.vertices) {
  std::vector<Index> place = boundary.boundary_index;  // among the interior or boundary vertices
  for (std::size_t i = 0; i < interior_.size(); ++i) place[interior_[i]] = static_cast<Index>(i);

  using Triplet = Eigen::Triplet<double, Index>;
  std::vector<Triplet> inner;  // lower triangle
  std::vector<Triplet> outer;
  const auto stiffness = stiffness_matrix(mesh);
  for (const Index v : interior_) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(stiffness, v); it; ++it) {
      const auto w = static_cast<Index>(it.row());
      if (!boundary.is_interior(w)) {
        outer.emplace_back(place[v], place[w], it.value());
      } else if (w >= v) {
        inner.emplace_back(place[w], place[v], it.value());
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(interior_.size(), interior_.size());
  matrix.setFromTriplets(inner.begin(), inner.end());
  coupling_.resize(interior_.size(), boundary_.size());
  coupling_.setFromTriplets(outer.begin(), outer.end());
  if (solver == LinearSolver::kDirect) {
    interior_solver_.emplace(PanelCholesky<double>(matrix));
  } else {
    interior_solver_.emplace(MultigridCg(matrix));
  }
}

template <int Dim>
WeightMatrix DirichletProblem<Dim>::solve(const Eigen::MatrixXd& boundary_values,
                                          const Eigen::MatrixXd& divergence) const {
  const Eigen::Index k = boundary_values.rows();
  const std::size_t stride = padded(k);
  AlignedArray<double> rows(interior_.size() * stride);
  const auto& position =
      std::visit([](const auto& solver) -> auto& { return solver.position(); }, *interior_solver_);
  const auto row_of = [&](std::size_t i) {
    return Eigen::Map<Eigen::VectorXd>(rows.data() + position[i] * stride, k);
  };

#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < interior_.size(); ++i) {
    auto row = row_of(i);
    if (divergence.size() > 0) row = divergence.col(interior_[i]);
    for (typename decltype(coupling_)::InnerIterator it(coupling_, i); it; ++it) {
      row -= it.value() * boundary_values.col(it.col());
    }
  }
  std::visit([&](const auto& solver) { solver.solve(rows.data(), stride); }, *interior_solver_);

  WeightMatrix weights(k, interior_.size() + boundary_.size());
  for (std::size_t b = 0; b < boundary_.size(); ++b) {
    weights.col(boundary_[b]) = boundary_values.col(b);
  }
  for (std::size_t i = 0; i < interior_.size(); ++i) weights.col(interior_[i]) = row_of(i);
  return weights;
}

#define FLBC_INSTANTIATE(Dim)                                                    \
  template Eigen::SparseMatrix<double> stiffness_matrix(const DomainMesh<Dim>&); \
  template Eigen::VectorXd lumped_mass(const DomainMesh<Dim>&);                  \
  template Eigen::MatrixXd boundary_matrix(const BoundaryValues<Dim>&, Index);   \
  template class DirichletProblem<Dim>;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
