// SPDX-License-Identifier: BSD-3-Clause
#include "draw/model_painter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "draw/colormap.h"
#include "draw/weight_painter.h"

namespace flbc::draw {
namespace {

constexpr Color kPlain{0.70F, 0.76F, 0.84F};
constexpr float kHiddenOpacity = 0.22F;

// How near the nearest surface is at every sample of a canvas.
class DepthBuffer {
 public:
  explicit DepthBuffer(const Canvas& canvas)
      : supersampling_(canvas.supersampling()),
        width_(canvas.width() * supersampling_),
        height_(canvas.height() * supersampling_),
        nearest_(static_cast<std::size_t>(width_) * height_,
                 -std::numeric_limits<float>::infinity()) {}

  // Whether it is nearer than all before; then it is the nearest.
  bool is_nearer(int x, int y, double nearness) {
    float& nearest = nearest_[static_cast<std::size_t>(y) * width_ + x];
    if (!(static_cast<float>(nearness) > nearest)) return false;
    nearest = static_cast<float>(nearness);
    return true;
  }

  // \param pixel  in pixels of the canvas
  bool is_hidden(const Vector<2>& pixel, double nearness) const {
    const int x = static_cast<int>(std::floor(pixel.x() * supersampling_));
    const int y = static_cast<int>(std::floor(pixel.y() * supersampling_));
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
    return static_cast<double>(nearest_[static_cast<std::size_t>(y) * width_ + x]) > nearness;
  }

 private:
  int supersampling_;
  int width_;
  int height_;
  std::vector<float> nearest_;
};

Vector<2> pixel_of(const ModelScene& scene, const Vector<3>& place) {
  return scene.map(Vector<2>(scene.view.project(place) + scene.shift));
}

// Sums of the triangles' normals, in the coordinates of the view.
PointList<3> normals_in_view(const ModelScene& scene) {
  const auto& points = scene.place.points;
  PointList<3> normals = PointList<3>::Zero(3, points.cols());
  for (const auto& t : scene.model.triangles.colwise()) {
    const Vector<3> a = points.col(t[0]);
    const Vector<3> u = points.col(t[1]) - a;
    const Vector<3> v = points.col(t[2]) - a;
    const Vector<3> normal = u.cross(v);
    for (const Index k : t) normals.col(k) += normal;
  }
  Eigen::Matrix3d to_view;
  to_view << scene.view.right.transpose(), scene.view.up.transpose(), scene.view.toward.transpose();
  normals = (to_view * normals).eval();
  for (auto normal : normals.colwise()) normal.stableNormalize();
  return normals;
}

// Brightness of a surface seen from its front or its back.
double light_on(const Vector<3>& normal) {
  static const Vector<3> lamp = Vector<3>(-0.35, 0.55, 0.75).normalized();
  const double size = normal.norm();
  if (size == 0) return 1;
  const double sign = normal.z() < 0 ? -1 : 1;
  const Vector<3> front = sign / size * normal;
  return std::min(1.0, 0.34 + 0.46 * std::max(0.0, front.dot(lamp)) + 0.26 * front.z());
}

void paint_surface(Canvas& canvas, DepthBuffer& depths, const ModelScene& scene) {
  const auto& points = scene.place.points;
  const PointList<3> normals = normals_in_view(scene);
  const Eigen::VectorXd nearness = points.transpose() * scene.view.toward;
  PointList<2> pixels(2, points.cols());
  for (Eigen::Index p = 0; p < points.cols(); ++p) pixels.col(p) = pixel_of(scene, points.col(p));
  for (const auto& t : scene.model.triangles.colwise()) {
    const Index a = t[0], b = t[1], c = t[2];
    canvas.paint_samples({pixels.col(a), pixels.col(b), pixels.col(c)}, [&](int x, int y, double b1,
                                                                            double b2,
                                                                            Color& sample) {
      const double b0 = 1 - b1 - b2;
      if (!depths.is_nearer(x, y, b0 * nearness[a] + b1 * nearness[b] + b2 * nearness[c])) {
        return;
      }
      const Color color =
          scene.values.size() == 0
              ? kPlain
              : weight_color(b0 * scene.values[a] + b1 * scene.values[b] + b2 * scene.values[c]);
      const Vector<3> normal = b0 * normals.col(a) + b1 * normals.col(b) + b2 * normals.col(c);
      sample = mix({0, 0, 0}, color, static_cast<float>(light_on(normal)));
    });
  }
}

// The wire, cut where it passes behind the surface.
struct CutWire {
  std::vector<Segment> visible{};
  std::vector<Segment> hidden{};
};

CutWire cut_wire(const DepthBuffer& depths, const ModelScene& scene) {
  constexpr double kPiece = 2;  // pixels
  CutWire wire;
  for (const auto& [i, j] : scene.model.cage_edges) {
    const Vector<3> from = scene.place.control_points.col(i);
    const Vector<3> to = scene.place.control_points.col(j);
    const Vector<2> begin = pixel_of(scene, from), end = pixel_of(scene, to);
    const int pieces = std::clamp(static_cast<int>((end - begin).norm() / kPiece), 1, 10000);
    for (int k = 0; k < pieces; ++k) {
      const double t0 = static_cast<double>(k) / pieces, t1 = static_cast<double>(k + 1) / pieces;
      const double middle = (t0 + t1) / 2;
      const double nearness = scene.view.toward.dot(from + middle * (to - from));
      const bool is_hidden = depths.is_hidden(begin + middle * (end - begin), nearness);
      (is_hidden ? wire.hidden : wire.visible)
          .push_back({begin + t0 * (end - begin), begin + t1 * (end - begin)});
    }
  }
  return wire;
}

double dot_radius(const ModelScene& scene) {
  double length = 0;
  for (const auto& [i, j] : scene.model.cage_edges) {
    length += (pixel_of(scene, scene.place.control_points.col(i)) -
               pixel_of(scene, scene.place.control_points.col(j)))
                  .norm();
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, scene.model.cage_edges.size()));
  return std::clamp(0.06 * length / count, 1.2 * scene.unit, 5 * scene.unit);
}

void paint_dots(Canvas& canvas, const DepthBuffer& depths, const ModelScene& scene) {
  const auto& places = scene.place.control_points;
  const double radius = dot_radius(scene);
  const auto is_hidden = [&](Eigen::Index i) {
    return depths.is_hidden(pixel_of(scene, places.col(i)), scene.view.toward.dot(places.col(i)));
  };
  for (const bool hidden : {true, false}) {
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
      if (is_hidden(i) != hidden) continue;
      const Vector<2> pixel = pixel_of(scene, places.col(i));
      if (hidden) {
        canvas.fill_disc(pixel, radius, mix(kWhite, kInk, 2 * kHiddenOpacity));
      } else {
        paint_dot(canvas, pixel, radius, kInk);
      }
    }
  }
  if (scene.control_point < 0) return;
  // Last and largest, so that neighbours never hide it.
  paint_dot(canvas, pixel_of(scene, places.col(scene.control_point)),
            std::max(1.6 * radius, 5 * scene.unit), kHighlight);
}

}  // namespace

void paint_model(Canvas& canvas, const ModelScene& scene) {
  DepthBuffer depths(canvas);
  paint_surface(canvas, depths, scene);
  const auto wire = cut_wire(depths, scene);
  canvas.draw_segments(wire.hidden, 1.3 * scene.unit, kInk, kHiddenOpacity);
  canvas.draw_segments(wire.visible, 1.3 * scene.unit, kInk, 0.85F);
  paint_dots(canvas, depths, scene);
}

}  // namespace flbc::draw
