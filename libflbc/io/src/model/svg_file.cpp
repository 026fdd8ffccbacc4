// SPDX-License-Identifier: BSD-3-Clause
// Outlines of drawings in SVG: closed polylines around what is to be seen, whatever its color. A
// library paints the drawing, so styles, transforms, strokes, and crossing parts are as they look.
#if __has_include(<dlfcn.h>) && !defined(__EMSCRIPTEN__)
#include <dlfcn.h>
#define FLBC_LOADS_LIBRARIES
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <pugixml.hpp>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>

#include "base/distance_to_segment.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "model/model_scan.h"
#include "model/svg_document.h"

namespace flbc::io {
namespace {

using Box = Eigen::AlignedBox<double, 2>;

// librsvg with Cairo and GLib, on which it depends. They need some fifty other libraries, so they
// are loaded when a drawing is read, and no program links them. Their binary interface is stable.
class Rsvg {
 public:
  struct Rectangle {
    double x, y, width, height;
  };
  struct Failure {
    std::uint32_t domain;
    int code;
    const char* message;
  };

  explicit Rsvg(const std::string& path) : path_(path) {
#ifdef FLBC_LOADS_LIBRARIES
    for (const char* file : {"librsvg-2.so.2", "librsvg-2.2.dylib"}) {
      if (library_ == nullptr) library_ = dlopen(file, RTLD_NOW);
    }
#endif
    if (library_ == nullptr) fail();
  }

  // Arguments must have exactly the types of the function.
  template <class Result, class... Arguments>
  Result call(const char* name, Arguments... arguments) const {
    void* address = nullptr;
#ifdef FLBC_LOADS_LIBRARIES
    address = dlsym(library_, name);
#endif
    if (address == nullptr) fail();
    Result (*function)(Arguments...) = nullptr;
    std::memcpy(&function, &address, sizeof function);
    return function(arguments...);
  }

  // The same of a function that may fail: its last argument receives why.
  template <class Result, class... Arguments>
  Result checked_call(const char* name, Arguments... arguments) const {
    Failure* failure = nullptr;
    const auto result = call<Result>(name, arguments..., &failure);
    if (result) return result;
    const std::string why = failure != nullptr ? std::string(": ") + failure->message : "";
    if (failure != nullptr) call<void>("g_error_free", failure);
    const bool is_font = why.find("Freetype") != std::string::npos;
    throw InputError(path_ + ": not a drawing that librsvg can paint" + why +
                     (is_font ? "; convert its text to paths" : ""));
  }

  // \param release  name of the function that frees the object
  std::shared_ptr<void> owned(void* object, const char* release) const {
    return {object, [rsvg = *this, release](void* own) { rsvg.call<void>(release, own); }};
  }

 private:
  [[noreturn]] void fail() const {
    throw InputError(path_ +
                     ": reading drawings needs librsvg 2.52 or later, which is not there; install "
                     "it (Debian: librsvg2-2), or save the drawing as .png with a transparent "
                     "background and use --auto-cage");
  }

  std::string path_;
  void* library_ = nullptr;  // stays loaded, because GLib keeps references to it
};

// The alpha of the pixels of a part of a drawing.
struct Picture {
  static constexpr int kFaint = 16;  // what has no higher alpha is not to be seen

  Vector<2> corner;  // upper left, in units of the drawing
  double scale;      // pixels per unit
  int width, height;
  std::vector<std::uint32_t> pixels{};  // row by row from the top, alpha in the highest byte

  static int alpha_of(std::uint32_t pixel) { return static_cast<int>(pixel >> 24U); }

  // 0 outside.
  int alpha(int x, int y) const {
    if (x < 0 || y < 0 || x >= width || y >= height) return 0;
    return alpha_of(pixels[static_cast<std::size_t>(y) * width + x]);
  }
  bool is_seen(int x, int y) const { return alpha(x, y) > kFaint; }

  // Of what is to be seen, in units of the drawing; empty if there is nothing.
  Box seen_box() const {
    Box box;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (is_seen(x, y)) box.extend(Vector<2>(x, y)).extend(Vector<2>(x + 1, y + 1));
      }
    }
    return box.isEmpty() ? box : Box(corner + box.min() / scale, corner + box.max() / scale);
  }

  double seen_share() const {
    const auto count = std::count_if(pixels.begin(), pixels.end(),
                                     [](std::uint32_t pixel) { return alpha_of(pixel) > kFaint; });
    return static_cast<double>(count) / static_cast<double>(pixels.size());
  }
};

// Whether a drawing fills its page, which cuts off what is beyond.
bool is_slice(const std::string& text) {
  pugi::xml_document document;
  document.load_buffer(text.data(), text.size());
  const std::string fit = document.document_element().attribute("preserveAspectRatio").value();
  return fit.find("slice") != std::string::npos;
}

