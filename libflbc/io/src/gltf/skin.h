// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A model that moves with its cage, for engines and viewers: a glTF skin in which every control
//! point is a joint that only translates. Joint i moves from c_i to c_i', and so a point x to
//! sum w_i (x + c_i' - c_i), which is sum w_i c_i' because the weights sum to 1 and reproduce x.
//! Normals stay as they are at rest: joints that do not turn do not turn them.
#pragma once

#include <string>
#include <vector>

#include "flbc/sparsify.h"
#include "flbc/sparsify_error.h"
#include "gltf/joint_weights.h"
#include "gltf/surface.h"

namespace flbc::gltf {

//! The file that holds a skin.
enum class SkinFormat { kGlb, kUsda };

//! How the skin is stored.
struct SkinOptions {
  Index max_influences = 8;  //!< per point, 4 or 8
  WeightFormat weight_format = WeightFormat::kFloat;
  std::string name = "model";  //!< of the mesh, in .glb
  SkinFormat format = SkinFormat::kGlb;
  FacetList<2> cage_edges{};  //!< 2 x E, between control points, in .glb; no column = not written
};

//! Poses of the cage, between which it moves along straight lines.
template <int Dim>
struct Animation {
  std::vector<double> times{};          //!< of the poses in seconds, 0 or more, ascending
  std::vector<PointList<Dim>> poses{};  //!< Dim x n each
};

//! \throws InputError naming the pose if there are not as many times as poses, if one has not the
//! given number of control points, or if times are below 0 or do not ascend in single precision
template <int Dim>
void validate(const Animation<Dim>& animation, Eigen::Index num_control_points);

//! A .glb or .usda file and what is in it.
struct ExportedSkin {
  std::string content{};       //!< of the file
  Index vertices = 0;          //!< S
  Index triangles = 0;         //!< T
  Index joints = 0;            //!< n
  Index moving_joints = 0;     //!< those with a channel of the animation
  Index influences = 0;        //!< most per vertex
  Index given_influences = 0;  //!< most per vertex of the weights given
  std::vector<std::string>
      left_out{};              //!< materials and pictures that could not be had, a phrase each
  double position_change = 0;  //!< largest distance by which rounding moves a vertex
  //! Distances between vertices moved by the weights given and by those in the file, over the poses
  //! of the animation or, without one, over random smooth ones (smooth_poses()).
  ErrorNorms deformation_error{};
};

//! Weights of more than `max_influences` control points, and such with numbers below 0, are reduced
//! by sparsify(); others stay.
//! \param control_points  Dim x n \param points  Dim x P \param weights  of P points, reproducing
//! \param surface  of these points; in 2D it lies in the plane z = 0
//! \throws OptionError for another number of influences; InputError if sizes do not fit, for more
//! than 65535 control points, if a coordinate is too large for single precision, and as validate()
//! and sparsify()
template <int Dim>
ExportedSkin export_skin(const PointList<Dim>& control_points, const PointList<Dim>& points,
                         const SparseWeights& weights, const Surface& surface,
                         const SkinOptions& options = {}, const Animation<Dim>& animation = {});

}  // namespace flbc::gltf
