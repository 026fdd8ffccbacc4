// SPDX-License-Identifier: BSD-3-Clause
#include "files/upright.h"

#include <cmath>
#include <map>
#include <sstream>
#include <string>

#include <Eigen/Geometry>

#include "flbc/errors.h"
#include "help/options.h"

namespace flbc::app {
namespace {

const std::map<std::string, UpAxis> kAxes{
    {"x", UpAxis::kX}, {"y", UpAxis::kY}, {"z", UpAxis::kZ}, {"auto", UpAxis::kAuto}};

// \throws OptionError if it is neither a name nor two angles in degrees
draw::ObliqueView parse_view(const std::string& text) {
  if (text == "front") return draw::view_by_angles(0, 0);
  if (text == "side") return draw::view_by_angles(90, 0);
  if (text == "top") return draw::view_by_angles(0, 90);
  if (text == "three-quarter") return ModelView().direction;
  std::istringstream numbers(text);
  double azimuth = 0, elevation = 0;
  char comma = 0;
  if (numbers >> azimuth >> comma >> elevation && comma == ',' &&
      numbers.peek() == std::char_traits<char>::eof() && std::abs(elevation) <= 90) {
    return draw::view_by_angles(azimuth, elevation);
  }
  throw OptionError(
      "--view: invalid value '" + text +
      "'; choose from front|side|top|three-quarter, or give AZIMUTH,ELEVATION in degrees");
}

}  // namespace

CLI::Option* add_up_option(CLI::App& command, UpAxis& up) {
  return add_choice(
      command, "--up", {"x", "y", "z", "auto"},
      [&up](const std::string& word) { up = kAxes.at(word); },
      "axis of a 3D model that points up (default: auto: y for glTF, otherwise by its lowest "
      "vertices)");
}

std::vector<CLI::Option*> add_view_options(CLI::App& command, ModelView& view) {
  auto* direction = command.add_option_function<std::string>(
      "--view", [&view](const std::string& text) { view.direction = parse_view(text); },
      "view direction of a 3D model relative to its front, as a name or as angles in degrees "
      "(default: three-quarter)");
  direction->type_name("front|side|top|three-quarter|AZIMUTH,ELEVATION");
  return {direction, add_up_option(command, view.up)};
}

draw::ObliqueView view_of(const ModelView& view, const PointList<3>& points) {
  const int up = up_axis(view.up, points);
  const double front = front_azimuth(up, points) * draw::kDegree;
  return draw::before_turn(view.direction,
                           Eigen::AngleAxisd(-front, Vector<3>::UnitY()) * turn_upright(up));
}

}  // namespace flbc::app
