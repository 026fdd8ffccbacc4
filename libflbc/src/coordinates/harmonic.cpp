// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/harmonic.h"

#include <algorithm>
#include <atomic>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "coordinates/poisson_weights.h"
#include "flbc/errors.h"
#include "problem/laplacian.h"

namespace flbc {
namespace {

// Functions that one thread minimizes together.
constexpr Index kColumns = 16;

// Penalties of ADMM relative to the mass matrix, for a cage of size 1. Each suits a range of
// eigenvalues. Cycling through all of them needs a few hundred steps, and the best single one
// thousands.
constexpr double kPenalties[] = {1e5, 1e6, 1e7, 1e8, 1e9};
constexpr int kStepsPerPenalty = 10;
constexpr int kMostCycles = 100;
constexpr double kChangePerCycle = 1e-4;
constexpr double kRelaxation = 1.6;

// The energy on the interior vertices, minimized in the box [0, 1] by ADMM: w minimizes the energy
// plus penalty / 2 |w - z + u|^2, z clips w + u, and the scaled duals u sum up w - z.
template <int Dim>
class BoxedEnergy {
 public:
  explicit BoxedEnergy(const LbcProblem<Dim>& problem)
      : boundary_(problem.boundary),
        interior_(boundary_.interior_vertices()),
        stiffness_(stiffness_matrix(problem.mesh)),
        mass_(lumped_mass(problem.mesh)),
        coupling_(energy_matrix(boundary_.vertices)) {
    const Eigen::SparseMatrix<double> energy = energy_matrix(interior_);
    for (const double penalty : kPenalties) {
      Eigen::SparseMatrix<double> matrix = energy;
      matrix.diagonal() += penalty * mass_(interior_);
      factors_.emplace_back(matrix);
    }
  }

  // The functions first, first + 1, ..., at most kColumns. \return whether they converged
  bool minimize(Index first, WeightMatrix& weights) const {
    const auto size = static_cast<Eigen::Index>(interior_.size());
    State state(size, forces(first));
    Panel before(size, kColumns);
    bool converged = false;
    for (int cycle = 0; cycle < kMostCycles && !converged; ++cycle) {
      before = state.clipped;
      for (std::size_t k = 0; k < factors_.size(); ++k) {
        if (cycle > 0 || k > 0) {
          state.duals *= kPenalties[k > 0 ? k - 1 : factors_.size() - 1] / kPenalties[k];
        }
        for (int step = 0; step < kStepsPerPenalty; ++step) take_step(k, state);
      }
      converged = size == 0 || (state.clipped - before).abs().maxCoeff() <= kChangePerCycle;
    }
    const auto count = std::min<Eigen::Index>(kColumns, weights.rows() - first);
    for (Eigen::Index v = 0; v < size; ++v) {
      weights.col(interior_[v]).segment(first, count) = state.clipped.row(row_of(v)).head(count);
    }
    return converged;
  }

 private:
  using Panel = Eigen::Array<double, Eigen::Dynamic, kColumns, Eigen::RowMajor>;

  // Rows are in the order of the factors.
  struct State {
    State(Eigen::Index size, Panel given)
        : forces(std::move(given)),
          clipped(Panel::Zero(size, kColumns)),
          duals(clipped),
          solution(size * kColumns) {}
    Panel forces;   // of the boundary values
    Panel clipped;  // z
    Panel duals;    // u
    AlignedArray<double> solution;
  };

  // Part of L M^-1 L: rows of the interior vertices, and the given columns.
  RowMatrix energy_matrix(const std::vector<Index>& columns) const {
    std::vector<Index> place(static_cast<std::size_t>(mass_.size()), -1);
    for (std::size_t k = 0; k < columns.size(); ++k) place[columns[k]] = static_cast<Index>(k);
    const auto row_entries = [&](Index row, const auto& add) {
      for (RowMatrix::InnerIterator a(stiffness_, interior_[row]); a; ++a) {
        for (RowMatrix::InnerIterator b(stiffness_, a.col()); b; ++b) {
          if (place[b.col()] >= 0) add(place[b.col()], a.value() * b.value() / mass_[a.col()]);
        }
      }
    };
    return assemble_rows(static_cast<Index>(interior_.size()), static_cast<Index>(columns.size()),
                         row_entries);
  }

