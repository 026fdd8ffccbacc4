// SPDX-License-Identifier: BSD-3-Clause
#include "draw/layout.h"

#include <algorithm>
#include <cmath>

#include "flbc/errors.h"

namespace flbc::draw {

PixelMap::PixelMap(const Box& content, const Box& frame) {
  const Vector<2> size = content.size();
  const Vector<2> room = frame.size();
  // A content without width or height gives infinity for one quotient, never for both.
  scale_ = std::min(room.x() / size.x(), room.y() / size.y());
  offset_ = frame.center() + Vector<2>(-scale_, scale_).cwiseProduct(content.center());
}

PointList<2> PixelMap::operator()(const PointList<2>& points) const {
  return (Vector<2>(scale_, -scale_).asDiagonal() * points).colwise() + offset_;
}

Box bounding_box(const PointList<2>& points) {
  if (points.cols() == 0)
    throw InputError("there is nothing to draw: the cage has no control points");
  Box box{points.rowwise().minCoeff(), points.rowwise().maxCoeff()};
  const double extent = box.size().maxCoeff();
  if (!points.allFinite() || !std::isfinite(extent) || extent <= 0) {
    throw InputError("the cage cannot be drawn: its control points coincide or are not finite");
  }
  return box;
}

namespace {

// For a sheet of about 4:3; one more or less if that leaves fewer gaps in the last row.
int columns_of_sheet(double aspect, int count) {
  const int usual =
      std::clamp(static_cast<int>(std::lround(std::sqrt(4.0 / 3 * aspect * count))), 1, count);
  const auto gaps = [&](int columns) { return (columns - count % columns) % columns; };
  for (const int columns : {usual + 1, usual - 1}) {
    if (columns >= 1 && columns <= count && gaps(columns) < gaps(usual)) return columns;
  }
  return usual;
}

}  // namespace

SheetLayout plan_sheet(const Box& content, int count, const WeightPictureOptions& options,
                       bool has_bar) {
  const Vector<2> size = content.size();
  const double most = count < 3 ? 1.3 : 5;
  const double aspect = size.x() > 0 ? std::clamp(size.y() / size.x(), 0.27, most) : most;
  const int columns = columns_of_sheet(aspect, count);
  const int rows = (count + columns - 1) / columns;
  const double unit = pixel_unit(options);
  const double margin = 26 * unit, label = 44 * unit;
  const double gap = 44 * unit, bar_width = 26 * unit, numbers = 60 * unit;
  const double right = options.width - margin - (has_bar ? gap + bar_width + numbers : 0);
  const double width = right / columns - margin;
  const double height = aspect * width;
  const double row_height = label + height + margin;
  SheetLayout sheet{options.width, static_cast<int>(std::lround(rows * row_height + margin / 2)),
                    std::max(0.6, (count < 3 ? 1 : 0.7) * unit)};
  for (int k = 0; k < count; ++k) {
    const int row = k / columns;
    const int column = k % columns;
    const Vector<2> corner(margin + column * (width + margin), label + row * row_height);
    sheet.frames.push_back({corner, corner + Vector<2>(width, height)});
  }
  // Above and below the bar there is room for its title and the colors of defects.
  const double bar_height = std::min(sheet.height - 240 * unit, 620 * unit);
  const double top = (sheet.height - bar_height) / 2 + 16 * unit;
  sheet.color_bar = {{right + gap, top}, {right + gap + bar_width, top + bar_height}};
  return sheet;
}

}  // namespace flbc::draw
