// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/pointwise.h"

#include "base/instantiate.h"
#include "base/parallel.h"
#include "cage/facet_locator.h"
#include "cage/oriented_cage.h"
#include "coordinates/points_in_cage.h"
#include "coordinates/seen_facet.h"
#include "flbc/bounding_box.h"

namespace flbc {

template <int Dim>
WeightMatrix mean_value_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points) {
  check_finite<Dim>(points);
  const double size = bounding_box_diagonal(cage.points);
  const auto oriented = orient(cage).cage;
  const auto facets = see_facets(oriented, size);
  const FacetLocator<Dim> locator(oriented, kOnCage * size);

  WeightMatrix weights = WeightMatrix::Zero(cage.size(), points.cols());
  const auto add = [&](Index point, std::size_t facet, const Vector<Dim>& share) {
    for (int k = 0; k < Dim; ++k) weights(oriented.facets(k, facet), point) += share[k];
  };
  const auto num_points = static_cast<Index>(points.cols());
  parallel_for(num_points, [&](Index p) {
    const Vector<Dim> x = points.col(p);
    const auto place = locator.locate(x);
    if (place.facet >= 0) {
      add(p, place.facet, place.coordinates);
      return;
    }
    for (std::size_t f = 0; f < facets.size(); ++f) add(p, f, facets[f].share(x));
    weights.col(p) /= weights.col(p).sum();
  });
  return weights;
}

FLBC_INSTANTIATE_FUNCTION(mean_value_coordinates)

}  // namespace flbc
