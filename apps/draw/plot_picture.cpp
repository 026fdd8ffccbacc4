// SPDX-License-Identifier: BSD-3-Clause
#include "draw/plot_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "draw/layout.h"
#include "draw/weight_painter.h"
#include "flbc/errors.h"

namespace flbc::draw {
namespace {

constexpr Color kGrid{0.87F, 0.88F, 0.90F};

// Distinct with every common kind of color blindness (Okabe and Ito 2008).
constexpr Color kCurveColors[] = {
    {0.00F, 0.45F, 0.70F}, {0.84F, 0.37F, 0.00F}, {0.00F, 0.62F, 0.45F}, {0.80F, 0.47F, 0.65F},
    {0.90F, 0.62F, 0.00F}, {0.34F, 0.71F, 0.91F}, {0.13F, 0.15F, 0.19F}};

Color curve_color(std::size_t run) {
  return kCurveColors[run % (sizeof kCurveColors / sizeof kCurveColors[0])];
}

// "1e-7" rather than "1e-07".
std::string tick_text(double value) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(4);
  stream << value;
  auto text = stream.str();
  const auto exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  const auto digits = text.find_first_not_of("+-0", exponent + 1);
  const std::string sign = text[exponent + 1] == '-' ? "-" : "";
  return text.substr(0, exponent + 1) + sign + text.substr(digits);
}

// An axis from low to high, in the values shown or in their decades.
struct Axis {
  double low = 0;
  double high = 1;
  std::vector<double> ticks{};
  bool logarithmic = false;

