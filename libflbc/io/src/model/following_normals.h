// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Normals of a model while its vertices move.
#pragma once

#include "flbc/io/model.h"

namespace flbc::io {

//! Normals that turn with the polygons they belong to: by the rotation that fits these best, and
//! then as it takes for the polygons' mean, weighted by area, to follow exactly. So a normal moves
//! rigidly where the polygons do, and one that is their mean remains it.
class FollowingNormals {
 public:
  //! Those of a model, and of its polygons (3 x number of polygons, or empty); both outlive this.
  FollowingNormals(const Model& model, const PointList<3>& face_normals);

  //! Number of normals that belong to no polygon with an area. They never turn.
  Index num_loose() const { return num_loose_; }

  //! The normals' turned images when the vertices are at `points`.
  struct Turned {
    PointList<3> normals;
    PointList<3> face_normals;
  };
  Turned at(const PointList<3>& points) const;

 private:
  bool has_normals() const;

  const Model& model_;
  const PointList<3>& face_normals_;
  PointList<3> rest_;        // the vertices, if there are normals
  PointList<3> rest_areas_;  // of the polygons
  Index num_loose_ = 0;
};

}  // namespace flbc::io
