// SPDX-License-Identifier: BSD-3-Clause
// Tests whether a point is inside a cage, and computes distances to facets. Holes and cavities are
// outside.
#pragma once

#include <vector>

#include "flbc/cage.h"

namespace flbc {

enum class Containment { kInside, kOutside, kOnCage };

//! Connected component of each facet: loops in 2D, shells in 3D, numbered from 0 in the order of
//! their first facets.
template <int Dim>
std::vector<Index> facet_shells(const Cage<Dim>& cage);

//! Locates points relative to a valid cage. A point is inside if an odd number of loops or shells
//! enclose it, in any orientation. Time is proportional to the number of facets.
template <int Dim>
class CageLocator {
 public:
  //! \param tolerance  maximum distance from a facet for a point on the cage
  CageLocator(const Cage<Dim>& cage, double tolerance);

  Containment locate(const Vector<Dim>& point) const;

  //! Whether locate() returns kOutside. For points inside this takes less time.
  bool is_outside(const Vector<Dim>& point) const;

 private:
  bool is_on_cage(const Vector<Dim>& point) const;
  bool is_enclosed(const Vector<Dim>& point) const;

  Cage<Dim> cage_;
  std::vector<Index> shell_of_facet_;
  Index num_shells_ = 0;
  double tolerance_ = 0;
};

//! Distance from a point to an edge (2D) or a triangle (3D), which may be degenerate.
//! \param corners  of the facet, one per column
template <int Dim>
double distance_to_facet(const Vector<Dim>& point, const Eigen::Matrix<double, Dim, Dim>& corners);
template <>
double distance_to_facet<2>(const Vector<2>& point, const Eigen::Matrix2d& corners);
template <>
double distance_to_facet<3>(const Vector<3>& point, const Eigen::Matrix3d& corners);

}  // namespace flbc
