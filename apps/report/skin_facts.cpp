// SPDX-License-Identifier: BSD-3-Clause
#include "report/skin_facts.h"

#include "front/facts.h"

namespace flbc::app {

template <int Dim>
std::string describe_skin(const gltf::ExportedSkin& skin, const gltf::Animation<Dim>& animation,
                          double size) {
  constexpr Index kOneSet = 4;  // influences that every reader knows
  Facts facts;
  facts << skin.vertices << " vertices, " << skin.triangles << " triangles, " << skin.joints
        << " joints";
  if (!animation.poses.empty()) {
    facts << ", of which " << skin.moving_joints << " move within " << animation.times.back()
          << " s";
  }
  facts << ", at most " << skin.influences << " influences per vertex";
  if (skin.given_influences > skin.influences) facts << " (before " << skin.given_influences << ")";
  if (skin.influences > kOneSet) {
    facts << "; readers of one set, such as three.js, use the largest 4 (-k 4 suits all readers)";
  }
  const auto& error = skin.deformation_error;
  if (error.max > 0) {
    facts << "; deformation error over "
          << (animation.poses.empty() ? "random smooth poses " : "these poses ")
          << 100 * error.rms / size << "% rms, " << 100 * error.max / size << "% max of the size";
  }
  if (skin.position_change > gltf::kVisibleChange * size) {
    facts << "; single precision moves vertices by up to " << skin.position_change / size
          << " of the size; move the cage and the model closer to the origin";
  }
  return facts.text();
}

template std::string describe_skin(const gltf::ExportedSkin&, const gltf::Animation<2>&, double);
template std::string describe_skin(const gltf::ExportedSkin&, const gltf::Animation<3>&, double);

}  // namespace flbc::app
