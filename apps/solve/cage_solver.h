// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a cage to weights, as settings say, from the cache if they are there.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/cell_locator.h"
#include "flbc/interpolate.h"
#include "flbc/meshing.h"
#include "flbc/placement.h"
#include "flbc/quality.h"
#include "report/history.h"
#include "solve/cache_key.h"
#include "solve/checkpoint.h"
#include "solve/solve_settings.h"
#include "solve/weights_cache.h"

namespace flbc::app {

//! The steps of a solve, to be taken in this order: make_domain(), solve(). Errors name the files.
template <int Dim>
class CageSolver {
 public:
  //! Keeps references to all. \param model  Dim x P, not looked at if settings name no model
  //! \throws IoError if the cache cannot be used
  CageSolver(const Cage<Dim>& cage, const PointList<Dim>& model, const SolveSettings& settings);

  //! Finds mesh and weights in the cache, or mesh and state in the file of the checkpoint; or reads the mesh, or makes it. Then finds the model's
  //! vertices in it, so that a model outside its cage is refused before the solve. Says on standard
  //! error if a file of the cache is of no use.
  //! \param quiet  without a progress line
  void make_domain(bool quiet);

  //! Nothing, if the weights were in the cache; else they go there if they have converged.
  //! \param quiet  without a progress line
  void solve(bool quiet);

  //! To be called when all results are written: the state of a solve that has converged is of no use
  //! any more.
  void forget_checkpoint() const;

  const Cage<Dim>& cage() const { return cage_; }
  const DomainMesh<Dim>& domain() const { return solved_.domain; }
  const SparseWeights& domain_weights() const { return solved_.solution.weights; }
  const SolveReport& report() const { return solved_.solution.report; }
  bool is_cached() const { return is_cached_; }
  double mesh_seconds() const { return solved_.mesh_seconds; }
  Mesher mesher() const { return solved_.mesher; }

  //! The points that get weights: the model's vertices, or those of the mesh. Vertices beside the
  //! cage are where their weights put them.
  const PointList<Dim>& points() const;
  //! Their weights.
  const SparseWeights& rows() const { return settings_.model.empty() ? domain_weights() : rows_; }

  //! Where the model's vertices are; empty without a model.
  const Placement<Dim>& placement() const { return placement_; }

  //! The report of the whole. \param delivered  quality of rows()
  nlohmann::ordered_json json(const Quality& delivered) const;

 private:
  WeightOrigin<Dim> origin() const;
  SparseWeights weights_of_model() const;
  bool find_in_cache();
  bool find_checkpoint(bool quiet);
  void compute(bool quiet);

  const Cage<Dim>& cage_;
  const PointList<Dim>& model_;
  const SolveSettings& settings_;
  std::optional<WeightsCache> cache_;
  std::optional<Checkpoint<Dim>> checkpoint_;
  KeptRun<Dim> kept_;  // to go on from
  std::string key_;
  SolvedDomain<Dim> solved_;
  bool is_cached_ = false;
  std::vector<HistoryEntry> history_;
  Placement<Dim> placement_;  // of the model's vertices
  EmbeddablePoints<Dim> embedded_;  // of the model, if it is to be embedded
  SparseWeights rows_;  // at the model's vertices, once solved
};

//! How many vertices lie beside the cage, and what became of them; empty for none.
template <int Dim>
std::string describe(const Placement<Dim>& placement, double size);

//! That weights are not what was asked for, on standard error. \return whether they are
bool tell_convergence(const SolveReport& report, const SolveSettings& settings);

}  // namespace flbc::app
