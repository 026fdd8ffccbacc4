// SPDX-License-Identifier: BSD-3-Clause
// Locates points on the facets of a cage.
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
  double distance = std::numeric_limits<double>::infinity();  //!< between the point and the place
};

//! Finds points that lie on a cage up to rounding. Time is proportional to the number of facets,
//! with few operations for distant facets.
template <int Dim>
class FacetLocator {
 public:
  //! \param tolerance  maximum distance from the cage, in its units; small compared to its facets
  FacetLocator(const Cage<Dim>& cage, double tolerance);

  //! The nearest place; ties go to the facet with the smallest index. \return facet -1 if the point
  //! is farther away than the tolerance
  FacetPlace<Dim> locate(const Vector<Dim>& point) const;

  //! The same for any distance, among the facets whose box, enlarged by the tolerance, contains the
  //! point. \return facet -1 if there is none
  FacetPlace<Dim> nearest(const Vector<Dim>& point) const;

 private:
  struct Facet {
    Vector<Dim> low, high;                    // bounding box, enlarged by the tolerance
    Vector<Dim> origin;                       // the first corner
    Eigen::Matrix<double, Dim, Dim> corners;  // relative to it, so that cages far away keep digits
    Eigen::Matrix<double, Dim - 1, Dim> to_coordinates;  // pseudo-inverse of the edge vectors
  };
  std::vector<Facet> facets_;
  double tolerance_;
};

}  // namespace flbc
