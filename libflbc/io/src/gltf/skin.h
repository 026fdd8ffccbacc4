// SPDX-License-Identifier: BSD-3-Clause
// A model that moves with its cage, for engines and viewers: a glTF skin in which every control
// point is a joint that only translates. Joint i moves from c_i to c_i', and so a point x to sum
// w_i (x + c_i' - c_i), which is sum w_i c_i' if the weights sum to 1 and reproduce x. Otherwise
// the point keeps its offset from what they reproduce. A point without weights belongs to the root
// joint and does not move. Normals do not change, because the joints do not rotate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flbc/binding.h"
#include "flbc/sparsify_error.h"
#include "gltf/joint_weights.h"
#include "model/surface.h"

namespace flbc::gltf {

struct Skeleton;  // gltf/skeleton.h

//! Displacements beyond this part of the model size make vertices visibly jitter.
constexpr double kVisibleChange = 1e-5;

enum class SkinFormat { kGlb, kUsda };

struct SkinOptions {
  Index max_influences = 8;    //!< per point, 4 or 8
  std::string name = "model";  //!< of the mesh, in .glb
  SkinFormat format = SkinFormat::kGlb;
  //! Whether each solid region of the binding is one joint more, which turns and moves it without
  //! distortion. A pose gives it the rotation and translation that are nearest to the affine map of
  //! the region, in the sense of least squares over its points.
  bool rigid = false;
  //! Rotation about the origin from the model to y up, for readers. The root has it; coordinates
  //! stay as they are.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
};

//! Poses of the cage, with linear interpolation between them.
template <int Dim>
struct Animation {
  std::vector<double> times{};          //!< of the poses in seconds, >= 0, ascending
  std::vector<PointList<Dim>> poses{};  //!< Dim x n each
};

//! \throws InputError naming the pose if the numbers of times and poses differ, a pose has another
//! number of control points, or times are negative or not ascending in single precision
template <int Dim>
void validate(const Animation<Dim>& animation, Eigen::Index num_control_points);

//! A .glb or .usda file and its statistics.
struct ExportedSkin {
  std::string content{};                //!< of the file
  Index vertices = 0;                   //!< S
  Index triangles = 0;                  //!< T
  Index joints = 0;                     //!< n, with those of solid regions, or J of a skeleton
  Index moving_joints = 0;              //!< joints with an animation channel
  Index influences = 0;                 //!< maximum per vertex
  Index given_influences = 0;           //!< maximum per vertex of the given weights
  std::vector<std::string> left_out{};  //!< missing materials and images, one phrase each
  double position_change = 0;           //!< maximum displacement of a vertex by rounding
  //! Distances between vertices deformed by the given weights and by those in the file, over the
  //! poses of the animation, or over smooth_poses() if there is none.
  ErrorNorms deformation_error{};
  //! With SkinOptions::rigid: the same between points of solid regions moved by the cage and by
  //! their joints.
  std::optional<ErrorNorms> rigid_error{};
  //! With a skeleton: distances between points deformed by the cage and by its joints over the keys
  //! of the clips, and the same with morph targets.
  std::optional<ErrorNorms> skeleton_error{}, corrected_error{};
  std::size_t keys = 0;  //!< of all clips
};

//! Weights are reduced by Binding::reduced() with the poses of the animation. Non-negative weights
//! with at most `max_influences` influences are unchanged.
//! \param binding  of P points \param surface  of these points; in 2D it lies in the plane z = 0
//! \throws OptionError for another number of influences; InputError if sizes do not match, there
//! are more than 65535 joints, none of the regions is to be rigid because there are none, or a
//! coordinate is too large for single precision, and as validate() and sparsify()
template <int Dim>
ExportedSkin export_skin(const Binding<Dim>& binding, const Surface& surface,
                         const SkinOptions& options = {}, const Animation<Dim>& animation = {});

//! The same with the joints of a skinned cage: their weights are those of flbc::skin().
//! \param corrects  whether a morph target for each key closes the difference from the deformation
//! by the cage
//! \throws as above; OptionError for .usda; InputError if the model has morph targets already
ExportedSkin export_skin(const Binding<3>& binding, const Surface& surface,
                         const SkinOptions& options, const Skeleton& skeleton, bool corrects);

}  // namespace flbc::gltf
