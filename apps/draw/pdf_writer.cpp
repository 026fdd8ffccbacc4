// SPDX-License-Identifier: BSD-3-Clause
// The only file that knows Cairo.
#include "draw/pdf_writer.h"

#include <cmath>
#include <cstdint>
#include <memory>

#include <cairo-pdf.h>
#include <cairo.h>

#include "draw/polylines.h"
#include "draw/stroke_font.h"
#include "flbc/errors.h"

namespace flbc::draw {
namespace {

constexpr double kThinning = 0.02;       // pixels
constexpr double kPointsPerPixel = 0.375; // a picture of the usual width is as wide as a page's text
constexpr const char* kCreationDate = "2000-01-01T00:00:00Z";

template <auto Destroy>
struct Destroyer {
  template <class Object>
  void operator()(Object* object) const {
    Destroy(object);
  }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroyer<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Destroyer<cairo_destroy>>;
using FontFace = std::unique_ptr<cairo_font_face_t, Destroyer<cairo_font_face_destroy>>;

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw IoError(std::string("cannot encode the picture as PDF: ") + cairo_status_to_string(status));
}

void set_color(cairo_t* cairo, Color color, float opacity = 1) {
  cairo_set_source_rgba(cairo, color.r, color.g, color.b, opacity);
}

void stroke_line(cairo_t* cairo, const std::vector<Vector<2>>& line, double y_sign) {
  cairo_move_to(cairo, line.front().x(), y_sign * line.front().y());
  for (const auto& p : line) cairo_line_to(cairo, p.x(), y_sign * p.y());
}

void use_round_pen(cairo_t* cairo, double width) {
  cairo_set_line_width(cairo, width);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
}

cairo_status_t render_glyph(cairo_scaled_font_t*, unsigned long glyph, cairo_t* cairo,
                            cairo_text_extents_t* extents) {
  const auto stroked = stroked_glyph(static_cast<char>(glyph));
  use_round_pen(cairo, stroke_width());
  for (const auto& line : stroked.strokes) stroke_line(cairo, line, -1);
  cairo_stroke(cairo);
  extents->x_advance = stroked.advance;
  return CAIRO_STATUS_SUCCESS;
}

// Cairo clips text to these, by default 1, rounded to whole points: the tips of pens would be missing.
cairo_status_t set_extents(cairo_scaled_font_t*, cairo_t*, cairo_font_extents_t* extents) {
  extents->ascent = 1.5;
  extents->descent = 0.75;
  extents->height = extents->ascent + extents->descent;
  extents->max_x_advance = 2;
  return CAIRO_STATUS_SUCCESS;
}

cairo_status_t glyph_of_character(cairo_scaled_font_t*, unsigned long unicode,
                                  unsigned long* glyph) {
  *glyph = unicode < 128 ? unicode : '?';
  return CAIRO_STATUS_SUCCESS;
}

// The strokes of the PNG as a font, so that text looks the same everywhere and can be selected.
FontFace stroke_font() {
  FontFace face(cairo_user_font_face_create());
  cairo_user_font_face_set_init_func(face.get(), set_extents);
  cairo_user_font_face_set_render_glyph_func(face.get(), render_glyph);
  cairo_user_font_face_set_unicode_to_glyph_func(face.get(), glyph_of_character);
  return face;
}

// Cairo wants colours multiplied by alpha, a word for a pixel.
Surface surface_of(const FilledLayer& layer) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, layer.width, layer.height));
  check(cairo_surface_status(surface.get()));
  cairo_surface_flush(surface.get());
  unsigned char* const data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  const std::uint8_t* channel = layer.channels.data();
  for (int y = 0; y < layer.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < layer.width; ++x, channel += 4) {
      const std::uint32_t alpha = channel[3];
      const auto part = [&](int k) { return (channel[k] * alpha + 127) / 255; };
      row[x] = alpha << 24 | part(0) << 16 | part(1) << 8 | part(2);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

struct PdfPainter {
  cairo_t* cairo;

  void operator()(const FilledLayer& layer) const {
    const Surface surface = surface_of(layer);
    cairo_save(cairo);
    cairo_translate(cairo, layer.corner.x(), layer.corner.y());
    cairo_scale(cairo, layer.pixel_size, layer.pixel_size);
    cairo_set_source_surface(cairo, surface.get(), 0, 0);
    cairo_paint(cairo);
    cairo_restore(cairo);
  }
  void operator()(const LineLayer& layer) const {
    set_color(cairo, layer.color, layer.opacity);
    use_round_pen(cairo, layer.width);
    for (const auto& line : join_segments(layer.segments, kThinning)) stroke_line(cairo, line, 1);
    cairo_stroke(cairo);
  }
  void operator()(const DiscLayer& layer) const {
    set_color(cairo, layer.color);
    cairo_arc(cairo, layer.center.x(), layer.center.y(), layer.radius, 0, 2 * std::acos(-1.0));
    cairo_fill(cairo);
  }
  void operator()(const TextLayer& layer) const {
    set_color(cairo, layer.color);
    cairo_set_font_size(cairo, layer.height);
    cairo_move_to(cairo, layer.position.x(), layer.position.y());
    cairo_show_text(cairo, layer.text.c_str());
    cairo_new_path(cairo);
  }
};

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

std::string encode_pdf(const Image& image) {
  std::string bytes;
  const Surface surface(cairo_pdf_surface_create_for_stream(
      append, &bytes, kPointsPerPixel * image.width, kPointsPerPixel * image.height));
  check(cairo_surface_status(surface.get()));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, kCreationDate);
  {
    const Context context(cairo_create(surface.get()));
    cairo_t* const cairo = context.get();
    const FontFace face = stroke_font();
    cairo_set_font_face(cairo, face.get());
    cairo_scale(cairo, kPointsPerPixel, kPointsPerPixel);
    for (const auto& layer : image.layers) std::visit(PdfPainter{cairo}, layer);
    cairo_show_page(cairo);
    check(cairo_status(cairo));
  }
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  return bytes;
}

}  // namespace flbc::draw
