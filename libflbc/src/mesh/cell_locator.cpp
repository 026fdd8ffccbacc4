// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/instantiate.h"
#include "base/messages.h"
#include "flbc/bounding_box.h"
#include "flbc/cell_locator.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"
#include "mesh/vertex_cells.h"

namespace flbc {

// A uniform grid with about one cell of the mesh per box; each box lists the cells whose bounding
// box meets it.
template <int Dim>
struct CellLocator<Dim>::Grid {
  using Box = Eigen::Matrix<Index, Dim, 1>;

  Vector<Dim> low;
  double width;
  Box count;
  VertexItems<Index, std::size_t> cells;                           // of every box
  std::vector<Eigen::Matrix<double, Dim, Dim + 1>> hat_gradients;  // of every cell

  explicit Grid(const DomainMesh<Dim>& mesh) {
    low = mesh.points.rowwise().minCoeff();
    const Vector<Dim> extent = mesh.points.rowwise().maxCoeff() - low;
    width = std::pow(extent.prod() / mesh.num_cells(), 1.0 / Dim);
    // Boxes of mean cell size would be too many if the domain is flat.
    const auto num_boxes = [&] { return ((extent / width).array() + 1).prod(); };
    while (num_boxes() > 8.0 * mesh.num_cells() + 64) width *= 2;
    count = (extent / width).template cast<Index>().array() + 1;
    cells = items_by_vertex<Index, std::size_t>(
        static_cast<std::size_t>(count.template cast<double>().prod()), [&](const auto& visit) {
          for (Index s = 0; s < mesh.num_cells(); ++s) {
            for_boxes_of(mesh, s, [&](std::size_t box) { visit(box, s); });
          }
        });
    hat_gradients.reserve(mesh.num_cells());
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      hat_gradients.push_back(cell_geometry(mesh, s).hat_gradients);
    }
  }

  // Points outside are moved into the outermost boxes.
  Box box_of(const Vector<Dim>& point) const {
    const Vector<Dim> place =
        ((point - low) / width).cwiseMax(0.0).cwiseMin(count.template cast<double>());
    return place.template cast<Index>().cwiseMin((count.array() - 1).matrix());
  }

  std::size_t number_of(const Box& box) const {
    std::size_t number = 0;
    for (int d = Dim - 1; d >= 0; --d) number = number * count[d] + box[d];
    return number;
  }

  template <class Visit>
  void for_boxes_of(const DomainMesh<Dim>& mesh, Index cell, const Visit& visit) const {
    const Eigen::Matrix<double, Dim, Dim + 1> corners =
        mesh.points(Eigen::all, mesh.cells.col(cell));
    for_boxes_between(box_of(corners.rowwise().minCoeff()), box_of(corners.rowwise().maxCoeff()),
                      visit);
  }

  template <class Visit>
  void for_boxes_between(const Box& first, const Box& last, const Visit& visit) const {
    Box box = first;
    while (box[Dim - 1] <= last[Dim - 1]) {
      visit(number_of(box));
      int d = 0;
      while (d < Dim - 1 && box[d] == last[d]) {
        box[d] = first[d];
        ++d;
      }
      ++box[d];
    }
  }
};

template <int Dim>
CellLocator<Dim>::CellLocator(const DomainMesh<Dim>& mesh)
    : mesh_(mesh), grid_(std::make_unique<Grid>(mesh)) {
}

template <int Dim>
CellLocator<Dim>::~CellLocator() = default;

template <int Dim>
Location<Dim> CellLocator<Dim>::locate(const Vector<Dim>& point, double tolerance) const {
  Location<Dim> best;
  double least_outside = tolerance;
  const Vector<Dim> margin = Vector<Dim>::Constant(tolerance);
  const auto consider = [&](Index cell) {
    if (best.cell >= 0 && least_outside == 0) return;  // found
    const auto& hat_gradients = grid_->hat_gradients[cell];
    Location<Dim> location;
    location.cell = cell;
    location.coordinates =
        hat_gradients.transpose() * (point - mesh_.points.col(mesh_.cells(0, cell)));
    location.coordinates[0] += 1;
    const double outside = distance_beyond<Dim>(location.coordinates, hat_gradients);
    if (outside < least_outside || (best.cell < 0 && outside <= tolerance)) {
      least_outside = outside;
      best = location;
    }
  };
  grid_->for_boxes_between(grid_->box_of(point - margin), grid_->box_of(point + margin),
                           [&](std::size_t box) {
                             for (const Index cell : grid_->cells.of(box)) consider(cell);
                           });
  return best;
}

template <int Dim>
std::vector<Location<Dim>> locate_points(const DomainMesh<Dim>& mesh,
                                         const PointList<Dim>& points) {
  const double tolerance = kBoundaryTolerance * bounding_box_diagonal(mesh.points);
  const CellLocator<Dim> locator(mesh);
  const auto num_points = static_cast<Index>(points.cols());
  std::vector<Location<Dim>> places(num_points);
#pragma omp parallel for schedule(static)
  for (Index p = 0; p < num_points; ++p) places[p] = locator.locate(points.col(p), tolerance);

  const auto outside = [](const Location<Dim>& place) { return place.cell < 0; };
  const auto first = std::find_if(places.begin(), places.end(), outside);
  if (first != places.end()) {
    const auto p = static_cast<Index>(first - places.begin());
    throw InputError(std::to_string(std::count_if(first, places.end(), outside)) + " of " +
                     std::to_string(num_points) +
                     " points are outside the cage; the first is vertex " + std::to_string(p) +
                     " at " + format_point(points.col(p)));
  }
  return places;
}

template class CellLocator<2>;
template class CellLocator<3>;
FLBC_INSTANTIATE_FUNCTION(locate_points)

}  // namespace flbc
