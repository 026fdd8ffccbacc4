// SPDX-License-Identifier: BSD-3-Clause
// In place of canvas.cpp in builds without Cairo.
#include "draw/canvas.h"
#include "flbc/errors.h"

namespace flbc::draw {

bool can_draw() {
  return false;
}

Canvas::Canvas(int width, int height, PictureFormat format)
    : width_(width),
      height_(height),
      format_(format),
      surface_(nullptr, nullptr),
      cairo_(nullptr, nullptr) {
  throw OptionError("this flbc was built without Cairo and cannot draw pictures");
}

void Canvas::draw_raster(Raster&) {
}

void Canvas::draw_segments(const std::vector<Segment>&, double, Color, float) {
}

void Canvas::fill_discs(const std::vector<Vector<2>>&, double, Color) {
}

void Canvas::draw_text(const Vector<2>&, const std::string&, double, Color) {
}

std::string Canvas::encode() {
  return {};
}

double text_width(const std::string&, double) {
  return 0;
}

}  // namespace flbc::draw
