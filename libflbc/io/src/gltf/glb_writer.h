// SPDX-License-Identifier: BSD-3-Clause
// Writes binary glTF 2.0 and Universal Scene Description: a mesh and its skin. Joints of control
// points only translate, those of solid regions turn as well, and those of a skeleton, in glTF, do
// anything.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gltf/joint_weights.h"
#include "gltf/skeleton.h"
#include "model/gltf_writer.h"

namespace flbc::gltf {

//! A place per time of the animation.
struct Channel {
  Index joint;
  Eigen::Matrix3Xf translations;    //!< 3 x number of times
  Eigen::Matrix4Xf rotations = {};  //!< quaternions x, y, z, w, or none
};

//! A skinned mesh as stored: its S vertices and T triangles, or the document of its file; n joints.
struct GlbScene {
  const Surface& surface;        //!< of which the vertices are
  Eigen::Matrix3Xf positions{};  //!< 3 x S
  Eigen::RowVectorXf sources{};  //!< S, written as _VERTEX, or none
  std::string name{};            //!< of the mesh
  //! Origin of the following coordinates, in cage coordinates. Single precision would be too coarse
  //! far from the origin.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  JointWeights weights{};     //!< of the S vertices; with a document of the points of the model
  Eigen::Matrix3Xf joints{};  //!< 3 x n, at rest: control points, then centers of solid regions
  Index solid_regions = 0;    //!< how many of these are centers
  //! Rotation about the origin of the cage coordinates.
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  std::vector<float> times{};                        //!< in seconds
  std::vector<Channel> channels{};                   //!< joints that move
  std::shared_ptr<const io::GltfSource> document{};  //!< null: the mesh is written anew
  //! Has the joints in place of control points, without origin, turn, and channels; may be null.
  const Skeleton* skeleton = nullptr;
  //! Morph targets, one for each key of the clips: 3 x number of weights. May be empty.
  std::vector<Eigen::Matrix3Xf> corrections{};

  //! Joints that may move. Points without weights have the joint of this number.
  Eigen::Index num_joints() const {
    return skeleton ? static_cast<Eigen::Index>(skeleton->joints.size()) : joints.cols();
  }
};

//! "control_point_0" etc., then "solid_0" etc.
std::string joint_name(const GlbScene& scene, Eigen::Index joint);

//! Makes the content of a .glb file. The scene has two root nodes: the mesh, and the joint "cage"
//! at the center of the cage. Only this joint has the offset from the origin. Its children are the
//! joints of joint_name(), and "cage_end", which moves nothing but makes programs draw short
//! bones. A document keeps all its content, except for skins of the model and animations of their
//! joints. Positions stay in the coordinates of their nodes, which lose their transforms and
//! parents, because those do not move skins, unless something else needs them. Triangles turn over
//! where a mirroring is lost. With a skeleton the root is "skeleton".
//! \param left_out  gets what is missing, one phrase each
//! \throws InputError if it exceeds the 4 GB limit of the format
std::string encode_glb(const GlbScene& scene, std::vector<std::string>& left_out);

//! Makes the content of a .usda file: a SkelRoot "model" with the mesh "surface", the skeleton
//! "cage" and, if something moves, its animation "poses". Its joints are a root "cage", which never
//! moves, and its children, those of joint_name(). Influences are not limited to sets of four.
std::string encode_usda(const GlbScene& scene);

}  // namespace flbc::gltf
