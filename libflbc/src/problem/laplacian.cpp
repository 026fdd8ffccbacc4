// SPDX-License-Identifier: BSD-3-Clause
#include "problem/laplacian.h"

#include <numeric>

#include "base/parallel.h"
#include "mesh/cell_geometry.h"
#include "mesh/vertex_cells.h"

namespace flbc {

template <int Dim>
RowMatrix stiffness_matrix(const DomainMesh<Dim>& mesh, const Eigen::VectorXd& cell_factors,
                           const std::vector<Index>& vertices) {
  using Local = Eigen::Matrix<double, Dim + 1, Dim + 1>;
  std::vector<Local> locals(mesh.num_cells());
  parallel_for(mesh.num_cells(), [&](Index s) {
    const auto hat = cell_geometry(mesh, s).hat_gradients;
    locals[s] = cell_factors[s] * (hat.transpose() * hat);
  });
  constexpr Index kNone = -1;
  std::vector<Index> place(mesh.num_vertices(), kNone);
  for (std::size_t row = 0; row < vertices.size(); ++row) {
    place[vertices[row]] = static_cast<Index>(row);
  }
  const VertexCells around(mesh);
  const auto size = static_cast<Index>(vertices.size());
  return assemble_rows(size, size, [&](Index row, const auto& add) {
    const Index vertex = vertices[row];
    for (const Index s : around.cells_of(vertex)) {
      int own = 0;
      while (mesh.cells(own, s) != vertex) ++own;
      for (int k = 0; k <= Dim; ++k) {
        const Index column = place[mesh.cells(k, s)];
        if (column != kNone) add(column, locals[s](own, k));
      }
    }
  });
}

template <int Dim>
RowMatrix stiffness_matrix(const DomainMesh<Dim>& mesh) {
  std::vector<Index> all(mesh.num_vertices());
  std::iota(all.begin(), all.end(), 0);
  return stiffness_matrix(mesh, cell_measures(mesh), all);
}

template <int Dim>
Eigen::VectorXd lumped_mass(const DomainMesh<Dim>& mesh) {
  const Eigen::VectorXd shares = cell_measures(mesh) / (Dim + 1);
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(mesh.num_vertices());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int k = 0; k <= Dim; ++k) mass[mesh.cells(k, s)] += shares[s];
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
                                        const BoundaryValues<Dim>& boundary, LinearSolver solver)
    : interior_(boundary.interior_vertices()), boundary_(boundary.vertices) {
  std::vector<Index> place = boundary.boundary_index;  // index among the interior or boundary
                                                       // vertices
  for (std::size_t i = 0; i < interior_.size(); ++i) place[interior_[i]] = static_cast<Index>(i);

  const auto stiffness = stiffness_matrix(mesh);
  const auto part = [&](const std::vector<Index>& columns, bool inside) {
    return assemble_rows(static_cast<Index>(interior_.size()), static_cast<Index>(columns.size()),
                         [&](Index row, const auto& add) {
                           for (RowMatrix::InnerIterator it(stiffness, interior_[row]); it; ++it) {
                             const auto w = static_cast<Index>(it.col());
                             if (boundary.is_interior(w) == inside) add(place[w], it.value());
                           }
                         });
  };
  const RowMatrix matrix = part(interior_, true);
  coupling_ = part(boundary_, false);
  if (solver == LinearSolver::kDirect) {
    interior_solver_.emplace(std::in_place_type<PanelCholesky<double>>, matrix);
  } else {
    interior_solver_.emplace(std::in_place_type<MultigridCg>, matrix);
  }
}

template <int Dim>
WeightMatrix DirichletProblem<Dim>::solve(const Eigen::MatrixXd& boundary_values,
                                          const Eigen::MatrixXd& divergence) const {
  const Eigen::Index k = boundary_values.rows();
  const std::size_t stride = padded(k);
  AlignedArray<double> rows(interior_.size() * stride);
  const auto& position = std::visit(
      [](const auto& solver) -> auto& { return solver.position(); }, *interior_solver_);
  const auto row_of = [&](std::size_t i) {
    return Eigen::Map<Eigen::VectorXd>(rows.data() + position[i] * stride, k);
  };

  parallel_for(interior_.size(), [&](std::size_t i) {
    auto row = row_of(i);
    if (divergence.size() > 0) row = divergence.col(interior_[i]);
    for (typename decltype(coupling_)::InnerIterator it(coupling_, i); it; ++it) {
      row -= it.value() * boundary_values.col(it.col());
    }
  });
  std::visit([&](const auto& solver) { solver.solve(rows.data(), stride); }, *interior_solver_);

  WeightMatrix weights(k, interior_.size() + boundary_.size());
  for (std::size_t b = 0; b < boundary_.size(); ++b) {
    weights.col(boundary_[b]) = boundary_values.col(b);
  }
  for (std::size_t i = 0; i < interior_.size(); ++i) weights.col(interior_[i]) = row_of(i);
  return weights;
}

#define FLBC_INSTANTIATE(Dim)                                                         \
  template RowMatrix stiffness_matrix(const DomainMesh<Dim>&, const Eigen::VectorXd&, \
                                      const std::vector<Index>&);                     \
  template RowMatrix stiffness_matrix(const DomainMesh<Dim>&);                        \
  template Eigen::VectorXd lumped_mass(const DomainMesh<Dim>&);                       \
  template Eigen::MatrixXd boundary_matrix(const BoundaryValues<Dim>&, Index);        \
  template class DirichletProblem<Dim>;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