class Drawing {
 public:
  Drawing(const std::string& path, const std::string& text)
      : rsvg_(path), has_text_(text.find("text") != std::string::npos) {
    auto* const handle =
        rsvg_.checked_call<void*>("rsvg_handle_new_from_data", text.data(), text.size());
    handle_ = rsvg_.owned(handle, "g_object_unref");
    rsvg_.call<void>("rsvg_handle_set_dpi", handle, 96.0);  // as in browsers
    constexpr double kUsual = 4000;                         // if the size is not given
    Rsvg::Rectangle view{0, 0, kUsual, kUsual};
    int has_width = 0, has_height = 0, has_view = 0;
    struct Length {
      double number;
      int unit;
    } width, height;
    rsvg_.call<void>("rsvg_handle_get_intrinsic_dimensions", handle, &has_width, &width,
                     &has_height, &height, &has_view, &view);
    Vector<2> whole(view.width, view.height), page = whole;
    const bool has_size = rsvg_.call<int>("rsvg_handle_get_intrinsic_size_in_pixels", handle,
                                          &page.x(), &page.y()) != 0;
    is_endless_ = has_view == 0 && !has_size;
    if (has_view != 0 || is_endless_) {
      page = has_size && is_slice(text) ? page / page.cwiseQuotient(whole).maxCoeff() : whole;
    }
    box_ = Box(Vector<2>::Zero(), page);
    if (!page.allFinite() || !(box_.volume() > 0)) {
      throw InputError(path + ": the drawing has no size; set its viewBox");
    }
  }

  // From (0, 0), with the y axis down.
  const Box& box() const { return box_; }
  // Whether neither a viewBox nor a size limits the page.
  bool is_endless() const { return is_endless_; }

  // Hides elements for good. \param selector  of CSS
  void hide(const std::string& selector) {
    const auto css = selector + " { display: none !important }";
    rsvg_.checked_call<int>("rsvg_handle_set_stylesheet", handle_.get(), css.data(), css.size());
  }

  // \param longer_side  of the picture, in pixels
  Picture paint(const Box& part, int longer_side) const {
    const double scale = longer_side / part.sizes().maxCoeff();
    const Eigen::Array2i size = (scale * part.sizes()).array().round().max(1.0).cast<int>();
    Picture picture{part.min(), scale, size.x(), size.y()};
    picture.pixels.resize(static_cast<std::size_t>(size.x()) * size.y());
    constexpr int kArgb = 0;
    const auto surface =
        rsvg_.owned(rsvg_.call<void*>("cairo_image_surface_create_for_data", picture.pixels.data(),
                                      kArgb, picture.width, picture.height, 4 * picture.width),
                    "cairo_surface_destroy");
    // librsvg asks for fonts of their size times the square of the scale that it sees, and FreeType
    // makes none above 32,767. Without text it must see the true scale, because it paints masks in
    // pixels.
    constexpr double kFar = 100;
    const double closer =
        has_text_ ? std::max(1.0, scale * std::sqrt(box_.sizes().maxCoeff()) / kFar) : 1.0;
    rsvg_.call<void>("cairo_surface_set_device_scale", surface.get(), closer, closer);
    const auto context =
        rsvg_.owned(rsvg_.call<void*>("cairo_create", surface.get()), "cairo_destroy");
    rsvg_.call<void>("cairo_scale", context.get(), scale / closer, scale / closer);
    rsvg_.call<void>("cairo_translate", context.get(), -part.min().x(), -part.min().y());
    const Rsvg::Rectangle all{0, 0, box_.max().x(), box_.max().y()};
    rsvg_.checked_call<int>("rsvg_handle_render_document", handle_.get(), context.get(), &all);
    return picture;
  }

 private:
  Rsvg rsvg_;
  std::shared_ptr<void> handle_;
  bool has_text_, is_endless_ = false;
  Box box_;
};

// Selectors of the shapes in an element, in the order in which they are painted.
void collect_shapes(const pugi::xml_node& element, const std::string& selector,
                    std::vector<std::string>& shapes) {
  constexpr std::string_view kShapes = " path polygon polyline rect circle ellipse ";
  constexpr std::string_view kNotPainted = " defs clipPath mask symbol ";
  int number = 0;
  for (const pugi::xml_node& child : element.children()) {
    if (child.type() != pugi::node_element) continue;
    const std::string name = child.name();  // with a prefix, if there is one
    const auto word = " " + name.substr(name.find(':') + 1) + " ";
    const auto own = selector + " > :nth-child(" + std::to_string(++number) + ")";
    if (kShapes.find(word) != std::string_view::npos) shapes.push_back(own);
    if (kNotPainted.find(word) == std::string_view::npos) collect_shapes(child, own, shapes);
  }
}

