// SPDX-License-Identifier: BSD-3-Clause
#include "model/svg_document.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "flbc/errors.h"
#include "model/svg_path.h"

namespace flbc::io {
namespace {

using pugi::xml_attribute;
using pugi::xml_node;

// Without the prefix of its namespace.
std::string_view local_name(const xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);  // npos + 1 is 0
}

bool is_one_of(std::string_view word, std::string_view words) {
  return words.find(" " + std::string(word) + " ") != std::string_view::npos;
}

// Changes the name of an element in its namespace.
void rename(xml_node node, const char* name) {
  const std::string_view whole = node.name();
  node.set_name((std::string(whole.substr(0, whole.find(':') + 1)) + name).c_str());
}

// The value of a property, from the style of an element or from its attribute.
std::string property_of(const xml_node& node, const std::string& name) {
  const std::string style = node.attribute("style").value();
  for (std::size_t at = 0; at < style.size();) {
    const auto end = std::min(style.find(';', at), style.size());
    const auto colon = style.find(':', at);
    const auto first = style.find_first_not_of(" \t\r\n", at);
    if (colon < end && style.compare(first, name.size(), name) == 0 &&
        style.find_first_not_of(" \t\r\n", first + name.size()) == colon) {
      return style.substr(colon + 1, end - colon - 1);
    }
    at = end + 1;
  }
  return node.attribute(name.c_str()).value();
}

// "url(#a)" -> "a", "#a" -> "a"; empty for others.
std::string id_in(const std::string& reference) {
  const auto begin = reference.find('#');
  if (begin == std::string::npos) return {};
  return reference.substr(begin + 1, reference.find_first_of("\"')", begin) - begin - 1);
}

xml_attribute href_of(const xml_node& node) {
  const auto href = node.attribute("href");
  return href ? href : node.attribute("xlink:href");
}

// Transforms of SVG up to the first error.
Affine2 transform_in(std::string_view text) {
  constexpr const char* kBlanks = " \t\r\n,";
  Affine2 all = Affine2::Identity();
  while (true) {
    const auto open = text.find('(');
    if (open == std::string_view::npos) return all;
    const auto first = text.find_first_not_of(kBlanks);
    const auto word = text.substr(first, open - first);
    const auto name = word.substr(0, word.find_last_not_of(kBlanks) + 1);
    text.remove_prefix(open + 1);
    double numbers[6] = {};
    int count = 0;
    while (count < 6 && take_number(text, numbers[count])) ++count;
    const auto close = text.find(')');
    if (close == std::string_view::npos) return all;
    text.remove_prefix(close + 1);
    const auto& [a, b, c, d, e, f] = numbers;
    Affine2 one = Affine2::Identity();
    if (name == "matrix" && count == 6) {
      one.matrix().topRows<2>() << a, c, e, b, d, f;
    } else if (name == "translate" && count > 0) {
      one.translate(Vector<2>(a, b));
    } else if (name == "scale" && count > 0) {
      one.scale(Vector<2>(a, count > 1 ? b : a));
    } else if (name == "rotate" && count > 0) {
      one = Eigen::Translation2d(b, c) * Eigen::Rotation2Dd(a * kPi / 180) *
            Eigen::Translation2d(-b, -c);
    } else if (name == "skewX" && count > 0) {
      one.matrix()(0, 1) = std::tan(a * kPi / 180);
    } else if (name == "skewY" && count > 0) {
      one.matrix()(1, 0) = std::tan(a * kPi / 180);
    } else {
      return all;
    }
    all = all * one;
  }
}

Affine2 transform_of(const xml_node& node) {
  return transform_in(node.attribute("transform").value());
}

std::string to_text(const Affine2& transform) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  const auto& m = transform.matrix();
  text << "matrix(" << m(0, 0) << ' ' << m(1, 0) << ' ' << m(0, 1) << ' ' << m(1, 1) << ' '
       << m(0, 2) << ' ' << m(1, 2) << ')';
  return text.str();
}

void set_attribute(xml_node node, const char* name, const std::string& value) {
  auto attribute = node.attribute(name);
  if (!attribute) attribute = node.append_attribute(name);
  attribute.set_value(value.c_str());
}

