// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a cage and a mesh to local barycentric coordinates: solve() once, Solver again and again.
#pragma once

#include <memory>
#include <type_traits>

#include "flbc/coarse_to_fine.h"
#include "flbc/lbc_problem.h"
#include "flbc/observer.h"
#include "flbc/options.h"
#include "flbc/report.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Coordinates at the vertices of the domain mesh.
struct Solution {
  WeightMatrix weights;            //!< n x V; empty if SolverOptions::sparse
  SparseWeights sparse_weights{};  //!< the same for V points if SolverOptions::sparse, else none
  SolveReport report{};            //!< how it went
};

//! A mesher as an argument: any callable that a CoarseMesher can be made of, or {} for none.
template <int Dim>
using MesherArgument = std::common_type_t<CoarseMesher<Dim>>;

//! Solves for the coordinates of a cage.
//!
//! With a mesher, method kValue starts from weights and duals of a coarser mesh of the cage, which
//! is solved in the same way, where options.coarse_to_fine and coarse_levels say so: by default
//! where it was measured to pay. Distances may come from there, too (SolverOptions::distances). The
//! result is the same up to the tolerance. A coarse mesh is left out if the mesher throws (the cage
//! may be too fine for so few vertices) or does not make a clearly smaller mesh. The report is that
//! of the given mesh and lists the coarser ones; their seconds, meshing included, count as part of
//! the solve, and the observer is called on all of them.
//!
//! If the cage's interior has several connected parts, each is solved on its own and is
//! bit-identical to solving it alone: a point has weights for the control points of its own part,
//! and exactly 0 for all others. Penalties refer to the size of the part, and
//! Progress::finer_levels counts the parts that are still to come.
//! \param cage  n control points
//! \param mesh  V vertices, a mesh of the cage's interior (see normalize_and_validate)
//! \param mesher  makes the coarser meshes; {} for none
//! \param observer  is told of the progress, and may stop the run
//! \return the weights and how it went; not converging is a status in the report
//! \throws InputError if mesh and cage do not belong together, or a coarse mesh does not belong to
//! the cage; OptionError, SolverError
template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const SolverOptions& options = {}, const MesherArgument<Dim>& mesher = {},
               const Observer& observer = {});

//! The same where the mesh's facets are known already, as a half-edge mesh knows them.
//! \param topology  of the mesh; with several parts, facets are enumerated anew
template <int Dim>
Solution solve(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
               const MeshTopology<Dim>& topology, const SolverOptions& options,
               const MesherArgument<Dim>& mesher, const Observer& observer = {});

//! Solves a problem that make_problem() has set up; several solves with different options may share
//! it. Parameters and errors as above.
//! \param problem  made with options.phi; kHarmonic and kMeanValue need no phi
template <int Dim>
Solution solve(const LbcProblem<Dim>& problem, const SolverOptions& options = {},
               const MesherArgument<Dim>& mesher = {}, const Observer& observer = {});

//! How much one solve may cost, so that a user who drags a control point gets a result per frame.
//! At least one iteration is made.
struct Budget {
  int iterations = 0;  //!< largest number, >= 1; 0 = as options say
  double seconds = 0;  //!< no iteration begins later, setup included; 0 = no limit. Results then
                       //!< depend on how fast the machine is.
};

//! Keeps a problem and its iteration: to solve to another tolerance, some iterations at a time, or
//! for another rest shape of the cage, always from where the last solve ended.
//!
//! When control points move, the mesh follows by weights of its own: x' = C' w. These are the
//! coordinates of the first shape when it first moves, or of the one that anchor() chose. Where vertices go then
//! depends on where the control points are, and not on how they came there or how exactly the
//! shapes in between were solved; vertices on the cage stay on it. Facets of the cage that pass
//! through each other without turning a cell over are not noticed.
template <int Dim>
class Solver {
 public:
  //! Sets the problem up.
  //! \param cage  n control points, whose interior is connected
  //! \param mesh  V vertices, a mesh of the cage's interior (see normalize_and_validate)
  //! \param options  of all solves until set_options(); its solutions are never sparse
  //! \param mesher  makes coarser meshes to start from; one of them then moves along, and distances
  //! come from there where SolverOptions::distances allow. {} for none
  //! \throws InputError if mesh and cage do not belong together; OptionError
  Solver(Cage<Dim> cage, DomainMesh<Dim> mesh, const SolverOptions& options = {},
         const MesherArgument<Dim>& mesher = {});
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  //! Solves; bit-identical to solve() the first time, afterwards from the last state. A run in
  //! parts is bit-identical to one in one piece if options give the penalty. Methods that do not
  //! iterate start afresh.
  //! \param budget  of this solve
  //! \return the solution, which stays until the next solve; its report is of this solve alone, with
  //! status kIterationLimit where the budget ended it
  //! \throws OptionError, SolverError; the solution is then as it was, and the next solve starts
  //! afresh
  const Solution& solve(const Budget& budget = {}, const Observer& observer = {});

  //! Moves the control points there, the mesh with them, and solves. kValue starts from the duals
  //! of the shape before, other methods afresh. Solves for the present shape first if that has no
  //! solution. After any exception everything is as it was.
  //! \param control_points  Dim x n, in the units of the cage
  //! \throws InputError if their number differs, one is not finite, the cage becomes defective, or
  //! a cell would turn over, naming the cell and its place; OptionError for an impossible budget;
  //! SolverError
  const Solution& move(const PointList<Dim>& control_points, const Budget& budget = {},
                       const Observer& observer = {});

  //! From now on the mesh follows by the present coordinates, from the present shape. For edits so
  //! large that cells would turn over on the direct way; the mesh of a cage that is moved back is
  //! then no longer exactly what it was.
  void anchor();

  //! Changes the options from the next solve on. It continues from the last state unless method,
  //! precision, non_negative, linear_solver, penalty or active_set differ.
  //! \param options  with the phi of the problem
  //! \throws OptionError; options are then as they were
  void set_options(const SolverOptions& options);

  //! The next solve starts afresh.
  void restart();

  //! As given.
  const SolverOptions& options() const;

  //! As they are now.
  const Cage<Dim>& cage() const;
  const DomainMesh<Dim>& mesh() const;

  //! The problem that is solved; without phi until a method that minimizes has solved it.
  const LbcProblem<Dim>& problem() const;

  //! Of the last solve; without weights before the first.
  const Solution& solution() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace flbc
