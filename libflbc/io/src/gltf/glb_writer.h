// SPDX-License-Identifier: BSD-3-Clause
// Writes binary glTF 2.0 and Universal Scene Description, limited to a skin whose joints only
// translate. Only glb_writer.cpp includes the glTF library.
#pragma once

#include <string>
#include <vector>

#include "gltf/joint_weights.h"
#include "gltf/look.h"

namespace flbc::gltf {

//! One translation per time of the animation.
struct Channel {
  Index joint;
  Eigen::Matrix3Xf translations;  //!< 3 x number of times
};

//! A skinned mesh as stored: S vertices, T triangles, n joints.
struct GlbScene {
  std::string name{};  //!< of the mesh
  //! Origin of the following coordinates, in cage coordinates. Single precision would be too coarse
  //! far from the origin.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xf positions{};            //!< 3 x S
  Eigen::Matrix3Xf normals{};              //!< 3 x S
  Eigen::Matrix2Xf texture_coordinates{};  //!< 2 x S, or no column
  Eigen::Matrix3Xf colors{};               //!< 3 x S, or no column
  Eigen::RowVectorXf sources{};            //!< S, written as _VERTEX, or none
  JointWeights weights{};                  //!< of the S vertices
  FacetList<3> triangles{};                //!< 3 x T
  Look look{};                             //!< of the triangles
  Eigen::Matrix3Xf joints{};               //!< 3 x n, at rest
  FacetList<2> wire{};                     //!< 2 x E, edges between joints, or no column
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  //!< rotation of the root
  std::vector<float> times{};                          //!< in seconds
  std::vector<Channel> channels{};                     //!< joints that move
};

//! Makes the content of a .glb file. The scene has two root nodes: the mesh, and the joint "cage"
//! at the center of the cage. Only this joint has the offset from the origin. Its children are the
//! joints "control_point_0" etc., and "cage_end", which moves nothing but makes programs draw short
//! bones. A second scene, not shown by default, also has the cage edges: the skinned node
//! "cage_wire".
//! \throws InputError if it exceeds the 4 GB limit of the format
std::string encode_glb(const GlbScene& scene);

//! Makes the content of a .usda file: a SkelRoot "model" with the mesh "surface", the skeleton
//! "cage" and, if something moves, its animation "poses". Its joints are a root "cage", which never
//! moves, and its children, the control points. Influences are not limited to sets of four.
std::string encode_usda(const GlbScene& scene);

}  // namespace flbc::gltf