// A length in pixels. \param whole  of which percentages are parts
double length_of(const xml_node& node, const char* name, double whole, double usual = 0) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"px", 1},        {"cm", 96 / 2.54}, {"mm", 96 / 25.4}, {"in", 96}, {"pt", 96.0 / 72},
      {"pc", 96.0 / 6}, {"em", 16},        {"rem", 16},       {"ex", 8}};
  std::string_view text = node.attribute(name).value();
  double number = 0;
  if (!take_number(text, number)) return usual;
  if (!text.empty() && text.front() == '%') return number * whole / 100;
  for (const auto& [unit, pixels] : kUnits) {
    if (text.substr(0, unit.size()) == unit) return number * pixels;
  }
  return number;
}

using Size = Vector<2>;

Path path_of_points(const xml_node& node, bool is_closed) {
  std::string_view text = node.attribute("points").value();
  SubPath part;
  Vector<2> before, next;
  for (int k = 0; take_number(text, next.x()) && take_number(text, next.y()); ++k) {
    if (k > 0) part.cubics.push_back(Cubic::line(before, next));
    before = next;
  }
  if (part.cubics.empty()) return {};
  const Vector<2> begin = part.cubics.front().first();
  if (is_closed && before != begin) part.cubics.push_back(Cubic::line(before, begin));
  part.is_closed = is_closed;
  return {part};
}

Path rounded(const Vector<2>& corner, const Size& size, Vector<2> radii) {
  radii = radii.cwiseMin(size / 2);
  SubPath part;
  part.is_closed = true;
  const Vector<2> low = corner + radii, high = corner + size - radii;
  const Vector<2> centers[] = {{high.x(), low.y()}, high, {low.x(), high.y()}, low};
  const auto line_to = [&](const Vector<2>& to) {
    const Vector<2> from =
        part.cubics.empty() ? Vector<2>(low.x(), corner.y()) : part.cubics.back().last();
    if (from != to) part.cubics.push_back(Cubic::line(from, to));
  };
  const bool is_round = radii.minCoeff() > 0;
  for (int k = 0; k < 4; ++k) {
    const double angle = (k - 1) * kPi / 2;
    const auto turn = arc(centers[k], radii, angle, angle + kPi / 2);
    line_to(turn.front().first());
    if (is_round) part.cubics.push_back(turn.front());
  }
  line_to(Vector<2>(low.x(), corner.y()));
  return {part};
}

// The geometry of a shape in its own units. \param view  size of the viewport
Path path_of(const xml_node& node, const Size& view, bool& is_whole) {
  const auto name = local_name(node);
  const double diagonal = view.norm() / std::sqrt(2.0);
  const auto x = [&](const char* key) { return length_of(node, key, view.x()); };
  const auto y = [&](const char* key) { return length_of(node, key, view.y()); };
  if (name == "path") return parse_path(node.attribute("d").value(), is_whole);
  if (name == "polyline" || name == "polygon") return path_of_points(node, name == "polygon");
  if (name == "line") {
    return {{{Cubic::line({x("x1"), y("y1")}, {x("x2"), y("y2")})}, false}};
  }
  if (name == "rect") {
    const Size size(x("width"), y("height"));
    if (!(size.minCoeff() > 0)) return {};
    const double rx = length_of(node, "rx", view.x(), -1), ry = length_of(node, "ry", view.y(), -1);
    return rounded({x("x"), y("y")}, size,
                   Vector<2>(rx < 0 ? ry : rx, ry < 0 ? rx : ry).cwiseMax(0));
  }
  Vector<2> radii(x("rx"), y("ry"));
  if (name == "circle") radii.setConstant(length_of(node, "r", diagonal));
  if (!(radii.minCoeff() > 0)) return {};
  return {{arc({x("cx"), y("cy")}, radii, 0, 2 * kPi), true}};
}

constexpr std::string_view kPathShapes = " path rect circle ellipse line polyline polygon ";
// Attributes that a path has not.
constexpr std::string_view kOfShapes = " x y width height rx ry r cx cy x1 y1 x2 y2 points ";

