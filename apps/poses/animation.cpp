// SPDX-License-Identifier: BSD-3-Clause
#include "poses/animation.h"

#include "flbc/errors.h"
#include "flbc/io/keyframes.h"

namespace flbc::app {

template <int Dim>
gltf::Animation<Dim> load_animation(const CageFiles& files, double frames_per_second,
                                    const PointList<Dim>& rest) {
  gltf::Animation<Dim> animation;
  for (auto& pose : load_poses<Dim>(files)) {
    if (pose.points.cols() != rest.cols()) {
      throw InputError(pose.name + ": has " + std::to_string(pose.points.cols()) +
                       " vertices, but the cage has " + std::to_string(rest.cols()));
    }
    animation.times.push_back(static_cast<double>(animation.poses.size()) / frames_per_second);
    animation.poses.push_back(std::move(pose.points));
  }
  return animation;
}

template <int Dim>
gltf::Animation<Dim> load_animation(const std::string& keyframes, const PointList<Dim>& rest) {
  gltf::Animation<Dim> animation;
  for (auto& pose : load_keyframes<Dim>(keyframes, rest)) {
    animation.poses.push_back(std::move(pose.points));
  }
  for (const auto& keyframe : io::read_keyframes(keyframes)) {
    animation.times.push_back(keyframe.time);
  }
  return animation;
}

template gltf::Animation<2> load_animation(const CageFiles&, double, const PointList<2>&);
template gltf::Animation<3> load_animation(const CageFiles&, double, const PointList<3>&);
template gltf::Animation<2> load_animation(const std::string&, const PointList<2>&);
template gltf::Animation<3> load_animation(const std::string&, const PointList<3>&);

}  // namespace flbc::app
