// SPDX-License-Identifier: BSD-3-Clause
// The steps of flbc run. Each does its part in memory, writes its files and adds to the report.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "front/page.h"
#include "front/poses.h"
#include "run/folder.h"
#include "run/inputs.h"
#include "solve/cage_solver.h"

namespace flbc::app {

template <int Dim>
struct Run {
  const RunArguments& arguments;
  const Cage<Dim>& cage;
  const io::ModelFile* cage_file;  //!< null if the cage was made
  RunInputs<Dim>& inputs;          //!< without a model its shape comes with the mesh
  CageSolver<Dim>& solver;
  RunFolder& folder;
  nlohmann::ordered_json report{};

  Binding<Dim> reduced{};       //!< of the shape's points, at most so many influences of each
  Displacement displacement{};  //!< in the poses
  Binding<Dim> follower{};      //!< of RunInputs::follower
  Motion<Dim> drawing{};        //!< of RunInputs::follower, if it is one

  const std::vector<Pose<Dim>>& poses() const { return inputs.poses; }
  const Shape<Dim>& shape() const { return inputs.shape; }
  //! The points that the weights reproduce: the shape's, or the nearest ones of the cage.
  const PointList<Dim>& attached() const { return solver.binding().points; }
  bool has_model() const { return !arguments.settings.model.empty(); }
  //! Of the shape's points, with all influences.
  const SparseWeights& weights() const { return solver.binding().weights; }
};

//! cage.obj, if the cage has been made.
template <int Dim>
void deliver_cage(Run<Dim>& run);

//! domain.obj or domain.mesh
template <int Dim>
void mesh_interior(Run<Dim>& run);

//! weights.npy, and if these are a model's, domain_weights.npy.
template <int Dim>
void compute_weights(Run<Dim>& run);

//! Facts about the cage, properties of the weights of the mesh's vertices.
template <int Dim>
void check_weights_of_mesh(Run<Dim>& run);

//! sparse_weights.mtx, and binding.npz with all that commands need of cage and model.
template <int Dim>
void reduce_influences(Run<Dim>& run);

//! deformed.obj, or deformed_000.obj and so on, with the extension of the model.
template <int Dim>
void deform_shape(Run<Dim>& run);

//! model.glb, at rest or moving from there to the poses, and where more than four influences are
//! asked for model_8.glb. Left out if there are no triangles.
template <int Dim>
void export_shape(Run<Dim>& run);

//! function.png: one coordinate function, in 2D in the interior, in 3D on the shape.
template <int Dim>
void draw_function(Run<Dim>& run);

//! deformation.png, if there are poses: the shape at rest and in the pose where it moves farthest.
template <int Dim>
void draw_farthest_pose(Run<Dim>& run);

//! The cage with the edges and the text of its file, if it was read from one.
template <int Dim>
view::ShownCage<Dim> shown_cage(const Run<Dim>& run);

//! model.html: a page in which the cage can be moved, with the sparse weights and the poses.
template <int Dim>
void write_page(Run<Dim>& run);

}  // namespace flbc::app
