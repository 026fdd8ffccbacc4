// SPDX-License-Identifier: BSD-3-Clause
#include "draw/canvas.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "flbc/errors.h"

namespace flbc::draw {
namespace {

// How much of a sample is covered by a shape whose border is `inside` samples away.
double coverage(double inside) {
  return std::clamp(inside + 0.5, 0.0, 1.0);
}

Vector<2> sample_position(int x, int y) {
  return {x + 0.5, y + 0.5};
}

double distance_to(const Segment& segment, const Vector<2>& p) {
  const Vector<2> direction = segment.b - segment.a;
  const double squared_length = direction.squaredNorm();
  const double t = squared_length > 0 ? (p - segment.a).dot(direction) / squared_length : 0.0;
  return (p - segment.a - std::clamp(t, 0.0, 1.0) * direction).norm();
}

struct Range {
  int first;
  int last;
};

// The samples between two coordinates, within the picture.
Range samples_between(double low, double high, int size) {
  const double limit = size;
  return {static_cast<int>(std::floor(std::clamp(low, 0.0, limit))),
          static_cast<int>(std::floor(std::clamp(high, -1.0, limit - 1)))};
}

// The columns that a thick segment can touch in a row: those near the part of the segment that is
// near the row. Without this a long oblique line would cost its whole bounding box.
Range columns_near(const Segment& segment, double y, double reach, int width) {
  const double rise = segment.b.y() - segment.a.y();
  double t0 = 0;
  double t1 = 1;
  if (std::abs(rise) > 1e-9) {
    t0 = (y - reach - segment.a.y()) / rise;
    t1 = (y + reach - segment.a.y()) / rise;
    if (t0 > t1) std::swap(t0, t1);
    t0 = std::clamp(t0, 0.0, 1.0);
    t1 = std::clamp(t1, 0.0, 1.0);
  }
  const double run = segment.b.x() - segment.a.x();
  const auto [low, high] = std::minmax({segment.a.x() + t0 * run, segment.a.x() + t1 * run});
  return samples_between(low - reach, high + reach, width);
}

// Calls visit(x, y, distance to the centre) for the samples of a disc's surroundings.
template <class Visit>
void for_each_near(const Vector<2>& center, double reach, int width, int height, Visit&& visit) {
  const Range rows = samples_between(center.y() - reach, center.y() + reach, height);
  const Range columns = samples_between(center.x() - reach, center.x() + reach, width);
  for (int y = rows.first; y <= rows.last; ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      visit(x, y, (sample_position(x, y) - center).norm());
    }
  }
}

// Of samples in a layer that no filled area covers.
constexpr Color kNothing{-1, -1, -1};

// Samples are averaged in blocks of two by two, where there are that many.
int block_size(int supersampling) {
  return supersampling % 2 == 0 ? 2 : 1;
}

std::uint8_t to_channel(float component) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(component, 0.0F, 1.0F)));
}

std::size_t checked_size(int width, int height, int supersampling) {
  if (width < 1 || height < 1 || supersampling < 1) {
    throw OptionError("a picture needs at least one pixel, not " + std::to_string(width) + " x " +
                      std::to_string(height));
  }
  const double samples = static_cast<double>(width) * height * supersampling * supersampling;
  if (samples * (sizeof(Color) + 1) > 3e9 || std::max(width, height) > 100000) {
    throw OptionError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels is too large to be painted");
  }
  return static_cast<std::size_t>(samples);
}

}  // namespace

Canvas::Canvas(int width, int height, Color background, int supersampling, Kind kind)
    : supersampling_(supersampling),
      width_(width * supersampling),
      height_(height * supersampling),
      samples_(checked_size(width, height, supersampling),
               kind == Kind::kLayers ? kNothing : background),
      mask_(kind == Kind::kLayers ? 0 : samples_.size(), 0),
      dirty_{width_, -1, height_, -1},
      kind_(kind) {
}

void Canvas::touch(const Corners& corners) {
  if (kind_ == Kind::kPixels) return;
  for (const Vector<2>& corner : to_samples(corners)) {
    const Range x = samples_between(corner.x() - 1, corner.x() + 1, width_);
    const Range y = samples_between(corner.y() - 1, corner.y() + 1, height_);
    dirty_ = {std::min(dirty_.left, x.first), std::max(dirty_.right, x.last),
              std::min(dirty_.top, y.first), std::max(dirty_.bottom, y.last)};
  }
}