  std::string label(double tick) const {
    return tick_text(logarithmic ? std::pow(10.0, tick) : tick);
  }
};

Axis linear_axis(double low, double high) {
  if (!(high > low)) {
    const double half = std::max(std::abs(low) * 0.05, 1e-12);
    low -= half;
    high += half;
  }
  constexpr int kTicks = 5;
  const double rough = (high - low) / kTicks;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = rough <= 2 * power ? 2 * power : rough <= 5 * power ? 5 * power : 10 * power;
  Axis axis{low, high, {}, false};
  const double first = std::ceil(low / step);
  const auto steps = static_cast<int>(std::floor(high * (1 + 1e-12) / step) - first);
  for (int k = 0; k <= steps; ++k) axis.ticks.push_back((first + k) * step);
  return axis;
}

Axis decade_axis(double low, double high) {
  Axis axis{std::floor(low), std::ceil(high), {}, true};
  if (!(axis.high > axis.low)) axis.high = axis.low + 1;
  constexpr double kTicks = 7;
  const double step = std::max(1.0, std::ceil((axis.high - axis.low) / kTicks));
  const auto steps = static_cast<int>((axis.high - axis.low) / step);
  for (int k = 0; k <= steps; ++k) axis.ticks.push_back(axis.low + k * step);
  return axis;
}

// What of a curve can be shown.
std::vector<Vector<2>> shown_points(const std::vector<Vector<2>>& curve, bool logarithmic) {
  std::vector<Vector<2>> points;
  for (const auto& p : curve) {
    if (!p.allFinite() || (logarithmic && !(p.y() > 0))) continue;
    points.emplace_back(p.x(), logarithmic ? std::log10(p.y()) : p.y());
  }
  return points;
}

// One panel on the canvas, its box being that of the axes.
class PanelPainter {
 public:
  PanelPainter(Canvas& canvas, const PlotPanel& panel, const Box& box, double unit)
      : canvas_(canvas), panel_(panel), box_(box), unit_(unit) {
    Vector<2> low = Vector<2>::Constant(std::numeric_limits<double>::infinity());
    Vector<2> high = -low;
    for (const auto& curve : panel.curves) {
      curves_.push_back(shown_points(curve, panel.logarithmic));
      for (const auto& p : curves_.back()) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
    if (!low.allFinite()) {
      throw InputError("there is nothing to plot for '" + panel.y_label + "'");
    }
    x_ = linear_axis(std::min(0.0, low.x()), high.x());
    y_ = panel.logarithmic ? decade_axis(low.y(), high.y()) : linear_axis(low.y(), high.y());
  }

  void paint() const {
    paint_axes();
    for (std::size_t run = 0; run < curves_.size(); ++run) {
      std::vector<Segment> segments;
      for (std::size_t k = 0; k + 1 < curves_[run].size(); ++k) {
        segments.push_back({pixel(curves_[run][k]), pixel(curves_[run][k + 1])});
      }
      canvas_.draw_segments(segments, 2.2 * unit_, curve_color(run));
      if (!curves_[run].empty()) {
        canvas_.fill_discs({pixel(curves_[run].back())}, 3.6 * unit_, curve_color(run));
      }
    }
  }

 private:
  Vector<2> pixel(const Vector<2>& p) const {
    return {box_.low.x() + (p.x() - x_.low) / (x_.high - x_.low) * box_.size().x(),
            box_.high.y() - (p.y() - y_.low) / (y_.high - y_.low) * box_.size().y()};
  }

  void paint_axes() const {
    const double height = 13 * unit_;
    std::vector<Segment> grid;
    for (const double tick : x_.ticks) {
      const double x = pixel({tick, y_.low}).x();
      grid.push_back({{x, box_.low.y()}, {x, box_.high.y()}});
      const auto text = x_.label(tick);
      canvas_.draw_text({x - text_width(text, height) / 2, box_.high.y() + 2 * height}, text,
                        height, kInk);
    }
    for (const double tick : y_.ticks) {
      const double y = pixel({x_.low, tick}).y();
      grid.push_back({{box_.low.x(), y}, {box_.high.x(), y}});
      const auto text = y_.label(tick);
      canvas_.draw_text({box_.low.x() - text_width(text, height) - 9 * unit_, y + height / 2}, text,
                        height, kInk);
    }
    canvas_.draw_segments(grid, 1 * unit_, kGrid);
    canvas_.draw_segments({{{box_.low.x(), box_.low.y()}, {box_.low.x(), box_.high.y()}},
                           {{box_.low.x(), box_.high.y()}, {box_.high.x(), box_.high.y()}}},
                          1.4 * unit_, kInk);
    canvas_.draw_text({box_.low.x(), box_.low.y() - 14 * unit_}, panel_.y_label, 15 * unit_, kInk);
    const auto& label = panel_.x_label;
    canvas_.draw_text({box_.high.x() - text_width(label, 15 * unit_), box_.high.y() + 52 * unit_},
                      label, 15 * unit_, kInk);
  }

  Canvas& canvas_;
  const PlotPanel& panel_;
  Box box_;
  double unit_;
  std::vector<std::vector<Vector<2>>> curves_;
  Axis x_;
  Axis y_;
};

// Where the entries of the legend begin, in as many rows as they need.
std::vector<Vector<2>> plan_legend(const std::vector<std::string>& names, double width,
                                   double unit) {
  const double margin = 40 * unit;
  std::vector<Vector<2>> places;
  Vector<2> place(margin, 40 * unit);
  for (const auto& name : names) {
    const double length = text_width(name, 15 * unit) + 90 * unit;
    if (place.x() > margin && place.x() + length > width - margin) {
      place = {margin, place.y() + 32 * unit};
    }
    places.push_back(place);
    place.x() += length;
  }
  return places;
}

}  // namespace

std::string draw_plot(const std::vector<std::string>& names, const std::vector<PlotPanel>& panels,
                      int columns, const WeightPictureOptions& options) {
  validate(options);
  if (names.empty() || panels.empty() || columns < 1) throw InputError("there is nothing to plot");
  for (const auto& panel : panels) {
    if (panel.curves.size() != names.size()) {
      throw InputError("'" + panel.y_label + "' has " + std::to_string(panel.curves.size()) +
                       " curves, but there are " + std::to_string(names.size()) + " runs");
    }
  }
  const double unit = pixel_unit(options);
  const auto legend = plan_legend(names, options.width, unit);
  const double top = legend.back().y() + 24 * unit;
  const Vector<2> low(100 * unit, 52 * unit), rest(130 * unit, 124 * unit);
  const Vector<2> cell(static_cast<double>(options.width) / columns, 400 * unit);
  const auto rows = static_cast<int>((panels.size() + columns - 1) / columns);
  Canvas canvas(options.width, static_cast<int>(std::lround(top + rows * cell.y())),
                options.format);
  for (std::size_t run = 0; run < names.size(); ++run) {
    const auto& place = legend[run];
    canvas.draw_segments({{place, place + Vector<2>(34 * unit, 0)}}, 3 * unit, curve_color(run));
    canvas.draw_text(place + Vector<2>(46 * unit, 7 * unit), names[run], 15 * unit, kInk);
  }
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const auto column = static_cast<int>(k) % columns, row = static_cast<int>(k) / columns;
    const Vector<2> corner = Vector<2>(column * cell.x(), top + row * cell.y()) + low;
    PanelPainter(canvas, panels[k], {corner, corner + cell - rest}, unit).paint();
  }
  return canvas.encode();
}

}  // namespace flbc::draw
