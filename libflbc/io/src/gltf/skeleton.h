// SPDX-License-Identifier: BSD-3-Clause
// A cage that bones skin, read from glTF: its joints may then skin the model in the cage.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "flbc/sparse_weights.h"
#include "model/gltf_document.h"

namespace flbc::gltf {

//! An animated property of a node.
struct JointChannel {
  std::size_t node;         //!< of Skeleton::nodes
  std::string path;         //!< "translation", "rotation", or "scale"
  bool is_step;             //!< else linear between keys
  Eigen::RowVectorXd keys;  //!< in seconds, ascending
  Eigen::MatrixXd values;   //!< a column per key
};

struct Clip {
  std::string name;
  std::vector<JointChannel> channels{};
  std::vector<double> keys{};  //!< of all channels, ascending
};

//! J joints, and how they move a cage of n control points, in its coordinates.
struct Skeleton {
  std::vector<io::GltfJson> nodes{};          //!< joints and their ancestors: names and transforms
  std::vector<std::ptrdiff_t> parents{};      //!< of the nodes; -1 = none
  std::vector<std::size_t> joints{};          //!< J of the nodes
  std::vector<Eigen::Affine3d> binds{};       //!< J inverse bind matrices
  SparseWeights weights{};                    //!< of the control points for the joints
  std::vector<Clip> clips{};                  //!< animations of the nodes
  Eigen::Matrix3Xd cage{};                    //!< 3 x n, as bound in the file
  std::vector<Eigen::Affine3d> cage_binds{};  //!< J inverse bind matrices of these

  //! The J places of the joints. \param clip  null: at rest
  std::vector<Eigen::Affine3d> places(const Clip* clip, double time) const;
  //! The control points that joints at these places move, 3 x n.
  PointList<3> pose(const std::vector<Eigen::Affine3d>& places) const;
};

//! Finds the skinned mesh that has a vertex at each control point, in the pose of the file or as it
//! was bound.
//! \param path  .glb, .gltf, or .vrm \param control_points  3 x n, at rest
//! \throws IoError; InputError naming the farthest control point if there is no such mesh
Skeleton read_skeleton(const std::string& path, const PointList<3>& control_points);

}  // namespace flbc::gltf
