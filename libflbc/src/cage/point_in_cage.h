// SPDX-License-Identifier: BSD-3-Clause
// Is a point inside a cage? Holes and cavities are outside.
#pragma once

#include <vector>

#include "flbc/cage.h"

namespace flbc {

enum class Containment { kInside, kOutside, kOnCage };

//! Connected component of each facet: loops in 2D, shells in 3D, numbered from 0 in the order of
//! their first facets.
template <int Dim>
std::vector<Index> facet_shells(const Cage<Dim>& cage);

//! Locates points with respect to a cage that has passed validate(). A point is inside if an odd
//! number of loops or shells enclose it, whatever their orientation. Takes time proportional to the
//! number of facets.
template <int Dim>
class CageLocator {
 public:
  //! \param tolerance  a point no farther than this from a facet is on the cage
  CageLocator(const Cage<Dim>& cage, double tolerance);

  Containment locate(const Vector<Dim>& point) const;

 private:
  bool is_on_cage(const Vector<Dim>& point) const;
  bool is_enclosed(const Vector<Dim>& point) const;

  Cage<Dim> cage_;
  std::vector<Index> shell_of_facet_;
  Index num_shells_ = 0;
  double tolerance_ = 0;
};

}  // namespace flbc
