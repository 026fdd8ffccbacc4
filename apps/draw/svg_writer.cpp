// SPDX-License-Identifier: BSD-3-Clause
#include "draw/svg_writer.h"

#include <cmath>
#include <cstdio>
#include <sstream>

#include "draw/base64.h"
#include "draw/png_writer.h"
#include "draw/polylines.h"
#include "draw/stroke_font.h"

namespace flbc::draw {
namespace {

constexpr double kThinning = 0.02;       // pixels
constexpr double kDigitPerFontSize = 0.72;  // of common fonts without serifs

// Two decimals are finer than any screen or printer.
std::string number(double value) {
  const double rounded = std::round(100 * value) / 100 + 0.0;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(10);
  text << rounded;
  return text.str();
}

std::string color_name(Color color) {
  const auto channel = [](float c) {
    return static_cast<unsigned>(std::lround(255 * std::fmin(1, std::fmax(0, c))));
  };
  char name[8];
  std::snprintf(name, sizeof name, "#%02x%02x%02x", channel(color.r), channel(color.g),
                channel(color.b));
  return name;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      default: result += c;
    }
  }
  return result;
}

class SvgBody {
 public:
  void operator()(const FilledLayer& layer) {
    text_ << "<image x=\"" << number(layer.corner.x()) << "\" y=\"" << number(layer.corner.y())
          << "\" width=\"" << number(layer.pixel_size * layer.width) << "\" height=\""
          << number(layer.pixel_size * layer.height)
          << "\" preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,"
          << to_base64(encode_png(layer)) << "\"/>\n";
  }

  void operator()(const LineLayer& layer) {
    text_ << "<path fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\" stroke=\""
          << color_name(layer.color) << "\" stroke-width=\"" << number(layer.width) << '"';
    if (layer.opacity < 1) {
      text_ << " stroke-opacity=\"" << number(static_cast<double>(layer.opacity)) << '"';
    }
    text_ << " d=\"";
    for (const auto& line : join_segments(layer.segments, kThinning)) {
      for (std::size_t k = 0; k < line.size(); ++k) {
        text_ << (k == 0 ? 'M' : 'L') << number(line[k].x()) << ' ' << number(line[k].y());
      }
    }
    text_ << "\"/>\n";
  }

  void operator()(const DiscLayer& layer) {
    text_ << "<circle cx=\"" << number(layer.center.x()) << "\" cy=\"" << number(layer.center.y())
          << "\" r=\"" << number(layer.radius) << "\" fill=\"" << color_name(layer.color)
          << "\"/>\n";
  }

  void operator()(const TextLayer& layer) {
    text_ << "<text x=\"" << number(layer.position.x()) << "\" y=\"" << number(layer.position.y())
          << "\" font-size=\"" << number(layer.height / kDigitPerFontSize) << "\" fill=\""
          << color_name(layer.color) << '"';
    if (layer.text.size() > 1) {
      text_ << " textLength=\"" << number(text_width(layer.text, layer.height))
            << "\" lengthAdjust=\"spacingAndGlyphs\"";
    }
    text_ << '>' << escaped(layer.text) << "</text>\n";
  }

  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

}  // namespace

std::string encode_svg(const Image& image) {
  SvgBody body;
  for (const auto& layer : image.layers) std::visit(body, layer);
  std::ostringstream text;
  text << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
          "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\""
          " width=\""
       << image.width << "\" height=\"" << image.height << "\" viewBox=\"0 0 " << image.width << ' '
       << image.height
       << "\" font-family=\"Helvetica, Arial, sans-serif\">\n"
          "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
       << body.text() << "</svg>\n";
  return text.str();
}

}  // namespace flbc::draw
