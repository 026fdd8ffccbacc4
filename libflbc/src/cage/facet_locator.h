// SPDX-License-Identifier: BSD-3-Clause
// Which facet of a cage a point lies on, and where.
#pragma once

#include <limits>
#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! A place on a cage.
template <int Dim>
struct FacetPlace {
  Index facet = -1;
  Vector<Dim> coordinates;                                    //!< in the facet, >= 0, sum to 1
  double distance = std::numeric_limits<double>::infinity();  //!< of the point from the place
};

//! Finds points that lie on a cage up to rounding. Takes time proportional to the number of facets,
//! though only few operations for facets that are not near.
template <int Dim>
class FacetLocator {
 public:
  //! \param tolerance  largest distance from the cage, in its units; small against its facets
  FacetLocator(const Cage<Dim>& cage, double tolerance);

  //! The nearest place, of equally near ones that on the facet with the least number. \return facet
  //! -1 if the point is farther away than the tolerance
  FacetPlace<Dim> locate(const Vector<Dim>& point) const;

  //! The same whatever its distance, among facets in whose boxes the point is, widened by the
  //! tolerance. \return facet -1 if it is in none
  FacetPlace<Dim> nearest(const Vector<Dim>& point) const;

 private:
  struct Facet {
    Vector<Dim> low, high;  // bounding box, widened by the tolerance
    Eigen::Matrix<double, Dim, Dim> corners;
    Eigen::Matrix<double, Dim - 1, Dim> to_coordinates;  // pseudo-inverse of the edge vectors
  };
  std::vector<Facet> facets_;
  double tolerance_;
};

}  // namespace flbc
