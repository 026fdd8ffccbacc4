// SPDX-License-Identifier: BSD-3-Clause
#include "draw/stroke_font.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace flbc::draw {
namespace {

// Digits are 6 wide and 9 high on the grid; strokes are points "xy", separated by commas; below the
// baseline y is "/" for -1, "." for -2 and "-" for -3, as in the order of ASCII. "~" marks
// a stroke that is rounded: its points are the control polygon of a quadratic B-spline.
struct Glyph {
  char character;
  int width;
  std::string_view strokes;
};

constexpr Glyph kGlyphs[] = {
    {'0', 6, "~39 09 00 60 69 39"},
    {'1', 4, "07 29 20,00 40"},
    {'2', 6, "~07 09 69 65 22 00,00 60"},
    {'3', 6, "~07 09 69 65 25,~25 65 60 00 02"},
    {'4', 6, "63 03 49 40"},
    {'5', 6, "59 19 05,~05 17 66 60 00 02"},
    {'6', 6, "~59 18 03,~36 06 00 60 66 36"},
    {'7', 6, "09 69 20"},
    {'8', 6, "~39 09 05 65 69 39,~35 05 00 60 65 35"},
    {'9', 6, "~11 51 66,~33 63 69 09 03 33"},
    {'.', 0, "00"},
    {'-', 4, "04 44"},
    {'<', 5, "57 04 51"},
    {'>', 5, "07 54 01"},
    {'a', 6, "66 60,~63 66 06 00 60 63"},
    {'b', 6, "09 00,~03 06 66 60 00 03"},
    {'c', 5, "~55 46 06 00 40 51"},
    {'d', 6, "69 60,~63 66 06 00 60 63"},
    {'e', 6, "03 63,~63 66 06 00 51"},
    {'f', 4, "~49 19 16,16 10,06 36"},
    {'g', 6, "66 61,~61 6- 0- 0/,~63 66 06 00 60 63"},
    {'h', 6, "09 00,~03 06 66 63,63 60"},
    {'i', 0, "06 00,08"},
    {'j', 2, "26 2/,~2/ 2- 0-,28"},
    {'k', 5, "09 00,56 02,24 50"},
    {'l', 0, "09 00"},
    {'m', 8, "06 00,~03 06 46 43,43 40,~43 46 86 83,83 80"},
    {'n', 6, "06 00,~03 06 66 63,63 60"},
    {'o', 6, "~36 06 00 60 66 36"},
    {'p', 6, "06 0-,~03 06 66 60 00 03"},
    {'q', 6, "66 6-,~63 66 06 00 60 63"},
    {'r', 4, "06 00,~03 06 46"},
    {'s', 5, "~55 46 06 03 53 50 10 01"},
    {'t', 4, "19 12,~12 10 40,06 46"},
    {'u', 6, "06 03,~03 00 60 63,66 60"},
    {'v', 6, "06 30 66"},
    {'w', 8, "06 20 45 60 86"},
    {'x', 6, "06 60,66 00"},
    {'y', 6, "06 30,66 1-"},
    {'z', 6, "06 66 00 60"},
    {'A', 6, "00 39 60,13 53"},
    {'B', 6, "00 09 29,~29 69 65 25,25 05,~25 65 60 20,20 00"},
    {'C', 6, "~68 59 09 00 50 61"},
    {'D', 6, "00 09 29,~29 69 60 20,20 00"},
    {'E', 5, "59 09 00 50,05 45"},
    {'F', 5, "59 09 00,05 45"},
    {'G', 6, "~68 59 09 00 60 64,64 44"},
    {'H', 6, "09 00,69 60,05 65"},
    {'I', 0, "09 00"},
    {'J', 5, "59 53,~53 50 00 02"},
    {'K', 6, "09 00,69 04,26 60"},
    {'L', 5, "09 00 50"},
    {'M', 8, "00 09 43 89 80"},
    {'N', 6, "00 09 60 69"},
    {'O', 8, "~49 09 00 80 89 49"},
    {'P', 6, "00 09 29,~29 69 64 24,24 04"},
    {'Q', 8, "~49 09 00 80 89 49,52 8/"},
    {'R', 6, "00 09 29,~29 69 64 24,24 04,34 60"},
    {'S', 6, "~68 59 09 05 65 60 10 01"},
    {'T', 6, "09 69,39 30"},
    {'U', 6, "09 03,~03 00 60 63,63 69"},
    {'V', 6, "09 30 69"},
    {'W', 8, "09 20 47 60 89"},
    {'X', 6, "09 60,69 00"},
    {'Y', 6, "09 35 69,35 30"},
    {'Z', 6, "09 69 00 60"},
    {',', 1, "10 0."},
    {':', 0, "00,05"},
    {'/', 4, "0/ 49"},
    {'_', 6, "0/ 6/"},
    {'(', 2, "~29 07 02 2/"},
    {')', 2, "~09 27 22 0/"},
    {'[', 2, "29 09 0/ 2/"},
    {']', 2, "09 29 2/ 0/"},
    {'+', 4, "04 44,22 26"},
    {'=', 4, "03 43,05 45"},
    {'%', 8, "00 89,~19 09 06 26 29 19,~73 63 60 80 83 73"},
    {'!', 0, "09 03,00"},
    {'?', 5, "~08 09 59 45 23,20"},
    {'|', 0, "09 0-"},
};

constexpr double kUnitsPerHeight = 9;
constexpr int kGap = 3;
constexpr int kSpaceWidth = 3;
constexpr double kStrokeUnits = 1.15;

const Glyph* find_glyph(char character) {
  const auto* const found =
      std::find_if(std::begin(kGlyphs), std::end(kGlyphs),
                   [character](const Glyph& glyph) { return glyph.character == character; });
  return found == std::end(kGlyphs) ? nullptr : found;
}

int width_of(char character) {
  const Glyph* const glyph = find_glyph(character);
  return glyph != nullptr ? glyph->width : kSpaceWidth;
}

using Polyline = std::vector<Vector<2>>;

Polyline parse_points(std::string_view stroke) {
  Polyline points;
  for (std::size_t i = 0; i + 1 < stroke.size(); i += 3) {
    points.emplace_back(stroke[i] - '0', stroke[i + 1] - '0');
  }
  return points;
}

// Cutting corners at a quarter of each edge, and at half of the first and last one, converges to
// the quadratic B-spline that starts and ends at the ends of its control polygon.
Polyline cut_corners(const Polyline& points) {
  Polyline result{points.front()};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (i == 0 || i + 2 == points.size()) {
      result.push_back(0.5 * (points[i] + points[i + 1]));
    } else {
      result.push_back(0.75 * points[i] + 0.25 * points[i + 1]);
      result.push_back(0.25 * points[i] + 0.75 * points[i + 1]);
    }
  }
  result.push_back(points.back());
  return result;
}

