// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a cage to weights, as settings say.
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/errors.h"
#include "flbc/meshing.h"
#include "flbc/placement.h"
#include "flbc/quality.h"
#include "flbc/rig.h"
#include "front/load.h"
#include "front/locality_file.h"
#include "solve/solve_settings.h"

namespace flbc::app {

//! The settings as options of a Rig, with all influences.
template <int Dim>
BindOptions bind_options(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                         const SolveSettings& settings);

//! The steps of a solve, to be taken in this order: make_domain(), solve(). Errors name the files.
//! What the library does for any program, a Rig does.
template <int Dim>
class CageSolver {
 public:
  //! Keeps references to all. \param model  Dim x P; no point if settings name no model
  //! \param edges  of the model, for reductions
  CageSolver(const Cage<Dim>& cage, const PointList<Dim>& model, const EdgeList& edges,
             const SolveSettings& settings);

  //! Refuses a model outside its cage. Then reads the mesh, or makes it, and finds the model's
  //! vertices in it.
  //! \param quiet  without a progress line
  void make_domain(bool quiet);

  //! \param quiet  without a progress line
  void solve(bool quiet);

  //! The model, or else the mesh, with its weights.
  Rig<Dim>& rig() const { return *rig_; }
  const Cage<Dim>& cage() const { return cage_; }
  const DomainMesh<Dim>& domain() const { return rig_->mesh(); }
  const SparseWeights& domain_weights() const { return solution().weights; }
  const Solution& solution() const { return rig_->solution(); }
  const SolveReport& report() const { return solution().report; }
  double mesh_seconds() const { return mesh_seconds_; }
  //! The mesher of the mesh; "none" if it was read.
  const std::string& mesher() const { return mesher_; }

  //! All weights of the model's vertices, or else of those of the mesh.
  const Binding<Dim>& binding() const { return binding_; }

  //! The report of the whole. \param delivered  quality of rows()
  nlohmann::ordered_json json(const Quality& delivered) const;

 private:
  // Vertices of no face may be outside: they follow the nearest point of the cage.
  void require_inside(bool quiet);
  MadeDomain<Dim> fill_cage(bool quiet);
  void find_model(MadeDomain<Dim> made, bool quiet);
  void load_masks(bool quiet);
  // Says what the problem does not determine, and how long a long solve may take.
  void announce() const;
  double objective() const;

  const Cage<Dim>& cage_;
  const PointList<Dim>& model_;
  const EdgeList& edges_;
  const SolveSettings& settings_;
  OutsidePoints outside_;    // treatment of vertices there
  double mesh_seconds_ = 0;  // for making or reading it
  std::string mesher_ = "none";
  Locality locality_;
  EmbeddablePoints<Dim> embedded_;  // of the model, if it is to be embedded
  std::unique_ptr<Rig<Dim>> rig_;
  Binding<Dim> binding_;
};

//! That weights are not what was asked for, on standard error. \return whether they are
bool report_convergence(const SolveReport& report, const SolveSettings& settings);

}  // namespace flbc::app
