// SPDX-License-Identifier: BSD-3-Clause
#include "draw/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <png.h>

#include "flbc/errors.h"

namespace flbc::draw {
namespace {

constexpr double kPointsPerPixel = 0.375;  // a PDF of the usual width fits a page's text
constexpr double kDigitHeight = 0.72;      // in a font of size 1
constexpr const char* kCreationDate = "2000-01-01T00:00:00Z";
constexpr int kLargestSize = 32767;   // of Cairo's images
constexpr double kLargestArea = 4e7;  // in pixels; their rasters take 3 GB

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw IoError(std::string("cannot draw the picture: ") + cairo_status_to_string(status));
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* create_surface(int width, int height, PictureFormat format, std::string* bytes) {
  if (std::min(width, height) < 1 || std::max(width, height) > kLargestSize ||
      static_cast<double>(width) * height > kLargestArea) {
    throw OptionError("cannot draw a picture of " + std::to_string(width) + " x " +
                      std::to_string(height) + " pixels; the limit is " +
                      std::to_string(kLargestSize) + " in each direction and " +
                      std::to_string(static_cast<int>(kLargestArea)) + " in all");
  }
  if (format == PictureFormat::kPng) {
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  }
  if (format == PictureFormat::kSvg) {
    auto* surface = cairo_svg_surface_create_for_stream(append, bytes, width, height);
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    return surface;
  }
  auto* surface = cairo_pdf_surface_create_for_stream(append, bytes, kPointsPerPixel * width,
                                                      kPointsPerPixel * height);
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, kCreationDate);
  return surface;
}

void set_color(cairo_t* cairo, Color color, float opacity = 1) {
  cairo_set_source_rgba(cairo, color.r, color.g, color.b, opacity);
}

// Without hinting, widths of text are proportional to its height.
void set_font(cairo_t* cairo, double height) {
  cairo_select_font_face(cairo, "Lato", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, height / kDigitHeight);
  auto* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(cairo, options);
  cairo_font_options_destroy(options);
}

// Adds a point, in place of the one before if that is on the straight line to it.
void add_point(std::vector<Vector<2>>& line, const Vector<2>& p) {
  constexpr double kThinning = 1e-3;  // pixels
  if (line.size() > 1) {
    const Vector<2> step = line.back() - line[line.size() - 2], next = p - line.back();
    const double cross = step.x() * next.y() - step.y() * next.x();
    if (step.dot(next) > 0 && std::abs(cross) < kThinning * (step + next).norm()) line.pop_back();
  }
  line.push_back(p);
}

// Segments with the same ends joined to lines, which makes files smaller.
std::vector<std::vector<Vector<2>>> joined(const std::vector<Segment>& segments) {
  const auto place = [](const Vector<2>& p) { return std::pair(p.x(), p.y()); };
  std::multimap<std::pair<double, double>, std::size_t> at;
  std::vector<bool> used(segments.size(), false);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const auto& [a, b] = segments[k];
    used[k] = !a.allFinite() || !b.allFinite();
    if (used[k]) continue;
    at.emplace(place(a), k);
    at.emplace(place(b), k);
  }
  std::vector<std::vector<Vector<2>>> lines;
  for (std::size_t first = 0; first < segments.size(); ++first) {
    if (used[first]) continue;
    auto& line = lines.emplace_back(1, segments[first].a);
    for (std::size_t next = first; next < segments.size();) {
      used[next] = true;
      const bool forward = segments[next].a == line.back();
      add_point(line, forward ? segments[next].b : segments[next].a);
      const auto [begin, end] = at.equal_range(place(line.back()));
      const auto found = std::find_if(begin, end, [&](const auto& k) { return !used[k.second]; });
      next = found == end ? segments.size() : found->second;
    }
  }
  return lines;
}

}  // namespace

bool can_draw() {
  return true;
}

