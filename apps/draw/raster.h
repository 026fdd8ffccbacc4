// SPDX-License-Identifier: BSD-3-Clause
// Filled triangles as an image.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "front/primitives.h"

namespace flbc::draw {

//! Shaded triangles with the nearest in front, as samples finer than the pixels of the picture.
//! Triangles that share an edge leave no seam, which separately filled paths would.
class Raster {
 public:
  static constexpr int kSamplesPerPixel = 2;  //!< in each direction

  //! A transparent raster over those pixels of a picture in which the points lie.
  Raster(const PointList<2>& points, int picture_width, int picture_height) {
    if (points.cols() == 0 || !points.allFinite()) return;
    const auto limit = [](double x, int size) { return std::clamp(x, 0.0, 1.0 * size); };
    const Vector<2> low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
    const auto left = static_cast<int>(limit(std::floor(low.x()), picture_width));
    const auto top = static_cast<int>(limit(std::floor(low.y()), picture_height));
    corner_ = {left, top};
    width_ =
        kSamplesPerPixel * (static_cast<int>(limit(std::ceil(high.x()), picture_width)) - left);
    height_ =
        kSamplesPerPixel * (static_cast<int>(limit(std::ceil(high.y()), picture_height)) - top);
    samples_.resize(static_cast<std::size_t>(width_) * height_);
    nearness_.resize(samples_.size(), -std::numeric_limits<float>::infinity());
  }

  const Vector<2>& corner() const { return corner_; }  //!< top left, in pixels
  int width() const { return width_; }                 //!< in samples
  int height() const { return height_; }               //!< in samples
  //! Rows from top to bottom; bytes from the highest: alpha, red, green, blue.
  std::vector<std::uint32_t>& samples() { return samples_; }

  //! Paints those samples of a triangle that are nearer than all before in shade(b0, b1, b2), the
  //! color at barycentric coordinates of the corners.
  //! \param corners  in pixels of the picture, \param nearness  of the corners
  template <class Shade>
  void fill(const Corners& corners, const Vector<3>& nearness, Shade&& shade) {
    const auto cross = [](const Vector<2>& u, const Vector<2>& v) {
      return u.x() * v.y() - u.y() * v.x();
    };
    Corners p;
    for (int k = 0; k < 3; ++k) p[k] = kSamplesPerPixel * (corners[k] - corner_);
    const double area = cross(p[1] - p[0], p[2] - p[0]);
    if (area == 0 || !std::isfinite(area)) return;
    const Vector<2> along_1 = (p[1] - p[0]) / area, along_2 = (p[2] - p[0]) / area;
    const auto [top, bottom] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    for (int row = first_sample(top, height_); row < first_sample(bottom, height_); ++row) {
      const auto [left, right] = span(p, row + 0.5);
      const int end = first_sample(right, width_);
      for (int column = first_sample(left, width_); column < end; ++column) {
        const Vector<2> q = Vector<2>(column + 0.5, row + 0.5) - p[0];
        const double b1 = std::clamp(cross(q, along_2), 0.0, 1.0);
        const double b2 = std::clamp(cross(along_1, q), 0.0, 1 - b1);
        const double b0 = 1 - b1 - b2;
        const auto k = static_cast<std::size_t>(row) * width_ + column;
        const auto near = static_cast<float>(nearness.dot(Vector<3>(b0, b1, b2)));
        if (!(near > nearness_[k])) continue;
        nearness_[k] = near;
        samples_[k] = packed(shade(b0, b1, b2));
      }
    }
  }

  //! Whether a painted sample is nearer than this point. \param pixel  of the picture
  bool hides(const Vector<2>& pixel, double nearness) const {
    const Vector<2> p = kSamplesPerPixel * (pixel - corner_);
    if (!(p.x() >= 0 && p.y() >= 0 && p.x() < width_ && p.y() < height_)) return false;
    const auto row = static_cast<std::size_t>(p.y());
    return static_cast<double>(nearness_[row * width_ + static_cast<std::size_t>(p.x())]) >
           nearness;
  }

 private:
  // The first of `size` samples, whose centers are at k + 0.5, that is not before x.
  static int first_sample(double x, int size) {
    return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, 1.0 * size));
  }

  // Where a row crosses the triangle. Both triangles at an edge find bitwise the same crossing.
  static std::pair<double, double> span(const Corners& p, double y) {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (int k = 0; k < 3; ++k) {
      const Vector<2>*a = &p[k], *b = &p[(k + 1) % 3];
      if (a->y() > b->y()) std::swap(a, b);
      if (y < a->y() || y >= b->y()) continue;
      const double x = a->x() + (y - a->y()) / (b->y() - a->y()) * (b->x() - a->x());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    return {left, right};
  }

  static std::uint32_t packed(Color color) {
    const auto byte = [](float c) {
      return static_cast<std::uint32_t>(255 * std::clamp(c, 0.0F, 1.0F) + 0.5F);
    };
    return 0xff000000U | byte(color.r) << 16 | byte(color.g) << 8 | byte(color.b);
  }

  Vector<2> corner_{0, 0};
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint32_t> samples_;
  std::vector<float> nearness_;
};

}  // namespace flbc::draw