// The map that a viewBox and preserveAspectRatio give to what is inside of a nested <svg>.
Affine2 view_of(const xml_node& node, const Vector<2>& corner, Size& size) {
  std::string_view text = node.attribute("viewBox").value();
  Vector<2> low;
  Size box;
  Affine2 inside = Affine2::Identity();
  if (take_number(text, low.x()) && take_number(text, low.y()) && take_number(text, box.x()) &&
      take_number(text, box.y()) && box.minCoeff() > 0) {
    const std::string ratio = node.attribute("preserveAspectRatio").value();
    Vector<2> scale = size.cwiseQuotient(box);
    Vector<2> at(0.5, 0.5);
    if (ratio.find("none") == std::string::npos) {
      const bool slices = ratio.find("slice") != std::string::npos;
      scale.setConstant(slices ? scale.maxCoeff() : scale.minCoeff());
      const auto part = [&](const char* low_word, const char* high_word) {
        return ratio.find(low_word) != std::string::npos    ? 0.0
               : ratio.find(high_word) != std::string::npos ? 1.0
                                                            : 0.5;
      };
      at = {part("xMin", "xMax"), part("YMin", "YMax")};
    }
    const Vector<2> rest = size - scale.cwiseProduct(box);
    inside = Eigen::Translation2d(at.cwiseProduct(rest)) * Eigen::Scaling(scale) *
             Eigen::Translation2d(-low);
    size = box;
  }
  return Eigen::Translation2d(corner) * inside;
}

std::string name_in_words(const xml_node& node) {
  const std::string id = node.attribute("id").value();
  return std::string(local_name(node)) + (id.empty() ? " without an id" : " '" + id + "'");
}

}  // namespace

struct SvgDocument::Content {
  // What follows the points.
  struct Target {
    xml_node element;
    Affine2 parent, own;  // from the units around the element to the points, and into the former
    Path path{};          // in units of the points; empty: the element moves by a map
    bool is_similarity = false;
    std::vector<Vector<2>> corners{};  // of an element that moves by a map, in units of the points
    std::size_t begin = 0, count = 0;  // of its points
    std::vector<std::pair<xml_node, Affine2>> gradients{};  // with their transform at rest
  };
  // An element that is to be visited.
  struct Visit {
    xml_node node;
    Affine2 to_root;
    Size view;
    std::vector<std::string> clips{};  // around the element, by id
  };

  std::string name;
  Vector<2> page;
  Affine2 to_model;
  pugi::xml_document document{};
  std::map<std::string, xml_node> by_id{};
  std::vector<Target> targets{};
  PointList<2> points{};
  std::vector<std::string> notes{};
  double drawing_size = 0;
  std::map<std::string, std::string> clips{};  // that were visited: their transform
  std::set<std::string> used_gradients{};
  int copies = 0, last_id = 1;

  void note(const std::string& text) {
    if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
  }

  void index_ids() {
    std::vector<xml_node> open{document.document_element()};
    while (!open.empty()) {
      const auto node = open.back();
      open.pop_back();
      if (const auto id = node.attribute("id")) by_id.emplace(id.value(), node);
      const auto kind = local_name(node);
      if (is_one_of(kind, " animate animateTransform animateMotion set ")) note("animations");
      if (is_one_of(kind, " pattern marker ")) note("patterns and markers, which keep their shape");
      for (const auto& child : node.children()) {
        if (child.type() == pugi::node_element) open.push_back(child);
      }
    }
  }

  // Counts elements before they are copied, of which a few may make very many.
  void count_copies(const xml_node& node) {
    constexpr int kMost = 100000;
    std::vector<xml_node> open{node};
    while (!open.empty()) {
      const auto next = open.back();
      open.pop_back();
      if (++copies > kMost) throw InputError(name + ": the drawing repeats too much by <use>");
      for (const auto& child : next.children()) open.push_back(child);
    }
  }

  xml_node copy_after(const xml_node& node, const std::string& id) {
    count_copies(node);
    auto copy = node.parent().insert_copy_after(node, node);
    set_attribute(copy, "id", id);
    by_id.emplace(id, copy);
    return copy;
  }

  std::string free_id(const std::string& id) {
    std::string other;
    do {
      other = id + "-" + std::to_string(++last_id);
    } while (by_id.count(other) > 0);
    return other;
  }

