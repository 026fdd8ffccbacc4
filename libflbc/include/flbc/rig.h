// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A model in a cage whose rest shape may change.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flbc/binding.h"
#include "flbc/mirror.h"
#include "flbc/place_masks.h"
#include "flbc/solver.h"

namespace flbc {

//! From a cage to weights of a model, for programs that change parts of it: a new pose needs
//! nothing, a new model only weights_of_points(), and a new rest cage, tolerance, or smoothness a
//! solve that starts from the state before.
//!
//! BindOptions::observer receives the progress of all steps. If it, or bad input, ends a function
//! by an exception, the Rig is as before, except that the next solve() may start over.
template <int Dim>
class Rig {
 public:
  //! Meshes the interior of the cage.
  //! \param cage  n control points
  //! \param points  Dim x P of the model, in the units of the cage
  //! \param edges  of the model, along which the reduction leaves no seams; may be empty
  //! \param meshers  such as linked_meshers<Dim>()
  //! \throws InputError naming the defect of cage or model; OptionError
  Rig(Cage<Dim> cage, PointList<Dim> points, EdgeList edges, const BindOptions& options,
      const Meshers<Dim>& meshers);

  //! With a given domain mesh of V vertices, see normalize_and_validate().
  Rig(Cage<Dim> cage, DomainMesh<Dim> domain, PointList<Dim> points, EdgeList edges,
      const BindOptions& options);

  //! With a domain mesh from make_domain(), or another one that is valid.
  //! \param points  as above; none: the vertices of the mesh, with the edges of its cells
  Rig(Cage<Dim> cage, MadeDomain<Dim> domain, PointList<Dim> points, EdgeList edges,
      const BindOptions& options);

  //! Without a domain mesh, for BindOptions::coordinates that are pointwise (pointwise.h).
  Rig(Cage<Dim> cage, PointList<Dim> points, EdgeList edges, const BindOptions& options);

  //! Solves, or resumes the last solve. A converged solution of set_solution() is kept. A budget
  //! does not limit other coordinates, given phi, and cages with several parts.
  //! \throws OptionError, SolverError
  const Solution& solve(const Budget& budget = {});

  //! Takes a solution of this cage and mesh from elsewhere. If its report says that it is
  //! converged, it is kept until options or the cage change; otherwise the next solve starts over.
  //! \throws InputError if it is not for V vertices and n control points
  void set_solution(Solution solution);

  //! Moves the rest cage, and the mesh with it, and solves, see Solver::reshape(). The mesh follows
  //! the solution, which may be a given one. The model stays, and its masks with it.
  //! \param control_points  Dim x n
  //! \throws InputError if the model would be outside (OutsidePoints::kFail), masks could not be
  //! obeyed, the cage would not be symmetric (mirror_axis), the cage has several parts, or as
  //! Solver::reshape(); then nothing has changed
  const Solution& reshape(const PointList<Dim>& control_points, const Budget& budget = {});

  //! \throws InputError if the model is outside
  void set_model(PointList<Dim> points, EdgeList edges);

  //! Changes options, except for the number of vertices of the mesh. See Solver::set_options().
  //! With other masks, the next solve() starts from the present state.
  //! \throws InputError if masks cannot be obeyed; OptionError
  void set_options(const BindOptions& options);

  const Cage<Dim>& cage() const { return solver_ ? solver_->cage() : cage_; }
  const DomainMesh<Dim>& mesh() const { return solver_ ? solver_->mesh() : mesh_; }
  const BindOptions& options() const { return options_; }
  //! Of the last solve or set_solution(); without weights before.
  const Solution& solution() const { return solver_ ? solver_->solution() : solution_; }

  //! Where the points are.
  const Placement<Dim>& placement() const { return placed_.placement; }

  //! BindOptions::masks, at the points and in the mesh.
  const PlacedMasks& masks() const { return placed_.masks; }

  //! What masks and mirror do not reach, and the solid regions; empty if there is nothing to say.
  std::string note() const;

  //! Weights of the points with all influences. They are kept until the solution or the model
  //! changes. Solves first if there is no solution.
  const SparseWeights& weights_of_points();

  //! The binding of the points with all influences.
  Binding<Dim> binding();

  //! The same reduced to BindOptions::max_influences each. Starts from the influences of the last
  //! call for this model and number, so that a small change has a small effect.
  Binding<Dim> bind();

 private:
  // The points in the present cage.
  struct Placed {
    Placement<Dim> placement{};
    std::optional<MirroredModel<Dim>> mirror{};  // of the placed points
    PlacedMasks masks{};
    double seconds = 0;
  };

  void begin();

  void take(MadeDomain<Dim> domain);
  bool keeps_solver() const;
  void require_solution();
  Solution solve_at_once(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                         const Placed& placed) const;
  static Placed place(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                      const PointList<Dim>& points, const EdgeList& edges,
                      const BindOptions& options);
  static Binding<Dim> frame(const Cage<Dim>& cage, const Placed& placed,
                            const BindOptions& options);
  static void constrain(Placed& placed, const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                        const PointList<Dim>& points, const BindOptions& options);
  SparseWeights evaluated(const Placement<Dim>& placement) const;
  void drop_weights();

  Cage<Dim> cage_;
  DomainMesh<Dim> mesh_{};
  PointList<Dim> points_;  // none for those of the mesh
  EdgeList edges_;
  BindOptions options_;
  BindReport report_{};
  std::unique_ptr<Solver<Dim>> solver_{};  // none for several parts, or before the first solve()
  Solution solution_{};                    // without a Solver
  bool is_given_ = false;                  // and converged, by set_solution()
  Placed placed_{};
  SparseWeights weights_{};  // at the placed points
  SparseWeights few_{};      // of the last bind()
  bool is_reduced_ = false;  // whether few_ are of the present weights and options
};

}  // namespace flbc
