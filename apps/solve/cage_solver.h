// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a cage to weights, as settings say.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "files/load.h"
#include "files/locality_file.h"
#include "flbc/cage.h"
#include "flbc/cell_locator.h"
#include "flbc/errors.h"
#include "flbc/interpolate.h"
#include "flbc/io/formats.h"
#include "flbc/meshing.h"
#include "flbc/place_masks.h"
#include "flbc/placement.h"
#include "flbc/quality.h"
#include "flbc/solver.h"
#include "help/wording.h"
#include "report/history.h"
#include "solve/solve_settings.h"

namespace flbc::app {

//! Computes the coordinates of the settings, or solves with their options.
template <int Dim>
Solution compute_weights(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                         const SolveSettings& settings, const Observer& observer);

//! Their weights at placed points. \param of_domain  not used for pointwise coordinates
template <int Dim>
SparseWeights weights_of_points(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                                const SparseWeights& of_domain, const Placement<Dim>& placement,
                                const SolveSettings& settings);

//! The steps of a solve, to be taken in this order: make_domain(), solve(). Errors name the files.
template <int Dim>
class CageSolver {
 public:
  //! Keeps references to all. \param model  Dim x P, not looked at if settings name no model
  CageSolver(const Cage<Dim>& cage, const PointList<Dim>& model, const SolveSettings& settings);

  //! Refuses a model outside its cage. Then reads the mesh, or makes it, and finds the model's
  //! vertices in it.
  //! \param quiet  without a progress line
  void make_domain(bool quiet);

  //! \param quiet  without a progress line
  void solve(bool quiet);

  const Cage<Dim>& cage() const { return cage_; }
  const DomainMesh<Dim>& domain() const { return domain_; }
  const SparseWeights& domain_weights() const { return solution_.weights; }
  const Solution& solution() const { return solution_; }
  const SolveReport& report() const { return solution_.report; }
  double mesh_seconds() const { return mesh_seconds_; }
  //! The mesher of the mesh; "none" if it was read.
  const std::string& mesher() const { return mesher_; }

  //! The points that the weights reproduce: the model's vertices, or those of the mesh. Vertices
  //! that follow the nearest point of the cage are there.
  const PointList<Dim>& points() const;
  //! Their weights.
  const SparseWeights& rows() const { return settings_.model.empty() ? domain_weights() : rows_; }

  //! Where the model's vertices are; empty without a model.
  const Placement<Dim>& placement() const { return placement_; }

  //! The masks of the points, for reductions.
  const std::vector<flbc::Mask>& masks() const { return masks_.of_points; }

  //! The report of the whole. \param delivered  quality of rows()
  nlohmann::ordered_json json(const Quality& delivered) const;

 private:
  // Without a mesh. Vertices of no face may be outside: they follow the nearest point of the cage.
  void place_in_cage(bool quiet);
  void fill_cage(bool quiet);
  void load_masks(bool quiet);
  // Says what the problem does not determine, and how long a long solve may take.
  void announce() const;
  void solve_without_mesh();
  SparseWeights weights_of_model() const;
  double objective() const;

  const Cage<Dim>& cage_;
  const PointList<Dim>& model_;
  const SolveSettings& settings_;
  OutsidePoints outside_;             // treatment of vertices there
  const char* outside_verb_ = "are";  // "vertices VERB outside the cage"
  DomainMesh<Dim> domain_;
  double mesh_seconds_ = 0;  // for making or reading it
  std::string mesher_ = "none";
  Solution solution_;  // at the vertices of the domain
  std::vector<HistoryEntry> history_;
  Placement<Dim> placement_;  // of the model's vertices
  Locality locality_;
  PlacedMasks masks_;
  EmbeddablePoints<Dim> embedded_;  // of the model, if it is to be embedded
  SparseWeights rows_;              // at the model's vertices, once solved
};

//! How many vertices were snapped to the cage; empty for none.
template <int Dim>
std::string describe(const Placement<Dim>& placement, double size);

//! Prints how many vertices are outside the cage, how far, and what they do.
//! \param distance  of the farthest, relative to the cage size \param verb  in "vertices VERB outside"
void print_outside(const std::string& file, std::size_t count, std::size_t all, double distance,
                   OutsidePoints policy, const char* verb = "are");

//! The same of a placement, if there are any.
//! \param file  of the model
template <int Dim>
void warn_outside(const Placement<Dim>& placement, double size, const std::string& file,
                  const char* verb = "are");

//! Calls an action that places the vertices of a model. Refusals name the file, and what to do with
//! vertices outside the cage.
template <int Dim, class Action>
auto placing(const std::string& file, const Action& action) {
  try {
    return naming(file, action);
  } catch (const InputError& error) {
    const bool is_mesh = Dim == 2 || io::holds(file, {io::Content::kMesh3D});
    throw InputError(is_mesh ? advise_keeping(error.what()) : error.what());
  }
}

//! That weights are not what was asked for, on standard error. \return whether they are
bool report_convergence(const SolveReport& report, const SolveSettings& settings);

}  // namespace flbc::app
