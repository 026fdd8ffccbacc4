// SPDX-License-Identifier: BSD-3-Clause
#include "draw/scene.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "draw/weight_painter.h"

namespace flbc::draw {
namespace {

constexpr Color kWire{0.30F, 0.33F, 0.39F};
constexpr Color kShellShade{0.87F, 0.89F, 0.925F};
constexpr Color kShellLight{0.965F, 0.97F, 0.98F};
constexpr Color kModelSection{0.55F, 0.36F, 0.20F};
constexpr Color kModelShade{0.72F, 0.66F, 0.60F};
constexpr Color kModelLight{0.93F, 0.88F, 0.83F};

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

// Edges of the cage between two neighboring slices or beyond the last one, on the canvas.
struct WireSlab {
  std::vector<Segment> front;  // edges at facets that face the eye
  std::vector<Segment> flat;   // those of them between facets in one plane
  std::vector<Segment> back;   // edges at the far side
};

std::vector<Segment>& layer_of(const EdgeLook& edge, WireSlab& slab) {
  if (!edge.front) return slab.back;
  return edge.smallest_cosine > kFlatCosine ? slab.flat : slab.front;
}

// Slab k is before slice k, the last one behind all slices, along the normal of the slices.
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
  // One color, more or less transparent, so that the wire never brightens what it crosses.
  canvas.draw_segments(slab.back, 1.1 * unit, kWire, 0.27F);
  canvas.draw_segments(slab.flat, 1.0 * unit, kWire, 0.2F);
  canvas.draw_segments(slab.front, 1.3 * unit, kWire, 0.5F);
}

// A surface of flat facets, each of one color by its angle to the eye.
Raster paint_facets(Canvas& canvas, const Scene& scene, const Cage<3>& surface, bool only_far_side,
                    Color shade, Color light) {
  const auto& points = surface.points;
  PointList<2> pixels(2, points.cols());
  for (Eigen::Index p = 0; p < points.cols(); ++p) pixels.col(p) = scene.pixel(points.col(p));
  const Eigen::VectorXd nearness = points.transpose() * scene.view.toward;
  const PointList<3> normals = outer_normals(surface);
  Raster raster = canvas.raster_for(pixels);
  for (Eigen::Index f = 0; f < surface.facets.cols(); ++f) {
    const double front = normals.col(f).dot(scene.view.toward);
    if (only_far_side && !(front < 0)) continue;
    const auto c = surface.facets.col(f);
    const Color color = mix(shade, light, static_cast<float>(std::abs(front)));
    raster.fill({pixels.col(c[0]), pixels.col(c[1]), pixels.col(c[2])},
                {nearness[c[0]], nearness[c[1]], nearness[c[2]]},
                [&](double, double, double) { return color; });
  }
  canvas.draw_raster(raster);
  return raster;
}

}  // namespace

void paint_slice(Canvas& canvas, const Slice& slice,
                 const std::function<Vector<2>(const Vector<2>&)>& pixel, double unit,
                 const WeightPictureOptions& options) {
  PointList<2> points(2, slice.mesh.num_vertices());
  for (Index v = 0; v < slice.mesh.num_vertices(); ++v) {
    points.col(v) = pixel(slice.mesh.points.col(v));
  }
  paint_weight(canvas, points, slice.mesh.cells, slice.values, options);
  const auto on_canvas = [&](const std::vector<Segment>& segments) {
    std::vector<Segment> lines;
    for (const Segment& segment : segments) lines.push_back({pixel(segment.a), pixel(segment.b)});
    return lines;
  };
  canvas.draw_segments(on_canvas(slice.section), 2 * unit, kModelSection);
  canvas.draw_segments(on_canvas(slice.outline), 2.2 * unit, kInk);
}

Raster paint_scene(Canvas& canvas, const Scene& scene) {
  // The far side from inside lets the shape of the cage be guessed.
  paint_facets(canvas, scene, scene.cage, true, kShellShade, kShellLight);
  static const Cage<3> kNoModel;
  Raster model = paint_facets(canvas, scene, scene.model != nullptr ? *scene.model : kNoModel,
                              false, kModelShade, kModelLight);
  const auto slabs = cut_wire(scene);
  const int count = static_cast<int>(scene.slices.size());
  const bool ascending = scene.slices.front().plane.normal.dot(scene.view.toward) > 0;
  for (int k = 0; k <= count; ++k) {
    paint_wire(canvas, slabs[ascending ? k : count - k], scene.unit);
    if (k == count) break;
    const Slice& slice = scene.slices[ascending ? k : count - 1 - k];
    paint_slice(
        canvas, slice, [&](const Vector<2>& p) { return scene.pixel(slice.plane.to_space(p)); },
        scene.unit, scene.options);
  }
  return model;
}

}  // namespace flbc::draw
