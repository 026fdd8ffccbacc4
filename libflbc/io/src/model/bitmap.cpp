// SPDX-License-Identifier: BSD-3-Clause
#include "model/bitmap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>
#include <type_traits>

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "flbc/errors.h"
#include "flbc/version.h"

namespace flbc::io {
namespace {

using Pixel = Eigen::Matrix<Index, 2, 1>;
using Box = Eigen::AlignedBox<Index, 2>;  // of pixels from min() to before max()
using Corners = Eigen::Matrix<double, 2, 3>;

enum class Part : char { kStaying, kMoving, kStrip };

// A triangle on the canvas, and how it shows the picture.
struct Triangle {
  Part part;
  Corners corners;
  Vector<2> origin;  // in the picture, of the first corner
  Eigen::Matrix2d to_picture;
  double displacement;

  Triangle(Part of, const Corners& rest, const Corners& moved, double scale)
      : part(of),
        corners(moved),
        origin(rest.col(0)),
        to_picture(sides_of(rest) * sides_of(moved).inverse()),
        displacement((moved - scale * rest).squaredNorm()) {
    if (!std::isfinite(displacement)) displacement = 0;  // next to one without an area
  }

  static Eigen::Matrix2d sides_of(const Corners& of) {
    return of.rightCols<2>().colwise() - of.col(0);
  }

