// SPDX-License-Identifier: BSD-3-Clause
// A model on its way: cage, mesh of the interior, weights, and what is saved of them.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "files/model_facets.h"
#include "files/movable_model.h"
#include "flbc/errors.h"
#include "flbc/placement.h"
#include "flbc/solver.h"
#include "gltf/surface.h"
#include "solve/make_domain.h"
#include "view/page.h"

namespace flbc::web {

using Json = nlohmann::ordered_json;

//! Receives the name of a stage and its progress in [0, 1].
using Report = std::function<void(const char* stage, double done)>;

//! A cage with defects, and where they are.
class DefectiveCage : public InputError {
 public:
  DefectiveCage(const std::string& message, std::vector<Index> control_points)
      : InputError(message), control_points(std::move(control_points)) {}
  std::vector<Index> control_points;
};

//! Steps, to be taken in this order. Sizes and errors are those of the library. Options have the
//! names of the program.
template <int Dim>
class Work {
 public:
  //! A model's file, or a picture (in 2D). \param facets  of the file
  Work(const std::string& name, app::ModelFacets<Dim> facets);
  //! A model of triangles.
  Work(const std::string& name, io::Model model);

  //! \param options  "controlPoints", "offset", "symmetry" \return facts about it
  Json make_cage(const Json& options, const Report& report);
  //! \throws DefectiveCage; the cage is kept then, to be shown or repaired
  Json read_cage(const std::string& file);
  void set_cage(Cage<Dim> cage);
  //! \return what was changed
  Json repair_cage();

  //! \param options  "vertices"
  Json make_mesh(const Json& options, const Report& report);
  void set_mesh(DomainMesh<Dim> mesh);

  //! \param options  "smoothness", "tolerance", "distances", "precision"
  Json solve(const Json& options, const Report& report);
  //! In place of make_mesh() and solve(), what another worker has computed for this cage.
  //! \param weights  of the vertices of the mesh
  void set_solution(DomainMesh<Dim> mesh, const SparseWeights& weights);
  //! The rest cage in another shape: {"points"} or {"refine"}, within a budget of time.
  Json move(const Json& request);
  //! Fewer influences in what follows. \param options  "influences"
  Json reduce(const Json& options, const Report& report);

  const PointList<Dim>& points() const { return points_; }
  const Cage<Dim>& cage() const { return cage_; }
  const DomainMesh<Dim>& mesh() const { return mesh_; }
  const SparseWeights& weights_of_mesh() const { return of_mesh_; }
  //! At the model's points.
  const SparseWeights& weights() const { return weights_; }
  //! The same with as few influences as a page shows; none before solve().
  SparseWeights shown_weights() const;
  //! Harmonic coordinates there.
  SparseWeights harmonic() const;

  //! Where control points take the model's points.
  PointList<Dim> posed(const PointList<Dim>& control_points) const;

  //! For decodeContent() of the page; without weights before solve(). \param picture  data URI of a
  //! texture, or empty: that of the model's material
  std::string content(const std::string& picture) const;
  //! A page that needs no other file.
  std::string page(const std::string& picture) const;
  //! \param options  "influences"
  std::string glb(const Json& options) const;
  //! \param options  "format", and "of": "model" or "mesh"
  std::string weight_file(const Json& options) const;
  std::string cage_file() const;
  std::string mesh_file() const;
  //! The model where control points take it, in its own format or in another one.
  std::string model_file(const PointList<Dim>& control_points, const std::string& extension) const;

 private:
  void take(io::Model model);
  Json cage_facts() const;
  void place_in_cage();
  void update_weights(const SparseWeights& of_mesh);
  view::PageContent<Dim> page_content(const std::string& picture) const;

  std::string name_;
  app::ModelFacets<Dim> facets_;                // what the cage is to enclose
  std::optional<app::MovableModel<Dim>> file_;  // none: the model was made
  io::Model made_;
  PointList<Dim> points_;
  gltf::Surface surface_;
  EdgeList edges_;
  Cage<Dim> cage_;
  view::ShownCage<Dim> shown_;
  DomainMesh<Dim> mesh_;
  app::Mesher mesher_ = app::Mesher::kAuto;
  OutsidePoints outside_ = OutsidePoints::kFail;
  Placement<Dim> placement_;
  // None if the cage has several parts, or if another worker solved.
  std::unique_ptr<Solver<Dim>> solver_;
  SparseWeights of_mesh_;
  SparseWeights weights_;  // at the model's points
};

}  // namespace flbc::web
