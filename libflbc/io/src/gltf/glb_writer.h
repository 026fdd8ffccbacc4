// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The binary form of glTF 2.0, as far as a skin whose joints only translate needs it. The library
//! behind it is seen in glb_writer.cpp only.
#pragma once

#include <string>
#include <vector>

#include "gltf/joint_weights.h"
#include "gltf/look.h"

namespace flbc::gltf {

//! A translation for every moment of the animation.
struct Channel {
  Index joint;
  Eigen::Matrix3Xf translations;  //!< 3 x number of moments
};

//! A skinned mesh, in the numbers that are stored: S vertices, T triangles, n joints.
struct GlbScene {
  std::string name{};                      //!< of the mesh
  //! Of the numbers that follow, in the cage's coordinates: far from the origin single precision
  //! would be too coarse.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3Xf positions{};            //!< 3 x S
  Eigen::Matrix3Xf normals{};              //!< 3 x S
  Eigen::Matrix2Xf texture_coordinates{};  //!< 2 x S, or no column
  Eigen::Matrix3Xf colors{};               //!< 3 x S, or no column
  Eigen::RowVectorXf sources{};            //!< S, written as _VERTEX, or none
  JointWeights weights{};                  //!< of the S vertices
  FacetList<3> triangles{};                //!< 3 x T
  Look look{};                             //!< of the triangles
  Eigen::Matrix3Xf joints{};               //!< 3 x n, where they rest
  FacetList<2> wire{};                     //!< 2 x E, edges between joints, or no column
  std::vector<float> times{};              //!< of the moments, in seconds
  std::vector<Channel> channels{};         //!< joints that move
};

//! The content of a .glb file. Two nodes are roots of the scene: that of the mesh, and the joint
//! "cage" in the middle of the cage, which alone knows how far that is from the origin. Its children are the joints "control_point_0" and so on, and
//! "cage_end", near it, which moves nothing but makes programs draw short bones. A second scene, which is not shown by
//! default, has the cage's edges as well: the node "cage_wire", which the joints move.
//! \throws InputError if it exceeds the 4 GB such a file can have
std::string encode_glb(const GlbScene& scene);

}  // namespace flbc::gltf
