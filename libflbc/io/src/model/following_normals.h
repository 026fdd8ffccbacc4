// SPDX-License-Identifier: BSD-3-Clause
// Updates normals of a model when its vertices move.
#pragma once

#include "flbc/io/model.h"

namespace flbc::io {

//! The inverse transpose of a Jacobian times a normal, with its old length. The normal itself where
//! the Jacobian leaves it no direction.
Vector<3> transformed_normal(const Eigen::Matrix3d& jacobian, const Vector<3>& normal);

//! Rotates normals with their polygons: first by the best-fit rotation, then so that the
//! area-weighted mean of the polygon normals follows exactly. A normal therefore moves rigidly if
//! its polygons do, and a normal that is their mean remains the mean.
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
