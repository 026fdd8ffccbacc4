// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Computes local barycentric coordinates from a cage and a domain mesh: solve() for a single
//! solve, Solver for repeated solves.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "flbc/report.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Coordinates at the vertices of the domain mesh.
struct Solution {
  SparseWeights weights{};  //!< of V points; weights.dense() is the n x V matrix
  SolveReport report{};     //!< report of the run
};

//! Computes the coordinates of a cage.
//!
//! If the mesh was made by refine() (nested_mesh.h), as those of the meshers, method kWeights
//! starts from weights and duals of its coarse mesh, which is solved first. Distances may also come
//! from there (SolverOptions::distances). The result is the same up to the tolerance. The report
//! describes the given mesh and names the coarse one.
//!
//! If the cage has several parts, each is solved independently, and the result is bit-identical to
//! solving that part alone. Weights are exactly 0 for control points of other parts. Penalties
//! refer to the size of the part, and Progress::finer_levels counts the remaining parts.
//! \param cage  n control points
//! \param mesh  domain mesh of the cage, V vertices (see normalize_and_validate)
//! \param observer  receives progress and may stop the run
//! \return weights and report; if the solve does not converge, the report has the status
//! \throws InputError if the mesh does not match the cage; OptionError, SolverError
template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const SolverOptions& options = {}, const Observer& observer = {});

//! The same with known facets, for example from a half-edge mesh.
//! \param topology  of the mesh; ignored if the cage has several parts
template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const MeshTopology<Dim>& topology, const SolverOptions& options,
               const Observer& observer = {});

//! Solves a problem from make_problem(). Several solves with different options may share it.
//! Parameters and errors are as above.
//! \param problem  made with options.phi, and with options.smoothness if that is set
template <int Dim>
Solution solve(LbcProblem<Dim> problem, const SolverOptions& options = {},
               const Observer& observer = {});

//! Whether a solve of this size uses an active set (SolverOptions::active_set) if the supports of
//! the weights are small enough. It then takes much less memory.
//! \param dim  2 or 3
bool tries_active_set(int dim, Index control_points, Index vertices,
                      const SolverOptions& options = {});

namespace internal {
template <int Dim>
struct SolverState;
}

//! Keeps a problem and the state of its iteration, so each solve resumes from the last one. Use it
//! to change the tolerance, to run a few iterations at a time, or to change the rest cage.
//!
//! When control points move, mesh vertices follow by their weights: x' = C' w. These weights are
//! the coordinates of the first rest cage at its first move. Vertex positions therefore depend only
//! on the control points, not on the path or on the accuracy of solves in between. If a cell would
//! be inverted, vertices follow by the coordinates of the current rest cage, then and from then on.
//! Vertices on the cage stay on it. Self-intersections of the cage that do not invert a cell are
//! not detected.
template <int Dim>
class Solver {
 public:
  //! Sets up the problem.
  //! \param cage  n control points, with a connected interior
  //! \param mesh  domain mesh of the cage, V vertices (see normalize_and_validate)
  //! \param options  of all solves until set_options()
  //! \param observer  of the setup
  //! \throws InputError if the mesh does not match the cage; OptionError
  Solver(Cage<Dim> cage, DomainMesh<Dim> mesh, const SolverOptions& options = {},
         const Observer& observer = {});
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  //! Solves. The first result is bit-identical to flbc::solve(); later calls resume from the last
  //! state, and make the iterations that an uninterrupted run makes, bit for bit.
  //! \param budget  of this solve
  //! \return the solution, valid until the next solve. Its report covers only this solve; the
  //! status is kIterationLimit if the budget ended it
  //! \throws OptionError, SolverError; then the solution is unchanged, and the next solve starts
  //! over
  const Solution& solve(const Budget& budget = {}, const Observer& observer = {});

  //! The masks of the vertices of a moved mesh.
  using MasksIn =
      std::function<std::vector<Mask>(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh)>;

  //! Changes the rest cage: moves the control points and the mesh, and solves. kWeights starts from
  //! the duals of the previous rest cage, other methods start over. If the current rest cage has no
  //! solution, it is solved first. An exception leaves the object unchanged.
  //! \param control_points  Dim x n, in the units of the cage
  //! \param masks_in  returns SolverOptions::masks of the moved mesh; null: as before
  //! \throws InputError if their number differs, one is not finite, the cage becomes defective,
  //! masks cannot be obeyed, or a cell would be inverted, naming the cell and its location;
  //! OptionError for an invalid budget; SolverError
  const Solution& reshape(const PointList<Dim>& control_points, const Budget& budget = {},
                          const Observer& observer = {}, const MasksIn& masks_in = {});

  //! Changes the options of the following solves. The next solve resumes from the last state if
  //! only tolerance, gap, max_iterations, certify, or threads differ and distances are accurate
  //! enough. With other masks it starts from the duals of the last state and from the supports of
  //! the coarse mesh. With another reach or falloff it starts over, without a new setup. Otherwise
  //! the problem is set up again, as by a new Solver.
  //! \throws OptionError, SolverError; InputError for masks without weights; then options are
  //! unchanged
  void set_options(const SolverOptions& options);

  //! Makes the next solve start over.
  void restart();

  //! The current options, as given.
  const SolverOptions& options() const;

  //! The current cage and mesh.
  const Cage<Dim>& cage() const;
  const DomainMesh<Dim>& mesh() const;

  //! The current problem.
  const LbcProblem<Dim>& problem() const;

  //! The solution of the last solve; without weights before the first.
  const Solution& solution() const;

 private:
  std::unique_ptr<internal::SolverState<Dim>> state_;
};

}  // namespace flbc
