// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a problem to local barycentric coordinates: solve() once, LbcSolver again and again.
#pragma once

#include <memory>
#include <type_traits>

#include "flbc/coarse_to_fine.h"
#include "flbc/lbc_problem.h"
#include "flbc/options.h"
#include "flbc/report.h"
#include "flbc/solver_state.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Coordinates at the vertices of the domain mesh.
struct Solution {
  WeightMatrix weights;  //!< n x V
  SolveReport report;    //!< how it went
};

//! The same without the zeros of the weights, for many control points.
struct SparseSolution {
  SparseWeights weights;  //!< of V points
  SolveReport report;     //!< how it went
};

//! A mesher as an argument: any callable that a CoarseMesher can be made of, or {} for none.
template <int Dim>
using MesherArgument = std::common_type_t<CoarseMesher<Dim>>;

//! Solves a problem; several calls with different options may share it.
//!
//! Methods kValue, kGradient and kLbc2014 start from weights and duals of a coarser mesh of the
//! cage, which is solved in the same way, where there is a mesher and options.coarse_to_fine and
//! coarse_levels say so: by default, where it was measured to pay. The result is the same up to the
//! tolerance. A coarse mesh is left out if the mesher throws (the cage may be too fine for so few
//! vertices) or does not make a clearly smaller mesh. The report is that of the given mesh and
//! lists the coarser ones besides; their seconds, meshing included, count as part of the solve, and
//! options.progress is called on all of them.
//! \param problem  made with options.phi; kHarmonic and kMeanValue need no phi
//! \param mesher  makes the coarser meshes; empty for none
//! \param storage  where the iteration's state lives, to be kept or to go on from, in which case no
//! coarser meshes are used; null for memory that is freed at the end
//! \return n x V weights and how it went; not converging is a status in the report
//! \throws OptionError, SolverError; InputError if a coarse mesh does not belong to the cage, or
//! phi is missing
template <int Dim>
Solution solve(const LbcProblem<Dim>& problem, const SolverOptions& options = {},
               const MesherArgument<Dim>& mesher = {}, StateStorage* storage = nullptr);

//! One call from cage and mesh to coordinates. With a mesher, distances may come from a coarser
//! mesh (SolverOptions::distances); where none can be made they are exact.
//!
//! Where the cage's interior has several parts (cage_parts(), mesh_in_parts()), each is solved by
//! itself, to the same bits as alone: a point has weights for the control points of its own part,
//! and exactly 0 for all others. Penalties refer to the size of the part, and
//! Progress::finer_levels counts the parts that are still to come.
//! \param cage  n control points
//! \param mesh  V vertices, a mesh of the cage's interior (see normalize_and_validate)
//! \param mesher  as above
//! \return as above
//! \throws InputError if mesh and cage do not belong together; OptionError, SolverError
template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const SolverOptions& options = {}, const MesherArgument<Dim>& mesher = {});

//! The same where the mesh's facets are known already, as a halfedge mesh knows them.
//! \param topology  of the mesh; with several parts, facets are enumerated anew
template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const MeshTopology<Dim>& topology, const SolverOptions& options,
               const MesherArgument<Dim>& mesher);

//! The same weights without their zeros. Where the iteration works on supports
//! (SolverOptions::active_pairs) no n x V matrix of weights is made. Parameters, errors as above.
template <int Dim>
SparseSolution solve_sparse(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                            const SolverOptions& options = {},
                            const MesherArgument<Dim>& mesher = {});

//! A problem that is solved again and again, each time from where the last solve ended: with a
//! smaller tolerance, or some iterations at a time. The first solve gives what solve() gives, to
//! the bit.
template <int Dim>
class LbcSolver {
 public:
  //! Sets the problem up.
  //! \param cage  n control points
  //! \param mesh  V vertices, a mesh of the cage's interior (see normalize_and_validate)
  //! \param options  of all solves until set_options()
  //! \param mesher  makes coarser meshes to start from; empty for none
  //! \throws InputError if mesh and cage do not belong together; OptionError
  LbcSolver(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh, const SolverOptions& options = {},
            const CoarseMesher<Dim>& mesher = {});
  ~LbcSolver();
  LbcSolver(LbcSolver&&) noexcept;
  LbcSolver& operator=(LbcSolver&&) noexcept;

  //! Solves, from the last state if there is one. A run in parts is the same as one in one piece,
  //! to the bit, if options give the penalty and kSingle or kDouble as precision, and not on
  //! supports (SolverOptions::active_pairs); a penalty chosen from the mesh stays as the first
  //! solve left it. Methods that do not iterate start afresh.
  //! \return the solution, which stays until the next solve; its report is of this solve alone
  //! \throws OptionError, SolverError; the solution is then as it was, and the next solve starts
  //! afresh
  const Solution& solve();

  //! Changes the options from the next solve on. It goes on from the last state unless method,
  //! precision, non_negative, linear_solver, penalty or active_pairs are others than before.
  //! \param options  with the phi of the problem
  //! \throws OptionError; options are then as they were
  void set_options(const SolverOptions& options);

  //! The next solve starts afresh.
  void restart();

  //! As given.
  const SolverOptions& options() const;

  //! The problem that is solved; without phi until a method that minimises has solved it.
  const LbcProblem<Dim>& problem() const;

  //! Of the last solve; without weights before the first.
  const Solution& solution() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace flbc