// A drawing without the shapes in its back that fill all of it.
Drawing without_background(const std::string& path, const std::string& text) {
  constexpr int kPixels = 256;
  constexpr double kAll = 0.99;
  Drawing drawing(path, text);
  const auto share = [&] { return drawing.paint(drawing.box(), kPixels).seen_share(); };
  if (share() <= kAll) return drawing;
  pugi::xml_document document;
  document.load_buffer(text.data(), text.size());
  std::vector<std::string> shapes;
  collect_shapes(document.document_element(), ":root", shapes);
  for (const auto& shape : shapes) {
    drawing.hide(shape);
    const double left = share();
    if (left > 0 && left <= kAll) return drawing;
    if (left == 0) break;
  }
  return {path, text};
}

using Loop = std::vector<Vector<2>>;  // closed, in pixels

// The lines around what is to be seen. Between the centers of pixels they pass where the alpha,
// taken as linear, is just that of faint pixels, so they never cross.
class Tracer {
 public:
  explicit Tracer(const Picture& picture) : picture_(picture) {
    for (int y = -1; y < picture.height; ++y) {
      for (int x = -1; x < picture.width; ++x) pass_through(x, y);
    }
  }

  std::vector<Loop> loops() {
    std::vector<Loop> loops;
    while (!next_.empty()) {
      auto& loop = loops.emplace_back();
      for (auto side = next_.begin(); side != next_.end();) {
        loop.push_back(crossing(side->first));
        const auto following = side->second;
        next_.erase(side);
        side = next_.find(following);
      }
    }
    return loops;
  }

 private:
  // Through the square whose first corner is the center of pixel (x, y). Side k is from corner k to
  // corner k + 1. What is to be seen is on the left of each line, and stays connected.
  void pass_through(int x, int y) {
    const bool seen[] = {picture_.is_seen(x, y), picture_.is_seen(x + 1, y),
                         picture_.is_seen(x + 1, y + 1), picture_.is_seen(x, y + 1)};
    for (int k = 0; k < 4; ++k) {
      if (!seen[k] || seen[(k + 1) % 4]) continue;
      int end = (k + 1) % 4;
      while (!seen[(end + 1) % 4]) end = (end + 1) % 4;
      next_[side(x, y, end)] = side(x, y, k);
    }
  }

  // The number of a side, of both squares that have it: of its first corner, and whether it points
  // down.
  std::int64_t side(int x, int y, int k) const {
    const std::int64_t column = x + 1 + (k == 1 ? 1 : 0), line = y + 1 + (k == 2 ? 1 : 0);
    return 2 * (line * columns_ + column) + k % 2;
  }

  Vector<2> crossing(std::int64_t side) const {
    const auto x = static_cast<int>(side / 2 % columns_) - 1;
    const auto y = static_cast<int>(side / 2 / columns_) - 1;
    const auto down = static_cast<int>(side % 2);
    const double from = picture_.alpha(x, y), to = picture_.alpha(x + 1 - down, y + down);
    const double part = (from - (Picture::kFaint + 0.5)) / (from - to);
    return {x + 0.5 + (1 - down) * part, y + 0.5 + down * part};
  }

  const Picture& picture_;
  const std::int64_t columns_ = picture_.width + 2;
  std::map<std::int64_t, std::int64_t> next_{};  // by side: the side that follows on its line
};

// Appends the first point of a line and those others from which the rest is not farther than the
// tolerance (Douglas and Peucker 1973). The last point begins the next line.
void append_corners(const Loop& line, std::size_t first, std::size_t last, double tolerance,
                    Loop& corners) {
  std::size_t farthest = first;
  double distance = tolerance;
  for (std::size_t k = first + 1; k < last; ++k) {
    const double own = distance_to_segment<2>(line[k], line[first], line[last]);
    if (own > distance) distance = own, farthest = k;
  }
  if (farthest == first) return corners.push_back(line[first]);
  append_corners(line, first, farthest, tolerance, corners);
  append_corners(line, farthest, last, tolerance, corners);
}

// \return fewer than three corners if it is smaller than the tolerance
Loop simplified(Loop loop, double tolerance) {
  const auto is_left = [](const Vector<2>& p, const Vector<2>& q) { return p.x() < q.x(); };
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), is_left), loop.end());
  loop.push_back(loop.front());
  const auto is_nearer = [&](const Vector<2>& p, const Vector<2>& q) {
    return (p - loop.front()).squaredNorm() < (q - loop.front()).squaredNorm();
  };
  const auto middle = static_cast<std::size_t>(
      std::max_element(loop.begin(), loop.end(), is_nearer) - loop.begin());
  Loop corners;
  append_corners(loop, 0, middle, tolerance, corners);
  append_corners(loop, middle, loop.size() - 1, tolerance, corners);
  return corners;
}