  // Replaces <use> by a group with a copy of what it shows. \return the group, or null
  xml_node unlink(xml_node use) {
    const auto found = by_id.find(id_in(href_of(use).value()));
    if (found == by_id.end() || is_one_of(local_name(found->second), " symbol svg ")) return {};
    for (auto above = use; above; above = above.parent()) {
      if (above == found->second) return {};  // it would contain itself
    }
    count_copies(found->second);
    const Vector<2> offset(length_of(use, "x", 0), length_of(use, "y", 0));
    use.remove_attribute(href_of(use));
    for (const char* key : {"x", "y", "width", "height"}) use.remove_attribute(key);
    rename(use, "g");
    if (!offset.isZero()) {
      const Affine2 moved = transform_of(use) * Eigen::Translation2d(offset);
      set_attribute(use, "transform", to_text(moved));
    }
    auto copy = use.append_copy(found->second);
    copy.remove_attribute("id");
    return use;
  }

  // Clips and masks bend with what they clip. One of elements in other places is copied.
  // \param inside  the element with its own transform
  void visit_clip(const Visit& inside, const char* property, std::vector<Visit>& open) {
    const auto& [node, to_root, view, around] = inside;
    const auto reference = property_of(node, property);
    const auto id = id_in(reference);
    const auto found = by_id.find(id);
    if (found == by_id.end()) return;
    // An element inside a clip may not be clipped by that clip: it would be copied forever.
    if (std::find(around.begin(), around.end(), id) != around.end()) return;
    auto clips_inside = around;
    clips_inside.push_back(id);
    auto clip = found->second;
    const char* const units = local_name(clip) == "mask" ? "maskContentUnits" : "clipPathUnits";
    if (clip.attribute(units).value() == std::string("objectBoundingBox")) {
      return note("clips and masks in units of the bounding box");
    }
    const auto place = to_text(to_root);
    const auto [known, is_new] = clips.emplace(id, place);
    if (!is_new && known->second == place) return;
    if (!is_new) {
      const auto other = free_id(id);
      clip = copy_after(clip, other);
      clips.emplace(other, place);
      replace_reference(node, property, id, other);
    }
    for (const auto& child : clip.children()) {
      if (child.type() == pugi::node_element)
        open.push_back({child, to_root * transform_of(clip), view, clips_inside});
    }
  }

  static void replace_reference(xml_node node, const char* property, const std::string& id,
                                const std::string& other) {
    std::string style = node.attribute("style").value();
    const auto at = style.find(std::string(property) + ":");
    const auto hash = at == std::string::npos ? at : style.find("#" + id, at);
    if (hash == std::string::npos) return set_attribute(node, property, "url(#" + other + ")");
    style.replace(hash + 1, id.size(), other);
    set_attribute(node, "style", style);
  }

  // A gradient in user space gets a map of its own, so one of several elements is copied.
  void take_gradient(Target& target, const char* property) {
    std::string reference;
    for (auto node = target.element; node && reference.empty(); node = node.parent()) {
      reference = property_of(node, property);
    }
    const auto id = id_in(reference);
    const auto found = by_id.find(id);
    if (found == by_id.end()) return;
    auto gradient = found->second;
    if (!is_one_of(local_name(gradient), " linearGradient radialGradient ")) return;
    // Units and transform may come from another gradient.
    xml_attribute units, transform;
    auto from = gradient;
    for (int depth = 0; from && depth < 32; ++depth) {
      if (!units) units = from.attribute("gradientUnits");
      if (!transform) transform = from.attribute("gradientTransform");
      const auto next = by_id.find(id_in(href_of(from).value()));
      from = next == by_id.end() ? xml_node() : next->second;
    }
    if (units.value() != std::string("userSpaceOnUse")) return;
    const Affine2 rest = transform_in(transform.value());
    if (!used_gradients.insert(id).second) {
      const auto other = free_id(id);
      gradient = copy_after(gradient, other);
      replace_reference(target.element, property, id, other);
    }
    target.gradients.emplace_back(gradient, rest);
  }

  void add_shape(xml_node node, const Affine2& parent, const Size& view) {
    bool is_whole = true;
    Target target{node, parent, transform_of(node)};
    const Affine2 to_root = parent * target.own;
    const double scale = std::abs(to_root.linear().determinant());
    target.path = path_of(node, view, is_whole);
    if (!is_whole) note("the rest of the path data of " + name_in_words(node) + ", after an error");
    if (target.path.empty()) return;
    if (!(scale > 1e-12 * to_root.linear().squaredNorm())) {
      return note(name_in_words(node) + ", which its transform flattens");
    }
    for (auto& part : target.path) {
      for (auto& cubic : part.cubics) cubic.points = to_root * cubic.points;
    }
    if (local_name(node) != "path") {
      for (auto attribute = node.first_attribute(); attribute;) {
        const auto next = attribute.next_attribute();
        if (is_one_of(attribute.name(), kOfShapes)) node.remove_attribute(attribute);
        attribute = next;
      }
      rename(node, "path");
    }
    take_gradient(target, "fill");
    take_gradient(target, "stroke");
    targets.push_back(std::move(target));
  }

