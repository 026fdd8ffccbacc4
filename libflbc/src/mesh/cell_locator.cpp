// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "flbc/bounding_box.h"
#include "flbc/cell_locator.h"
#include "flbc/errors.h"
#include "mesh/cell_geometry.h"
#include "mesh/check_place.h"
#include "mesh/vertex_cells.h"

namespace flbc {

// A uniform grid; each box lists the cells that meet it, ascending.
template <int Dim>
struct CellLocator<Dim>::Grid {
  using Box = Eigen::Matrix<Index, Dim, 1>;

  // What a search reads of a cell, in one place.
  struct Cell {
    Vector<Dim> origin;                         // the first corner
    Eigen::Matrix<double, Dim, Dim> gradients;  // of the hat functions of the other corners
    Vector<Dim + 1> lengths;                    // of the gradients of all hat functions

    Cell(const DomainMesh<Dim>& mesh, Index cell) : origin(mesh.points.col(mesh.cells(0, cell))) {
      const auto all = cell_geometry(mesh, cell).hat_gradients;
      gradients = all.template rightCols<Dim>();
      lengths = all.colwise().norm().transpose();
    }

    Vector<Dim> first_gradient() const { return -gradients.rowwise().sum(); }

    Vector<Dim + 1> coordinates(const Vector<Dim>& point) const {
      const Vector<Dim> offset = point - origin;
      Vector<Dim + 1> result;
      result[0] = first_gradient().dot(offset) + 1;
      result.template tail<Dim>() = gradients.transpose() * offset;
      return result;
    }
  };

  Vector<Dim> low;
  double width, boxes_per_length;
  Box count;
  VertexItems<Index, std::size_t> cells_of_box;
  std::vector<Cell> cells;

  Grid(const DomainMesh<Dim>& mesh, double boxes_per_cell) {
    validate(mesh);
    low = mesh.points.rowwise().minCoeff();
    const Vector<Dim> extent = mesh.points.rowwise().maxCoeff() - low;
    // The product of the extents may overflow.
    width =
        std::exp((extent.array().log().sum() - std::log(boxes_per_cell * mesh.num_cells())) / Dim);
    // Boxes of mean cell size would be too many if the domain is flat.
    const auto num_boxes = [&] { return ((extent / width).array() + 1).prod(); };
    while (num_boxes() > 8 * boxes_per_cell * mesh.num_cells() + 64) width *= 2;
    boxes_per_length = 1 / width;
    count = (extent * boxes_per_length).template cast<Index>().array() + 1;
    cells.reserve(mesh.num_cells());
    for (Index s = 0; s < mesh.num_cells(); ++s) cells.emplace_back(mesh, s);
    cells_of_box = items_by_vertex<Index, std::size_t>(
        static_cast<std::size_t>(count.template cast<double>().prod()), [&](const auto& visit) {
          for (Index s = 0; s < mesh.num_cells(); ++s) {
            for_boxes_of(mesh, s, [&](std::size_t box) { visit(box, s); });
          }
        });
  }

  // Points outside are moved into the outermost boxes.
  Box box_of(const Vector<Dim>& point) const {
    const Vector<Dim> place =
        ((point - low) * boxes_per_length).cwiseMax(0.0).cwiseMin(count.template cast<double>());
    return place.template cast<Index>().cwiseMin((count.array() - 1).matrix());
  }

  std::size_t number_of(const Box& box) const {
    std::size_t number = 0;
    for (int d = Dim - 1; d >= 0; --d) number = number * count[d] + box[d];
    return number;
  }

  // The boxes that the cell meets, and maybe some next to its edges.
  template <class Visit>
  void for_boxes_of(const DomainMesh<Dim>& mesh, Index cell, const Visit& visit) const {
    const Eigen::Matrix<double, Dim, Dim + 1> corners =
        mesh.points(Eigen::all, mesh.cells.col(cell));
    // How much each coordinate grows from the center of a box to its corners, with some room for
    // rounding.
    Vector<Dim + 1> growth;
    growth[0] = cells[cell].first_gradient().cwiseAbs().sum();
    growth.template tail<Dim>() = cells[cell].gradients.cwiseAbs().colwise().sum().transpose();
    growth *= 0.51 * width;
    for_boxes_between(box_of(corners.rowwise().minCoeff()), box_of(corners.rowwise().maxCoeff()),
                      [&](const Box& box) {
                        const Vector<Dim> center =
                            low + width * (box.template cast<double>().array() + 0.5).matrix();
                        if (((cells[cell].coordinates(center) + growth).array() >= 0).all())
                          visit(number_of(box));
                      });
  }