// Whether segments from a to b and from c to d have a point in common, unless they share an end.
bool cross(const Vector<2>& a, const Vector<2>& b, const Vector<2>& c, const Vector<2>& d) {
  if (!Box(a).extend(b).intersects(Box(c).extend(d))) return false;
  if (a == c || a == d || b == c || b == d) return false;
  const auto side = [](const Vector<2>& from, const Vector<2>& to, const Vector<2>& p) {
    return (to.x() - from.x()) * (p.y() - from.y()) - (to.y() - from.y()) * (p.x() - from.x());
  };
  return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

bool have_crossing(const std::vector<Loop>& loops) {
  using Segment = std::pair<Vector<2>, Vector<2>>;  // from left to right
  const auto is_left = [](const auto& p, const auto& q) { return p.x() < q.x(); };
  std::vector<Segment> edges;
  for (const auto& loop : loops) {
    Vector<2> last = loop.back();
    for (const auto& corner : loop) {
      edges.push_back(std::minmax(last, corner, is_left));
      last = corner;
    }
  }
  std::sort(edges.begin(), edges.end(),
            [&](const Segment& e, const Segment& f) { return is_left(e.first, f.first); });
  for (auto e = edges.begin(); e != edges.end(); ++e) {
    for (auto f = e + 1; f != edges.end() && f->first.x() <= e->second.x(); ++f) {
      if (cross(e->first, e->second, f->first, f->second)) return true;
    }
  }
  return false;
}

// With as few corners as the tolerance permits. It is lowered where simplified lines would cross.
std::vector<Loop> simplified(const std::vector<Loop>& loops, double tolerance) {
  constexpr double kLeast = 1e-3;
  std::vector<Loop> result;
  do {
    result.clear();
    for (const auto& loop : loops) {
      auto corners = simplified(loop, tolerance);
      if (corners.size() > 2) result.push_back(std::move(corners));
    }
    tolerance /= 2;
  } while (tolerance > kLeast && have_crossing(result));
  return result;
}

// What is to be seen of a drawing, as large as it can be painted. \param without  what is left out,
// for messages \param bottom  output: lower edge of the model
Picture close_picture(const Drawing& drawing, const std::string& path, const std::string& without,
                      double& bottom) {
  constexpr int kPixels = 2048;
  auto picture = drawing.paint(drawing.box(), kPixels);
  for (int closer = 0; closer < 2; ++closer) {
    const auto part = picture.seen_box();
    if (part.isEmpty())
      throw InputError(path + ": nothing is to be seen in this drawing" + without);
    picture = drawing.paint(part, kPixels);
  }
  bottom = drawing.is_endless() ? picture.seen_box().max().y() : drawing.box().max().y();
  return picture;
}

}  // namespace

void read_svg(const std::string& path, Extent, ModelScan& scan) {
  constexpr double kTolerance = 2;  // pixels, 0.1% of the longer side
  scan.fixed = path + ": a drawing is only read; write .obj";
  std::string without;
  if (scan.text.find("foreignObject") != std::string::npos) {
    without = "; the HTML in it (foreignObject) is left out";
    scan.model.notes.push_back(without.substr(2));
  }
  if (scan.text.find("<text") != std::string::npos) {
    without += "; text whose font-size is below 1/64 unit is not painted, convert it to paths";
  }
  double bottom = 0;
  const auto picture = close_picture(without_background(path, scan.text), path, without, bottom);
  auto& soup = scan.model.soup;
  for (const auto& loop : simplified(Tracer(picture).loops(), kTolerance)) {
    auto& polyline = soup.polylines.emplace_back(loop.size());
    std::iota(polyline.begin(), polyline.end(), static_cast<Index>(soup.points.size()));
    polyline.push_back(polyline.front());
    for (const auto& pixel : loop) {
      const Vector<2> place = picture.corner + pixel / picture.scale;
      soup.points.emplace_back(place.x(), bottom - place.y(), 0);
    }
  }
}

SvgDocument drawing_of(const std::string& text, const std::string& name) {
  const Drawing drawing(name, text);
  double bottom = drawing.box().max().y();
  if (drawing.is_endless()) close_picture(without_background(name, text), name, "", bottom);
  const Eigen::Affine2d upwards(Eigen::Translation2d(0, bottom) * Eigen::Scaling(1.0, -1.0));
  return {text, name, drawing.box().sizes(), upwards};
}

SvgDocument read_drawing(const std::string& path) {
  return drawing_of(read_file(path), path);
}

}  // namespace flbc::io