  // An element that moves by the map that fits its corners best.
  void add_moving(const xml_node& node, const Affine2& parent, const Size& view) {
    const auto kind = local_name(node);
    Target target{node, parent, transform_of(node)};
    target.is_similarity = kind != "image";
    const Affine2 to_root = parent * target.own;
    Vector<2> corner(length_of(node, "x", view.x()), length_of(node, "y", view.y()));
    Size size(length_of(node, "width", view.x()), length_of(node, "height", view.y()));
    if (kind == "text") {
      const auto font = property_of(node, "font-size");
      const auto child = node.child("tspan");
      if (!node.attribute("x")) corner.x() = length_of(child, "x", view.x(), corner.x());
      if (!node.attribute("y")) corner.y() = length_of(child, "y", view.y(), corner.y());
      std::string_view height = font;
      double em = 16;
      take_number(height, em);
      size.setConstant(em);
    }
    note(kind == "text"    ? "text, which moves but does not bend; convert it to paths to bend it"
         : kind == "image" ? "pictures, which move by an affine map"
                           : "symbols and HTML, which move but do not bend");
    constexpr int kSteps = 2;
    for (int i = 0; i <= kSteps; ++i) {
      for (int k = 0; k <= kSteps; ++k) {
        const Vector<2> part(static_cast<double>(i) / kSteps, static_cast<double>(k) / kSteps);
        target.corners.push_back(to_root * Vector<2>(corner + part.cwiseProduct(size)));
      }
    }
    targets.push_back(std::move(target));
  }

  void visit(const Visit& visit, std::vector<Visit>& open) {
    auto node = visit.node;
    auto kind = local_name(node);
    auto [to_root, view] = std::pair(visit.to_root, visit.view);
    if (is_one_of(kind,
                  " defs symbol clipPath mask marker pattern linearGradient radialGradient "
                  "filter style script title desc metadata namedview ")) {
      return;
    }
    if (kind == "use") {
      const auto group = unlink(node);
      if (!group) return add_moving(node, to_root, view);
      kind = "g";
    }
    const Affine2 inside = to_root * transform_of(node);
    visit_clip({node, inside, view, visit.clips}, "clip-path", open);
    visit_clip({node, inside, view, visit.clips}, "mask", open);
    if (is_one_of(kind, kPathShapes)) return add_shape(node, to_root, view);
    if (is_one_of(kind, " text image foreignObject ")) return add_moving(node, to_root, view);
    Affine2 own = inside;
    if (kind == "svg" && node != document.document_element()) {
      const Vector<2> corner(length_of(node, "x", view.x()), length_of(node, "y", view.y()));
      view = Size(length_of(node, "width", view.x(), view.x()),
                  length_of(node, "height", view.y(), view.y()));
      own = inside * view_of(node, corner, view);
    }
    for (auto child = node.last_child(); child; child = child.previous_sibling()) {
      if (child.type() == pugi::node_element) open.push_back({child, own, view, visit.clips});
    }
  }

  void visit_all(const Visit& first) {
    std::vector<Visit> open{first};
    while (!open.empty()) {
      const auto next = open.back();
      open.pop_back();
      visit(next, open);
    }
  }

  void take_points() {
    Eigen::AlignedBox<double, 2> box;
    for (const auto& target : targets) {
      for (const auto& part : target.path) {
        for (const auto& cubic : part.cubics) {
          for (const auto& point : cubic.points.colwise()) box.extend(Vector<2>(point));
        }
      }
    }
    drawing_size = box.isEmpty() ? 1 : std::max(box.sizes().maxCoeff(), 1e-300);
    std::vector<Vector<2>> all;
    for (auto& target : targets) {
      const auto own = points_of(target);
      target.begin = all.size();
      target.count = own.size();
      constexpr double kMost = 1e15;
      for (const auto& point : own) {
        if ((point.array().abs() < kMost).all()) continue;
        throw InputError(name + ": the coordinates of " + name_in_words(target.element) +
                         " are out of range");
      }
      all.insert(all.end(), own.begin(), own.end());
    }
    points = Eigen::Map<PointList<2>>(all.front().data(), 2, static_cast<Eigen::Index>(all.size()));
  }

