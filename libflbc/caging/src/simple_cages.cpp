// SPDX-License-Identifier: BSD-3-Clause
#include "caging/simple_cages.h"

namespace flbc {

namespace {

template <int Dim>
Cage<Dim> box_cage(const Vector<Dim>& low, const Vector<Dim>& high) {
  Cage<Dim> cage;
  if constexpr (Dim == 2) {
    cage.points.resize(2, 4);
    cage.points << low.x(), high.x(), high.x(), low.x(),  //
        low.y(), low.y(), high.y(), high.y();
    cage.facets.resize(2, 4);
    cage.facets << 0, 1, 2, 3, 1, 2, 3, 0;
  } else {
    // Corner k has the upper coordinate of axis i where bit i of k is set.
    cage.points.resize(3, 8);
    for (int k = 0; k < 8; ++k) {
      for (int i = 0; i < 3; ++i) cage.points(i, k) = (k >> i) % 2 == 0 ? low(i) : high(i);
    }
    cage.facets.resize(3, 12);
    cage.facets << 0, 3, 4, 7, 0, 5, 2, 7, 0, 6, 1, 7,  //
        2, 1, 5, 6, 1, 4, 6, 3, 4, 2, 3, 5,             //
        1, 2, 6, 5, 4, 1, 3, 6, 2, 4, 5, 3;
  }
  return cage;
}

// A corner with edges along the axes, as long as it takes for the box to fit.
template <int Dim>
Cage<Dim> simplex_cage(const Vector<Dim>& low, const Vector<Dim>& high) {
  Cage<Dim> cage{low.replicate(1, Dim + 1), FacetList<Dim>(Dim, Dim + 1)};
  for (int k = 0; k < Dim; ++k) cage.points(k, k + 1) += Dim * 1.01 * (high(k) - low(k));
  if constexpr (Dim == 2) {
    cage.facets << 0, 1, 2, 1, 2, 0;
  } else {
    cage.facets << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
  }
  return cage;
}

}  // namespace

template <int Dim>
std::vector<Cage<Dim>> simple_cages(const Eigen::AlignedBox<double, Dim>& around, double offset) {
  const Vector<Dim> low = around.min().array() - offset, high = around.max().array() + offset;
  return {box_cage<Dim>(low, high), simplex_cage<Dim>(low, high)};
}

template std::vector<Cage<2>> simple_cages(const Eigen::AlignedBox<double, 2>&, double);
template std::vector<Cage<3>> simple_cages(const Eigen::AlignedBox<double, 3>&, double);

}  // namespace flbc