Polyline parse_stroke(std::string_view stroke) {
  if (stroke.front() != '~') return parse_points(stroke);
  Polyline points = parse_points(stroke.substr(1));
  for (int round = 0; round < 4; ++round) points = cut_corners(points);
  return points;
}

void append_glyph(const StrokedGlyph& glyph, const Vector<2>& position, double height,
                  std::vector<Segment>& segments) {
  const auto place = [&](const Vector<2>& p) {
    return Vector<2>(position.x() + height * p.x(), position.y() - height * p.y());
  };
  for (const auto& points : glyph.strokes) {
    if (points.size() == 1) segments.push_back({place(points[0]), place(points[0])});
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      segments.push_back({place(points[i]), place(points[i + 1])});
    }
  }
}

}  // namespace

StrokedGlyph stroked_glyph(char character) {
  StrokedGlyph result;
  result.advance = (width_of(character) + kGap) / kUnitsPerHeight;
  const Glyph* const glyph = find_glyph(character);
  std::string_view rest = glyph != nullptr ? glyph->strokes : std::string_view();
  while (!rest.empty()) {
    const auto comma = std::min(rest.find(','), rest.size());
    Polyline points = parse_stroke(rest.substr(0, comma));
    for (auto& p : points) p /= kUnitsPerHeight;
    result.strokes.push_back(std::move(points));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return result;
}

double stroke_width() {
  return kStrokeUnits / kUnitsPerHeight;
}

double text_width(std::string_view text, double height) {
  int units = 0;
  for (const char character : text) units += width_of(character) + kGap;
  return std::max(0, units - kGap) * height / kUnitsPerHeight;
}

void draw_text(Canvas& canvas, const Vector<2>& position, std::string_view text, double height,
               Color color) {
  if (canvas.keep_text(position, text, height, color)) return;
  std::vector<Segment> segments;
  Vector<2> cursor = position;
  for (const char character : text) {
    const auto glyph = stroked_glyph(character);
    append_glyph(glyph, cursor, height, segments);
    cursor.x() += glyph.advance * height;
  }
  canvas.draw_segments(segments, stroke_width() * height, color);
}

}  // namespace flbc::draw