  // Samples are not kept, because those of a large drawing fill the memory.
  std::vector<Vector<2>> points_of(const Target& target) const {
    return target.path.empty() ? target.corners : PathSamples(target.path, drawing_size).points();
  }

  void move(Target& target, const PointList<2>& moved) const {
    std::vector<Vector<2>> to(target.count);
    for (std::size_t k = 0; k < to.size(); ++k) {
      to[k] = moved.col(static_cast<Eigen::Index>(target.begin + k));
    }
    if (target.path.empty()) {
      const Affine2 map = fitted_map(target.corners, to, target.is_similarity);
      const Affine2 own = target.parent.inverse() * map * target.parent * target.own;
      return set_attribute(target.element, "transform", to_text(own));
    }
    constexpr double kTolerance = 5e-4, kDigits = 1e-6;  // of the size of the drawing
    const Affine2 to_root = target.parent * target.own, back = to_root.inverse();
    const PathSamples samples(target.path, drawing_size);
    auto path = samples.fitted(to, kTolerance * drawing_size);
    for (auto& part : path) {
      for (auto& cubic : part.cubics) cubic.points = back * cubic.points;
    }
    const double unit =
        kDigits * drawing_size / std::sqrt(std::abs(to_root.linear().determinant()));
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(unit))), 0, 12);
    set_attribute(target.element, "d", io::to_text(path, decimals));
    const auto& from = samples.points();
    for (auto& [gradient, rest] : target.gradients) {
      const Affine2 map = back * fitted_map(from, to, false) * to_root;
      set_attribute(gradient, "gradientTransform", to_text(map * rest));
    }
  }
};

SvgDocument::SvgDocument(const std::string& text, std::string name, const Vector<2>& page,
                         const Affine2& to_model)
    : content_(std::make_unique<Content>()) {
  auto& content = *content_;
  content.name = std::move(name);
  content.page = page;
  content.to_model = to_model;
  // Entities and line ends stay as they are.
  constexpr unsigned int kAsItIs = pugi::parse_cdata | pugi::parse_pi | pugi::parse_comments |
                                   pugi::parse_declaration | pugi::parse_doctype |
                                   pugi::parse_ws_pcdata;
  const auto result = content.document.load_buffer(text.data(), text.size(), kAsItIs);
  if (!result) {
    throw InputError(content.name + ": not XML: " + result.description() + " at byte " +
                     std::to_string(result.offset));
  }
  const auto root = content.document.document_element();
  if (local_name(root) != "svg") {
    throw InputError(content.name + ": not a drawing in SVG; the first element is <" +
                     std::string(root.name()) + ">");
  }
  content.index_ids();
  Size view = page;
  const Affine2 inside = view_of(root, Vector<2>::Zero(), view);
  content.visit_all({root, to_model * inside, view});
  if (content.targets.empty()) throw InputError(content.name + ": the drawing has no shapes");
  content.take_points();
}

SvgDocument::~SvgDocument() = default;
SvgDocument::SvgDocument(SvgDocument&&) noexcept = default;
SvgDocument& SvgDocument::operator=(SvgDocument&&) noexcept = default;

const Vector<2>& SvgDocument::page() const {
  return content_->page;
}

const Eigen::Affine2d& SvgDocument::to_model() const {
  return content_->to_model;
}

const PointList<2>& SvgDocument::points() const {
  return content_->points;
}

std::string SvgDocument::element_of(Index point) const {
  const auto& targets = content_->targets;
  const auto after =
      std::upper_bound(targets.begin(), targets.end(), static_cast<std::size_t>(point),
                       [](std::size_t p, const auto& target) { return p < target.begin; });
  return name_in_words(std::prev(after)->element);
}

std::string SvgDocument::moved(const PointList<2>& moved) const {
  for (auto& target : content_->targets) content_->move(target, moved);
  std::ostringstream text;
  content_->document.save(text, "",
                          pugi::format_raw | pugi::format_no_escapes | pugi::format_no_declaration);
  return text.str();
}

const std::vector<std::string>& SvgDocument::notes() const {
  return content_->notes;
}

}  // namespace flbc::io
