// SPDX-License-Identifier: BSD-3-Clause
// Plane cuts through the domain of a cage in space.
#pragma once

#include <vector>

#include "draw/primitives.h"
#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc::draw {

//! An oriented plane with coordinates of its own; u, v and normal are orthonormal and right-handed.
struct Plane {
  Vector<3> origin;
  Vector<3> u;
  Vector<3> v;
  Vector<3> normal;

  double distance(const Vector<3>& p) const { return normal.dot(p - origin); }
  //! The plane coordinates of the nearest point of the plane.
  Vector<2> to_plane(const Vector<3>& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
  Vector<3> to_space(const Vector<2>& p) const { return origin + p.x() * u + p.y() * v; }
};

//! The plane through a point. For a normal along an axis, u and v are along axes as well.
//! \param normal  of any length. \throws OptionError if it is zero
Plane plane_through(const Vector<3>& origin, const Vector<3>& normal);

//! A function on the part of a plane that lies in the domain.
struct Slice {
  Plane plane;
  DomainMesh<2> mesh{};      //!< in plane coordinates, positively oriented; the triangles share
                             //!< no vertices, and may be degenerate
  Eigen::VectorXd values{};  //!< at the vertices of `mesh`, interpolated linearly
  std::vector<Segment> outline{};  //!< where the plane meets the cage, in no particular order
  std::vector<Segment> section{};  //!< where it meets the model, if one is shown
};

//! Where a plane meets a surface of triangles, in plane coordinates and no particular order.
std::vector<Segment> section_of(const Cage<3>& surface, const Plane& plane);

//! Cuts all cells by the plane. A face of the mesh that lies in the plane counts once.
//! \param values  V, the function at the vertices of the mesh
Slice cut(const Cage<3>& cage, const DomainMesh<3>& mesh, const Eigen::VectorXd& values,
          const Plane& plane);

//! Parallel planes, ascending along the axis on which the cage is longest: they spread over the
//! range in which the function is not zero, at least over a quarter of the cage, and one passes
//! through the control point, or a fifth of that range beside it where the point is a tip, as far
//! as the spacing allows.
//! \param count  >= 1. \throws OptionError if it is not
std::vector<Plane> choose_planes(const Cage<3>& cage, const DomainMesh<3>& mesh,
                                 const Eigen::VectorXd& values, Index control_point, int count);

}  // namespace flbc::draw