  // The factors have the same order, because their matrices have the same pattern.
  Index row_of(Eigen::Index interior_vertex) const {
    return factors_[0].position()[interior_vertex];
  }

  Panel forces(Index first) const {
    Panel forces = Panel::Zero(coupling_.rows(), kColumns);
    for (Eigen::Index v = 0; v < coupling_.rows(); ++v) {
      for (RowMatrix::InnerIterator it(coupling_, v); it; ++it) {
        for (int k = 0; k < Dim; ++k) {
          const Index column = boundary_.control_points(k, it.col()) - first;
          if (column < 0 || column >= kColumns) continue;
          forces(row_of(v), column) -= it.value() * boundary_.values(k, it.col());
        }
      }
    }
    return forces;
  }

  void take_step(std::size_t k, State& state) const {
    const auto size = static_cast<Eigen::Index>(interior_.size());
    Eigen::Map<Panel> solution(state.solution.data(), size, kColumns);
    for (Eigen::Index v = 0; v < size; ++v) {
      const Index r = row_of(v);
      solution.row(r) = state.forces.row(r) + kPenalties[k] * mass_[interior_[v]] *
                                                  (state.clipped.row(r) - state.duals.row(r));
    }
    factors_[k].solve_slice(state.solution.data(), kColumns, 0, kColumns);
    state.duals += kRelaxation * solution + (1 - kRelaxation) * state.clipped;
    state.clipped = state.duals.max(0).min(1);
    state.duals -= state.clipped;
  }

  const BoundaryValues<Dim>& boundary_;
  std::vector<Index> interior_;
  RowMatrix stiffness_;   // L, all vertices
  Eigen::VectorXd mass_;  // M
  RowMatrix coupling_;
  std::vector<PanelCholesky<double>> factors_;
};

}  // namespace

template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem,
                                  const DirichletProblem<Dim>& poisson) {
  auto weights = poisson.solve(boundary_matrix(problem.boundary, problem.num_control_points()));
  project_interior(problem, weights);
  return weights;
}

template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem) {
  return harmonic_coordinates(problem, DirichletProblem<Dim>(problem.mesh, problem.boundary));
}

template <int Dim>
WeightMatrix bounded_biharmonic_weights(const LbcProblem<Dim>& problem) {
  const Index n = problem.num_control_points();
  WeightMatrix weights = WeightMatrix::Zero(n, problem.mesh.num_vertices());
  problem.boundary.impose_on(weights);
  const BoxedEnergy<Dim> energy(problem);
  std::atomic<bool> converged{true};
  parallel_for_chunks((n + kColumns - 1) / kColumns, 1, [&](Index block) {
    if (!energy.minimize(block * kColumns, weights)) converged = false;
  });
  if (!converged) {
    throw SolverError("bounded biharmonic weights did not converge in " +
                      std::to_string(kMostCycles * kStepsPerPenalty * std::size(kPenalties)) +
                      " steps; make a domain mesh with cells of better shape");
  }
  const Eigen::RowVectorXd sums = weights.colwise().sum();
  weights.array().rowwise() /= sums.array();
  return weights;
}

#define FLBC_INSTANTIATE(Dim)                                               \
  template WeightMatrix bounded_biharmonic_weights(const LbcProblem<Dim>&); \
  template WeightMatrix harmonic_coordinates(const LbcProblem<Dim>&);       \
  template WeightMatrix harmonic_coordinates(const LbcProblem<Dim>&, const DirichletProblem<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