  template <class Places>
  Places on_canvas(const Places& places) const {
    return (to_picture.inverse() * (places.colwise() - origin)).colwise() + corners.col(0);
  }
};

// The triangles of a mesh, and a strip around it, so that what its border cuts is not lost.
// \param moved  where its vertices are on the canvas \param width  of the strip, in pixels
std::vector<Triangle> triangles_of(const DomainMesh<2>& mesh, const PointList<2>& moved,
                                   double scale, double width) {
  std::vector<Triangle> triangles;
  for (const auto& cell : mesh.cells.colwise()) {
    triangles.emplace_back(Part::kMoving, mesh.points(Eigen::all, cell), moved(Eigen::all, cell),
                           scale);
  }
  const auto topology = build_topology(mesh);
  for (Index e = 0; e < topology.num_facets(); ++e) {
    if (!topology.is_boundary(e)) continue;
    const auto inner = triangles[topology.sides(0, e)];
    const Vector<2> a = mesh.points.col(topology.facets(0, e));
    const Vector<2> b = mesh.points.col(topology.facets(1, e));
    const Vector<2> along = width * (b - a).normalized();
    Vector<2> out(along.y(), -along.x());
    const Vector<2> center =
        mesh.points(Eigen::all, mesh.cells.col(topology.sides(0, e))).rowwise().mean();
    if (out.dot(center - a) > 0) out = -out;
    Corners near, far;
    near << a - along, b + along, b + along + out;
    far << a - along, b + along + out, a - along + out;
    for (const auto& half : {near, far}) {
      triangles.emplace_back(Part::kStrip, half, inner.on_canvas(half), scale);
    }
  }
  return triangles;
}

// Calls act(y, begin, end) for the pixels of each row whose centers are in a triangle. Triangles
// with a common edge or corner neither share a pixel nor leave one out, because ends of rows are
// computed alike for both.
template <class Act>
void for_each_row(const Corners& corners, const Box& canvas, const Act& act) {
  if (!corners.allFinite()) return;
  const auto first_center = [](double place, Index low, Index high) {
    return static_cast<Index>(std::clamp<double>(std::ceil(place - 0.5), low, high));
  };
  const double low = corners.row(1).minCoeff(), high = corners.row(1).maxCoeff();
  const Index last = first_center(high, canvas.min().y(), canvas.max().y());
  for (Index y = first_center(low, canvas.min().y(), last); y < last; ++y) {
    const double at = y + 0.5;
    double left = canvas.max().x(), right = canvas.min().x();
    for (int k = 0; k < 3; ++k) {
      Vector<2> from = corners.col(k), to = corners.col((k + 1) % 3);
      if (from.y() > to.y()) from.swap(to);
      if (from.y() > at || to.y() <= at) continue;
      const double x = from.x() + (at - from.y()) / (to.y() - from.y()) * (to.x() - from.x());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    const Index end = first_center(right, canvas.min().x(), canvas.max().x());
    const Index begin = first_center(left, canvas.min().x(), end);
    if (begin < end) act(y, begin, end);
  }
}

// The pixels of a picture that stay or move.
template <class Sample>
struct Source {
  const Bitmap& picture;
  const Sample* samples;
  std::vector<bool> is_moving;                 // none: all
  std::vector<Eigen::AlignedBox2d> visible{};  // pixels of each triangle at rest
  std::size_t staying = 0;

  // \param rest  triangles in the picture
  Source(const Bitmap& of, const std::vector<Sample>& samples_of, const std::vector<Triangle>& rest)
      : picture(of),
        samples(samples_of.data()),
        is_moving(static_cast<std::size_t>(of.width) * of.height, false) {
    const Box canvas(Pixel(0, 0), Pixel(of.width, of.height));
    for (const auto& triangle : rest) {
      auto& box = visible.emplace_back();
      for_each_row(triangle.corners, canvas, [&](Index y, Index begin, Index end) {
        for (Index x = begin; x < end; ++x) {
          const auto pixel = static_cast<std::size_t>(y) * of.width + x;
          is_moving[pixel] = true;
          if (alpha(pixel) > 0) box.extend(Vector<2>(x, y)).extend(Vector<2>(x + 1, y + 1));
        }
      });
    }
    constexpr int kHaze = 32;
    bool all_move = true;
    for (std::size_t k = 0; k < is_moving.size(); ++k) {
      if (is_moving[k] || alpha(k) == 0) continue;
      all_move = false;
      if (kHaze * alpha(k) >= of.largest()) ++staying;
    }
    if (all_move) is_moving.clear();
  }

  // Adds what is at a place: premultiplied colors and alpha, by bilinear interpolation.
  void add(const Vector<2>& place, bool moving, std::array<float, 4>& sum) const {
    constexpr double kSame = 1e-6;  // from the center of a pixel
    const double x = place.x() - 0.5, y = place.y() - 0.5;
    if (!(x > -1 && y > -1 && x < picture.width && y < picture.height)) return;
    const auto column = static_cast<Index>(x + 1 + kSame) - 1;
    const auto row = static_cast<Index>(y + 1 + kSame) - 1;
    const auto part = [](double of) { return of < kSame ? 0.0F : static_cast<float>(of); };
    const float right = part(x - column), low = part(y - row);
    add(column, row, (1 - right) * (1 - low), moving, sum);
    add(column + 1, row, right * (1 - low), moving, sum);
    add(column, row + 1, (1 - right) * low, moving, sum);
    add(column + 1, row + 1, right * low, moving, sum);
  }

 private:
  int alpha(std::size_t pixel) const { return samples[(pixel + 1) * picture.channels - 1]; }

  void add(Index x, Index y, float share, bool moving, std::array<float, 4>& sum) const {
    if (share == 0 || x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
    const auto pixel = static_cast<std::size_t>(y) * picture.width + x;
    if (!is_moving.empty() && is_moving[pixel] != moving) return;
    const auto* own = &samples[pixel * picture.channels];
    const int last = picture.channels - 1;
    const float weight = share * static_cast<float>(own[last]);
    for (int c = 0; c < last; ++c) sum[c] += weight * static_cast<float>(own[c]);
    sum[last] += weight;
  }
};

// Puts part of a row of a triangle over what is there. \param first  its corner on the canvas
// \param covered  whether the pixels have a part of the mesh
template <class Sample>
void paint(const Source<Sample>& source, const Triangle& triangle, const Vector<2>& first,
           Index count, Sample* pixel, char* covered) {
  constexpr int kMost = 8;  // samples of a pixel along an axis, where the picture shrinks
  const int channels = source.picture.channels, last = channels - 1;
  const auto largest = static_cast<float>(std::numeric_limits<Sample>::max());
  const double shrink = triangle.to_picture.colwise().norm().maxCoeff();
  const auto n = static_cast<int>(std::lround(std::clamp<double>(shrink, 1, kMost)));
  const auto share = 1 / static_cast<float>(n * n);
  std::array<Vector<2>, kMost * kMost> places;
  for (int i = 0; i < n * n; ++i) {
    const Vector<2> place = first + Vector<2>(i % n + 0.5, i / n + 0.5) / n;
    places[i] = triangle.origin + triangle.to_picture * (place - triangle.corners.col(0));
  }
  for (Index k = 0; k < count; ++k, pixel += channels) {
    if (triangle.part == Part::kStrip && covered[k] != 0) continue;
    covered[k] = triangle.part == Part::kStaying ? 0 : 1;
    std::array<float, 4> sum{};
    for (int i = 0; i < n * n; ++i) {
      source.add(places[i] + k * triangle.to_picture.col(0), triangle.part != Part::kStaying, sum);
    }
    const float alpha = share * sum[last];
    if (alpha == 0) continue;
    const float below = static_cast<float>(pixel[last]) * (1 - alpha / largest);
    const auto rounded = [](float sample) { return static_cast<Sample>(sample + 0.5F); };
    for (int c = 0; c < last; ++c) {
      pixel[c] = rounded((share * sum[c] + below * static_cast<float>(pixel[c])) / (alpha + below));
    }
    pixel[last] = rounded(alpha + below);
  }
}

void require_possible(const Vector<2>& sides) {
  constexpr double kMostPixels = 1 << 28;
  if (sides.prod() <= kMostPixels) return;
  std::ostringstream text;
  text << "the result needs " << sides.x() << " x " << sides.y()
       << " pixels, but at most 16384 x 16384 are supported";
  throw InputError(text.str());
}

template <class Sample>
Bitmap blank(const Bitmap& like, const Box& canvas) {
  const auto [left, top] = std::pair(canvas.min().x(), canvas.min().y());
  const Index width = canvas.sizes().x(), height = canvas.sizes().y();
  std::vector<Sample> samples(static_cast<std::size_t>(width) * height * like.channels);
  return {width, height, like.channels, std::move(samples), left, top, like.chunks};
}

template <class Sample>
Bitmap render(const Source<Sample>& source, const std::vector<Triangle>& triangles,
              const Box& canvas) {
  constexpr Index kRows = 32;  // that one thread paints
  auto result = blank<Sample>(source.picture, canvas);
  auto& samples = std::get<std::vector<Sample>>(result.samples);
  const auto width = static_cast<std::size_t>(result.width);
  parallel_for((result.height + kRows - 1) / kRows, [&](Index block) {
    const Index top = canvas.min().y() + kRows * block;
    std::vector<char> covered(width * kRows);
    Box part = canvas;
    part.min().y() = top;
    part.max().y() = std::min(top + kRows, canvas.max().y());
    for (const auto& triangle : triangles) {
      if (!triangle.to_picture.allFinite()) continue;  // it has no area
      for_each_row(triangle.corners, part, [&](Index y, Index begin, Index end) {
        const auto pixel = width * (y - top) + (begin - result.left);
        paint(source, triangle, Vector<2>(begin, y), end - begin,
              &samples[(pixel + width * (top - result.top)) * result.channels], &covered[pixel]);
      });
    }
  });
  return result;
}

template <class Sample>
std::size_t warp_samples(const Bitmap& picture, const std::vector<Sample>& samples,
                         const Binding<2>& binding, const std::vector<PointList<2>>& poses,
                         double scale, const Vector<2>& size,
                         const std::function<void(std::size_t, Bitmap)>& take) {
  // Widths of the strip, in pixels: of those that move, and of those that show how these fade out.
  constexpr double kMoving = 1.5, kShown = 3;
  if (!(scale > 0) || !std::isfinite(scale)) throw OptionError("scale must be positive");
  if (binding.domain.num_cells() == 0) {
    throw InputError("the binding has no domain mesh, with which pixels move");
  }
  const Vector<2> pixels(picture.width, picture.height);
  const auto in_pixels = [&](const PointList<2>& points) -> PointList<2> {
    const Vector<2> unit = size.isZero(0) ? Vector<2>(1, 1) : Vector<2>(pixels.cwiseQuotient(size));
    return (Vector<2>(unit.x(), -unit.y()).asDiagonal() * points).colwise() +
           Vector<2>(0, pixels.y());
  };
  // Masks hold for it as well.
  const auto moving = binding.transferred(binding.domain.points, {}, OutsidePoints::kNearest);
  const DomainMesh<2> mesh{in_pixels(binding.domain.points), binding.domain.cells};
  const Source<Sample> source(picture, samples, triangles_of(mesh, mesh.points, 1, kMoving));
  const auto in_pose = [&](const PointList<2>& pose) {
    return triangles_of(mesh, scale * in_pixels(moving.deform(pose)), scale, kShown);
  };
  Eigen::AlignedBox2d bounds(Vector<2>::Zero(), scale * pixels);
  for (const auto& pose : poses) {
    const auto triangles = in_pose(pose);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const auto& [low, high] = std::pair(source.visible[k].min(), source.visible[k].max());
      if (source.visible[k].isEmpty() || !triangles[k].to_picture.allFinite()) continue;
      Eigen::Matrix<double, 2, 4> corners;
      corners << low.x(), high.x(), low.x(), high.x(), low.y(), low.y(), high.y(), high.y();
      const auto places = triangles[k].on_canvas(corners);
      bounds.extend(places.rowwise().minCoeff()).extend(places.rowwise().maxCoeff());
    }
  }
  constexpr double kRounding = 1e-3;
  bounds = {(bounds.min().array() + kRounding).floor(), (bounds.max().array() - kRounding).ceil()};
  require_possible(bounds.sizes());
  Corners upper, lower;  // halves of what stays
  upper << 0, pixels.x(), pixels.x(), 0, 0, pixels.y();
  lower << 0, pixels.x(), 0, 0, pixels.y(), pixels.y();
  for (std::size_t k = 0; k < poses.size(); ++k) {
    auto triangles = in_pose(poses[k]);
    if (!source.is_moving.empty()) {
      for (const auto& half : {upper, lower}) {
        triangles.emplace_back(Part::kStaying, half, scale * half, scale);
      }
    }
    std::stable_sort(triangles.begin(), triangles.end(), [](const auto& one, const auto& other) {
      return std::tie(one.part, one.displacement) < std::tie(other.part, other.displacement);
    });
    take(k, render(source, triangles, {bounds.min().cast<Index>(), bounds.max().cast<Index>()}));
  }
  return source.staying;
}

}  // namespace

std::size_t warp(const Bitmap& picture, const Binding<2>& binding,
                 const std::vector<PointList<2>>& poses, double scale, const Vector<2>& size,
                 const std::function<void(std::size_t, Bitmap)>& take) {
  return std::visit(
      [&](const auto& samples) {
        return warp_samples(picture, samples, binding, poses, scale, size, take);
      },
      picture.samples);
}

Bitmap sprite_sheet(const std::vector<Bitmap>& cells, const std::vector<std::string>& names,
                    const std::string& file, double seconds, std::string& json) {
  const auto& first = cells.front();
  const Index width = first.width, height = first.height;
  const auto count = static_cast<Index>(cells.size());
  const double square = std::sqrt(static_cast<double>(count) * height / width);
  const auto columns = static_cast<Index>(std::clamp<double>(std::round(square), 1, count));
  const Index rows = (count + columns - 1) / columns;
  require_possible({1.0 * columns * width, 1.0 * rows * height});
  const auto box = [](Index x, Index y, Index w, Index h) {
    return nlohmann::ordered_json{{"x", x}, {"y", y}, {"w", w}, {"h", h}};
  };
  const auto draw = [&](const auto& like) {
    using Samples = std::decay_t<decltype(like)>;
    auto sheet = blank<typename Samples::value_type>(
        first, {Pixel(0, 0), Pixel(columns * width, rows * height)});
    auto& samples = std::get<Samples>(sheet.samples);
    const std::ptrdiff_t row = std::ptrdiff_t(width) * first.channels;
    for (Index k = 0; k < count; ++k) {
      auto from = std::get<Samples>(cells[k].samples).begin();
      auto to = samples.begin() + std::ptrdiff_t(k / columns) * height * row * columns +
                k % columns * row;
      for (Index y = 0; y < height; ++y, from += row, to += row * columns) {
        std::copy_n(from, row, to);
      }
    }
    return sheet;
  };
  auto sheet = std::visit(draw, first.samples);
  nlohmann::ordered_json frames;
  for (Index k = 0; k < count; ++k) {
    const Index left = k % columns * width, top = k / columns * height;
    frames[names[k]] = {{"frame", box(left, top, width, height)},
                        {"rotated", false},
                        {"trimmed", false},
                        {"spriteSourceSize", box(0, 0, width, height)},
                        {"sourceSize", {{"w", width}, {"h", height}}},
                        {"duration", std::lround(1000 * seconds)}};
  }
  const nlohmann::ordered_json meta{{"app", "flbc"},
                                    {"version", FLBC_VERSION},
                                    {"image", file},
                                    {"format", "RGBA8888"},
                                    {"size", {{"w", sheet.width}, {"h", sheet.height}}},
                                    {"scale", "1"},
                                    {"offset", {{"x", first.left}, {"y", first.top}}}};
  json = nlohmann::ordered_json{{"frames", frames}, {"meta", meta}}.dump(1) + '\n';
  return sheet;
}

}  // namespace flbc::io