Canvas::Canvas(int width, int height, PictureFormat format)
    : width_(width),
      height_(height),
      format_(format),
      surface_(create_surface(width, height, format, &bytes_), cairo_surface_destroy),
      cairo_(cairo_create(surface_.get()), cairo_destroy) {
  if (format == PictureFormat::kPdf) cairo_scale(cairo_.get(), kPointsPerPixel, kPointsPerPixel);
  set_color(cairo_.get(), kWhite);
  cairo_paint(cairo_.get());
  cairo_set_line_cap(cairo_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo_.get(), CAIRO_LINE_JOIN_ROUND);
}

void Canvas::draw_raster(Raster& raster) {
  if (raster.samples().empty()) return;
  auto* image = cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(raster.samples().data()), CAIRO_FORMAT_ARGB32,
      raster.width(), raster.height(), 4 * raster.width());
  cairo_save(cairo_.get());
  cairo_translate(cairo_.get(), raster.corner().x(), raster.corner().y());
  cairo_scale(cairo_.get(), 1.0 / Raster::kSamplesPerPixel, 1.0 / Raster::kSamplesPerPixel);
  cairo_set_source_surface(cairo_.get(), image, 0, 0);
  // Of two samples per pixel, this is the mean, in a tenth of the time of the usual filter.
  cairo_pattern_set_filter(cairo_get_source(cairo_.get()), CAIRO_FILTER_BILINEAR);
  cairo_paint(cairo_.get());
  cairo_restore(cairo_.get());
  cairo_surface_destroy(image);
}

void Canvas::draw_segments(const std::vector<Segment>& segments, double width, Color color,
                           float opacity) {
  for (const auto& line : joined(segments)) {
    cairo_move_to(cairo_.get(), line.front().x(), line.front().y());
    for (const auto& p : line) cairo_line_to(cairo_.get(), p.x(), p.y());
  }
  set_color(cairo_.get(), color, opacity);
  cairo_set_line_width(cairo_.get(), width);
  cairo_stroke(cairo_.get());
}

void Canvas::fill_discs(const std::vector<Vector<2>>& centers, double radius, Color color) {
  std::vector<Segment> points;
  for (const auto& center : centers) points.push_back({center, center});
  draw_segments(points, 2 * radius, color);
}

void Canvas::draw_text(const Vector<2>& position, const std::string& text, double height,
                       Color color) {
  set_color(cairo_.get(), color);
  set_font(cairo_.get(), height);
  cairo_move_to(cairo_.get(), position.x(), position.y());
  cairo_show_text(cairo_.get(), text.c_str());
  cairo_new_path(cairo_.get());
}

// Compressed less than by Cairo, which takes five times as long.
std::string Canvas::encode_png() const {
  cairo_surface_flush(surface_.get());
  const auto* pixels = cairo_image_surface_get_data(surface_.get());
  const int stride = cairo_image_surface_get_stride(surface_.get());
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  std::vector<png_byte> colors;
  colors.reserve(PNG_IMAGE_SIZE(image));
  for (int row = 0; row < height_; ++row) {
    for (int column = 0; column < width_; ++column) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, pixels + static_cast<std::ptrdiff_t>(row) * stride + 4 * column, 4);
      for (const int shift : {16, 8, 0}) colors.push_back(static_cast<png_byte>(pixel >> shift));
    }
  }
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, colors.data(), 0, nullptr) == 0) {
    throw IoError(std::string("cannot encode the picture: ") + image.message);
  }
  bytes.resize(size);
  return bytes;
}

std::string Canvas::encode() {
  check(cairo_status(cairo_.get()));
  if (format_ == PictureFormat::kPng) return encode_png();
  cairo_show_page(cairo_.get());
  cairo_surface_finish(surface_.get());
  check(cairo_surface_status(surface_.get()));
  return std::move(bytes_);
}

double text_width(const std::string& text, double height) {
  auto* surface = cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1);
  auto* cairo = cairo_create(surface);
  set_font(cairo, height);
  cairo_text_extents_t extents{};
  cairo_text_extents(cairo, text.c_str(), &extents);
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  return extents.x_advance;
}

}  // namespace flbc::draw