  template <class Visit>
  void for_boxes_between(const Box& first, const Box& last, const Visit& visit) const {
    Box box = first;
    while (box[Dim - 1] <= last[Dim - 1]) {
      visit(box);
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
CellLocator<Dim>::CellLocator(const DomainMesh<Dim>& mesh, double boxes_per_cell)
    : grid_(std::make_unique<Grid>(mesh, boxes_per_cell)) {
}

template <int Dim>
CellLocator<Dim>::~CellLocator() = default;

template <int Dim>
Location<Dim> CellLocator<Dim>::locate(const Vector<Dim>& point, double tolerance) const {
  Location<Dim> best;
  if (!point.allFinite() || !(tolerance >= 0)) return best;
  double least_outside = tolerance;
  const auto consider = [&](Index number) {
    if (best.cell >= 0 && least_outside == 0) return;  // found
    const auto& cell = grid_->cells[number];
    const auto coordinates = cell.coordinates(point);
    if ((coordinates + tolerance * cell.lengths).minCoeff() < 0) return;
    // Multiplied by the heights over the facets, which are the inverse lengths.
    const double outside = std::max(0.0, -(coordinates.array() / cell.lengths.array()).minCoeff());
    if (outside < least_outside || (best.cell < 0 && outside <= tolerance)) {
      least_outside = outside;
      best = {number, coordinates};
    }
  };
  const Vector<Dim> margin = Vector<Dim>::Constant(tolerance);
  grid_->for_boxes_between(
      grid_->box_of(point - margin), grid_->box_of(point + margin), [&](const auto& box) {
        for (const Index cell : grid_->cells_of_box.of(grid_->number_of(box))) {
          consider(cell);
        }
      });
  return best;
}

template <int Dim>
std::vector<Location<Dim>> locate_points(const DomainMesh<Dim>& mesh,
                                         const PointList<Dim>& points) {
  check_finite<Dim>(points);
  const double tolerance = kBoundaryTolerance * bounding_box_diagonal(mesh.points);
  const CellLocator<Dim> locator(mesh);
  const auto num_points = static_cast<Index>(points.cols());
  std::vector<Location<Dim>> places(num_points);
  parallel_for(num_points, [&](Index p) { places[p] = locator.locate(points.col(p), tolerance); });

  const auto outside = [](const Location<Dim>& place) { return place.cell < 0; };
  const auto first = std::find_if(places.begin(), places.end(), outside);
  if (first != places.end()) {
    const auto p = static_cast<Index>(first - places.begin());
    throw InputError(std::to_string(std::count_if(first, places.end(), outside)) + " of " +
                     std::to_string(num_points) +
                     " points are outside the cage; the first is point " + std::to_string(p) +
                     " at " + format_point(points.col(p)));
  }
  return places;
}

template <int Dim>
SparseWeights interpolate(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                          const std::vector<Location<Dim>>& places) {
  return SparseWeights::of(weights.num_control_points(), static_cast<Index>(places.size()),
                           [&](Index p) { return interpolate(mesh, weights, places[p]); });
}

template <int Dim>
Eigen::VectorXd interpolate(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                            const Location<Dim>& place) {
  check_place(mesh, weights.num_points(), place);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(weights.num_control_points());
  for (int k = 0; k <= Dim; ++k) {
    const double factor = place.coordinates[k];
    weights.visit(mesh.cells(k, place.cell),
                  [&](Index i, double weight) { result[i] += factor * weight; });
  }
  return result;
}

template class CellLocator<2>;
template class CellLocator<3>;
FLBC_INSTANTIATE_FUNCTION(locate_points)
#define FLBC_INSTANTIATE(Dim)                                                        \
  template SparseWeights interpolate(const DomainMesh<Dim>&, const SparseWeights&,   \
                                     const std::vector<Location<Dim>>&);             \
  template Eigen::VectorXd interpolate(const DomainMesh<Dim>&, const SparseWeights&, \
                                       const Location<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
