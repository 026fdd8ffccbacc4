// SPDX-License-Identifier: BSD-3-Clause
#include "files/upright.h"

#include <map>
#include <string>

#include <Eigen/Geometry>

#include "help/options.h"

namespace flbc::app {
namespace {

const std::map<std::string, UpAxis> kAxes{
    {"x", UpAxis::kX}, {"y", UpAxis::kY}, {"z", UpAxis::kZ}, {"auto", UpAxis::kAuto}};

}  // namespace

CLI::Option* add_up_option(CLI::App& command, UpAxis& up) {
  return add_choice(
      command, "--up", {"x", "y", "z", "auto"},
      [&up](const std::string& word) { up = kAxes.at(word); },
      "axis of a 3D model that points up (default: auto: y for glTF, otherwise by its lowest "
      "vertices)");
}

draw::ObliqueView view_of(UpAxis up, const PointList<3>& points) {
  const int axis = up_axis(up, points);
  const double front = front_azimuth(axis, points) * draw::kDegree;
  return draw::before_turn(draw::view_by_angles(draw::kUsualAzimuth, draw::kUsualElevation),
                           Eigen::AngleAxisd(-front, Vector<3>::UnitY()) * turn_upright(axis));
}

}  // namespace flbc::app
