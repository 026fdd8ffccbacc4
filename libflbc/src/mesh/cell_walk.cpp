// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/cell_walk.h"

#include <algorithm>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "flbc/bounding_box.h"
#include "mesh/cell_geometry.h"

namespace flbc {
namespace {

constexpr Index kBlock = 1024;  // points per walk

template <int Dim>
class Walk {
 public:
  Walk(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology)
      : mesh_(mesh), topology_(topology), geometries_(mesh.num_cells()) {
    parallel_for(mesh.num_cells(), [&](Index s) { geometries_[s] = cell_geometry(mesh, s); });
  }

  //! \return cell -1 if the walk ends at the boundary or is too long
  Location<Dim> go(const Vector<Dim>& point, Index cell) const {
    constexpr int kLongest = 100;
    constexpr double kRounding = 1e-12;
    Location<Dim> place;
    for (int step = 0; step < kLongest; ++step) {
      place.cell = cell;
      place.coordinates = geometries_[cell].hat_gradients.transpose() *
                          (point - mesh_.points.col(mesh_.cells(0, cell)));
      place.coordinates[0] += 1;
      if (place.coordinates.minCoeff() >= -kRounding) return place;
      cell = beyond(place);
      if (cell < 0) break;
    }
    place.cell = -1;
    return place;
  }

 private:
  // The neighbor across the facet that the point violates most.
  Index beyond(const Location<Dim>& place) const {
    Index next = -1;
    double farthest = 0;
    for (int k = 0; k <= Dim; ++k) {
      const Index facet = topology_.cell_facets(k, place.cell);
      if (place.coordinates[k] >= 0 || topology_.is_boundary(facet)) continue;
      const double distance =
          -place.coordinates[k] / geometries_[place.cell].hat_gradients.col(k).norm();
      if (distance <= farthest) continue;
      farthest = distance;
      next = topology_.sides(0, facet) + topology_.sides(1, facet) - place.cell;
    }
    return next;
  }

  const DomainMesh<Dim>& mesh_;
  const MeshTopology<Dim>& topology_;
  std::vector<CellGeometry<Dim>> geometries_;
};

}  // namespace

template <int Dim>
std::vector<Location<Dim>> walk_to_points(const DomainMesh<Dim>& mesh,
                                          const MeshTopology<Dim>& topology,
                                          const PointList<Dim>& points) {
  const double tolerance = 1e-6 * bounding_box_diagonal(mesh.points);
  const CellLocator<Dim> locator(mesh);
  const Walk<Dim> walk(mesh, topology);
  const auto count = static_cast<Index>(points.cols());
  std::vector<Location<Dim>> places(count);
  parallel_for_chunks((count + kBlock - 1) / kBlock, 1, [&](Index block) {
    Index cell = -1;
    for (Index p = block * kBlock; p < std::min(count, (block + 1) * kBlock); ++p) {
      if (cell >= 0) places[p] = walk.go(points.col(p), cell);
      if (places[p].cell < 0) places[p] = locator.locate(points.col(p), tolerance);
      cell = places[p].cell;
    }
  });
  const auto is_outside = [](const Location<Dim>& place) { return place.cell < 0; };
  const bool complete = std::none_of(places.begin(), places.end(), is_outside);
  if (!complete) places = locate_points(mesh, points);  // throws, naming points outside
  for (auto& place : places) {
    place.coordinates = place.coordinates.cwiseMax(0);
    place.coordinates /= place.coordinates.sum();
  }
  return places;
}

FLBC_INSTANTIATE_FUNCTION(walk_to_points)

}  // namespace flbc