// The areas filled since the last layer, and no more than the rectangle in which they are.
FilledLayer Canvas::filled_areas() const {
  const int block = block_size(supersampling_);
  const int left = dirty_.left / block, right = std::min(dirty_.right / block, width_ / block - 1);
  const int top = dirty_.top / block, bottom = std::min(dirty_.bottom / block, height_ / block - 1);
  FilledLayer layer;
  layer.pixel_size = static_cast<double>(block) / supersampling_;
  layer.corner = layer.pixel_size * Vector<2>(left, top);
  layer.width = std::max(0, right - left + 1);
  layer.height = std::max(0, bottom - top + 1);
  layer.channels.reserve(std::size_t{4} * layer.width * layer.height);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      Color sum;
      int covered = 0;
      for (int k = 0; k < block * block; ++k) {
        const auto row = static_cast<std::size_t>(y) * block + k / block;
        const auto column = static_cast<std::size_t>(x) * block + k % block;
        const Color& sample = samples_[row * width_ + column];
        if (sample.r < 0) continue;
        sum = {sum.r + sample.r, sum.g + sample.g, sum.b + sample.b};
        ++covered;
      }
      const float share = covered > 0 ? 1.0F / static_cast<float>(covered) : 0;
      const auto alpha = static_cast<float>(covered) / static_cast<float>(block * block);
      for (const float part : {sum.r * share, sum.g * share, sum.b * share, alpha}) {
        layer.channels.push_back(to_channel(part));
      }
    }
  }
  return layer;
}

// What has been filled before becomes a layer of its own below this one.
bool Canvas::keep(Layer layer) {
  if (kind_ == Kind::kPixels) return false;
  auto filled = filled_areas();
  if (!filled.channels.empty()) {
    layers_.emplace_back(std::move(filled));
    for (int y = dirty_.top; y <= dirty_.bottom; ++y) {
      const auto row = samples_.begin() + static_cast<std::ptrdiff_t>(y) * width_;
      std::fill(row + dirty_.left, row + dirty_.right + 1, kNothing);
    }
  }
  dirty_ = {width_, -1, height_, -1};
  layers_.push_back(std::move(layer));
  return true;
}

bool Canvas::keep_text(const Vector<2>& position, std::string_view text, double height,
                       Color color) {
  return keep(TextLayer{position, std::string(text), height, color});
}

Corners Canvas::to_samples(const Corners& corners) const {
  return {corners[0] * supersampling_, corners[1] * supersampling_, corners[2] * supersampling_};
}

void Canvas::fill_triangle(const Corners& corners, Color color, float opacity) {
  touch(corners);
  for_each_sample(to_samples(corners), width_, height_,
                  [&](int x, int y, double, double) { blend(x, y, color, opacity); });
}

void Canvas::draw_segments(const std::vector<Segment>& segments, double width, Color color,
                           float opacity) {
  if (segments.empty() || keep(LineLayer{segments, width, color, opacity})) return;
  for (const auto& segment : segments) {
    cover({segment.a * supersampling_, segment.b * supersampling_}, width / 2 * supersampling_);
  }
  paint_covered(color, opacity);
}

void Canvas::cover(const Segment& segment, double radius) {
  if (!segment.a.allFinite() || !segment.b.allFinite()) return;
  const double reach = radius + 1;
  const auto [low, high] = std::minmax({segment.a.y(), segment.b.y()});
  const Range rows = samples_between(low - reach, high + reach, height_);
  for (int y = rows.first; y <= rows.last; ++y) {
    const Range columns = columns_near(segment, y + 0.5, reach, width_);
    if (columns.first > columns.last) continue;
    std::uint8_t* row = &mask_[static_cast<std::size_t>(y) * width_];
    for (int x = columns.first; x <= columns.last; ++x) {
      const double covered = coverage(radius - distance_to(segment, sample_position(x, y)));
      row[x] = std::max(row[x], static_cast<std::uint8_t>(std::lround(255 * covered)));
    }
    dirty_ = {std::min(dirty_.left, columns.first), std::max(dirty_.right, columns.last),
              std::min(dirty_.top, y), std::max(dirty_.bottom, y)};
  }
}

void Canvas::paint_covered(Color color, float opacity) {
  for (int y = dirty_.top; y <= dirty_.bottom; ++y) {
    std::uint8_t* row = &mask_[static_cast<std::size_t>(y) * width_];
    for (int x = dirty_.left; x <= dirty_.right; ++x) {
      if (row[x] == 0) continue;
      blend(x, y, color, opacity * static_cast<float>(row[x]) / 255);
      row[x] = 0;
    }
  }
  dirty_ = {width_, -1, height_, -1};
}

void Canvas::fill_disc(const Vector<2>& center, double radius, Color color) {
  if (keep(DiscLayer{center, radius, color})) return;
  const double r = radius * supersampling_;
  for_each_near(center * supersampling_, r + 1, width_, height_, [&](int x, int y, double d) {
    blend(x, y, color, static_cast<float>(coverage(r - d)));
  });
}

Image Canvas::resolve() const {
  Image image{width(), height(), {}, layers_};
  if (kind_ == Kind::kLayers) {
    auto filled = filled_areas();
    if (!filled.channels.empty()) image.layers.emplace_back(std::move(filled));
    return image;
  }
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  const float share = 1.0F / static_cast<float>(supersampling_ * supersampling_);
  for (int y = 0; y < height_; ++y) {
    const Color* row = &samples_[static_cast<std::size_t>(y) * width_];
    Color* pixels = &image.pixels[static_cast<std::size_t>(y / supersampling_) * image.width];
    for (int x = 0; x < width_; ++x) {
      Color& pixel = pixels[x / supersampling_];
      pixel = {pixel.r + share * row[x].r, pixel.g + share * row[x].g, pixel.b + share * row[x].b};
    }
  }
  return image;
}

}  // namespace flbc::draw
