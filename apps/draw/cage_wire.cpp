// SPDX-License-Identifier: BSD-3-Clause
#include "draw/cage_wire.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace flbc::draw {
namespace {

constexpr Color kWire{0.30F, 0.33F, 0.39F};
constexpr Color kShellShade{0.87F, 0.89F, 0.925F};
constexpr Color kShellLight{0.965F, 0.97F, 0.98F};

// Facets whose normals differ by less than about 3 degrees are in one plane to the eye.
constexpr double kFlatCosine = 0.9986;

// Unit normals of the facets that point out of the cage, whatever the orientation of the facets.
PointList<3> outer_normals(const Cage<3>& cage) {
  const Vector<3> center = cage.points.rowwise().mean();
  PointList<3> normals(3, cage.facets.cols());
  double volume = 0;
  for (Eigen::Index f = 0; f < cage.facets.cols(); ++f) {
    const Vector<3> a = cage.points.col(cage.facets(0, f));
    const Vector<3> b = cage.points.col(cage.facets(1, f));
    const Vector<3> c = cage.points.col(cage.facets(2, f));
    const Vector<3> normal = (b - a).cross(c - a);
    volume += normal.dot(a - center);
    normals.col(f) = normal.normalized();
  }
  return volume < 0 ? PointList<3>(-normals) : normals;
}

struct EdgeLook {
  bool front = false;
  double smallest_cosine = 1;  // between the facets at the edge
  Vector<3> first_normal = Vector<3>::Zero();
};

// In the order of the vertices, so that the picture does not depend on chance.
using Edges = std::map<std::pair<Index, Index>, EdgeLook>;

Edges find_edges(const Scene& scene) {
  const PointList<3> normals = outer_normals(scene.cage);
  Edges edges;
  for (Eigen::Index f = 0; f < scene.cage.facets.cols(); ++f) {
    const Vector<3> normal = normals.col(f);
    for (int k = 0; k < 3; ++k) {
      const auto key = std::minmax({scene.cage.facets(k, f), scene.cage.facets((k + 1) % 3, f)});
      EdgeLook& edge = edges[key];
      edge.front = edge.front || normal.dot(scene.view.toward) > 0;
      if (edge.first_normal.isZero(0)) edge.first_normal = normal;
      edge.smallest_cosine = std::min(edge.smallest_cosine, edge.first_normal.dot(normal));
    }
  }
  return edges;
}

std::vector<Segment>& layer_of(const EdgeLook& edge, WireSlab& slab) {
  if (!edge.front) return slab.back;
  return edge.smallest_cosine > kFlatCosine ? slab.flat : slab.front;
}

}  // namespace

std::vector<WireSlab> cut_wire(const Scene& scene) {
  std::vector<WireSlab> slabs(scene.slices.size() + 1);
  for (const auto& [ends, look] : find_edges(scene)) {
    const Vector<3> a = scene.cage.points.col(ends.first);
    const Vector<3> b = scene.cage.points.col(ends.second);
    std::vector<double> cuts{0, 1};
    for (const Slice& slice : scene.slices) {
      const double at_a = slice.plane.distance(a);
      const double at_b = slice.plane.distance(b);
      if ((at_a < 0) != (at_b < 0)) cuts.push_back(at_a / (at_a - at_b));
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Vector<3> middle = a + (cuts[k] + cuts[k + 1]) / 2 * (b - a);
      const auto passed =
          std::count_if(scene.slices.begin(), scene.slices.end(),
                        [&](const Slice& slice) { return slice.plane.distance(middle) >= 0; });
      layer_of(look, slabs[passed])
          .push_back({scene.pixel(a + cuts[k] * (b - a)), scene.pixel(a + cuts[k + 1] * (b - a))});
    }
  }
  return slabs;
}

void paint_wire(Canvas& canvas, const WireSlab& slab, double unit) {
  // One colour, more or less transparent, so that the wire never brightens what it crosses.
  canvas.draw_segments(slab.back, 1.1 * unit, kWire, 0.27F);
  canvas.draw_segments(slab.flat, 1.0 * unit, kWire, 0.2F);
  canvas.draw_segments(slab.front, 1.3 * unit, kWire, 0.5F);
}

void paint_shell(Canvas& canvas, const Scene& scene) {
  const PointList<3> normals = outer_normals(scene.cage);
  for (Eigen::Index f = 0; f < scene.cage.facets.cols(); ++f) {
    const double away = -normals.col(f).dot(scene.view.toward);
    if (!(away > 0)) continue;
    const auto corner = [&](int k) {
      return scene.pixel(scene.cage.points.col(scene.cage.facets(k, f)));
    };
    canvas.fill_triangle({corner(0), corner(1), corner(2)},
                         mix(kShellShade, kShellLight, static_cast<float>(away)));
  }
}

}  // namespace flbc::draw
