// SPDX-License-Identifier: BSD-3-Clause
// Updates normals of a model when its vertices move.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "flbc/io/model.h"

namespace flbc::io {

//! The inverse transpose of a Jacobian times a normal, with its old length. The normal itself where
//! the Jacobian leaves it no direction.
Vector<3> transformed_normal(const Eigen::Matrix3d& jacobian, const Vector<3>& normal);

//! How a surface turns and stretches around each of its vertices, as the difference from the
//! identity: exactly 0 around polygons that stay where they are, and right for affine maps. Edges
//! define it along the surface; across a smooth or flat one it is that of the whole surface, turned
//! as the edges are. Mirrored surfaces have negative determinants.
std::vector<Eigen::Matrix3d> changes_of_space(const std::vector<std::vector<Index>>& polygons,
                                              const PointList<3>& before,
                                              const PointList<3>& after);

//! Multiplies normals by the inverse transpose of the changes of space around them, without turning
//! them over where these mirror, and then turns them so that the area-weighted mean of the polygon
//! normals follows exactly: a normal that is this mean remains it. Lengths are kept.
class FollowingNormals {
 public:
  //! The normals of a model, and of its polygons (3 x number of polygons, or empty); both must
  //! outlive this.
  FollowingNormals(const Model& model, const PointList<3>& face_normals);

  //! Number of normals that belong to no polygon with nonzero area. They never change.
  Index num_loose() const { return num_loose_; }

  //! The rotated normals for vertices at `points`.
  struct Turned {
    PointList<3> normals;
    PointList<3> face_normals;
  };
  Turned at(const PointList<3>& points) const;

  //! The normals under the Jacobians at the vertices (9 x P, column by column): the inverse
  //! transpose of the mean Jacobian of the vertices of a normal. Lengths are kept.
  Turned by(const Eigen::MatrixXd& jacobians) const;

 private:
  bool has_normals() const;

  const Model& model_;
  const PointList<3>& face_normals_;
  PointList<3> rest_;        // rest vertices, if there are normals
  PointList<3> rest_areas_;  // of the polygons
  Index num_loose_ = 0;
};

}  // namespace flbc::io
