// SPDX-License-Identifier: BSD-3-Clause
#include "report/skin_facts.h"

#include <vector>

#include "front/facts.h"

namespace flbc::app {
namespace {

// What engines document, or have by default; 0 = no limit. The page on engines has this table.
struct Engine {
  const char* name;
  Index joints, influences;
};
constexpr Engine kEngines[] = {
    {"Unity", 0, 255},  {"Unreal", 65536, 8}, {"Godot", 0, 8},
    {"three.js", 0, 4}, {"Babylon.js", 0, 8}, {"VRChat", 400, 4},
    {"Roblox", 0, 4},   {"libGDX", 12, 4},    {"Filament", 256, 4},
};

std::string describe_engines(Index joints, Index influences) {
  std::vector<std::string> fitting, others;
  for (const auto& engine : kEngines) {
    const bool has_joints = engine.joints == 0 || joints <= engine.joints;
    const bool has_influences = influences <= engine.influences;
    if (has_joints && has_influences) {
      fitting.emplace_back(engine.name);
    } else {
      others.push_back(std::string(engine.name) + " (" +
                       (has_joints ? std::to_string(engine.influences) + " influences)"
                                   : std::to_string(engine.joints) + " joints)"));
    }
  }
  return "; fits " + joined(fitting) +
         (others.empty() ? ""
                         : ", exceeds " + joined(others) +
                               "; -k 4 reduces influences, and flbc cage --control-points joints");
}

}  // namespace

template <int Dim>
std::string describe_skin(const gltf::ExportedSkin& skin, const gltf::Animation<Dim>& animation,
                          double size) {
  Facts facts;
  facts << skin.vertices << " vertices, " << skin.triangles << " triangles, " << skin.joints
        << " joints";
  if (skin.keys > 0 || !animation.poses.empty()) {
    facts << ", of which " << skin.moving_joints << " move";
  }
  if (!animation.poses.empty()) facts << " within " << animation.times.back() << " s";
  facts << ", at most " << skin.influences << " influences per vertex";
  if (skin.given_influences > skin.influences) facts << " (before " << skin.given_influences << ")";
  constexpr Index kStill = 2;  // joints that move nothing, at most
  facts << describe_engines(skin.joints + kStill, skin.influences);
  const auto add_error = [&](const std::string& name, const ErrorNorms& error) {
    facts << "; " << name << ' ' << 100 * error.rms / size << "% rms, " << 100 * error.max / size
          << "% max of the size";
  };
  if (skin.deformation_error.max > 0) {
    add_error(animation.poses.empty() ? "deformation error over random smooth poses"
                                      : "deformation error over these poses",
              skin.deformation_error);
  }
  if (skin.rigid_error) add_error("rigid regions instead of affine ones", *skin.rigid_error);
  if (skin.keys > 0) {
    add_error(
        "difference from the deformation by the cage over " + std::to_string(skin.keys) + " keys",
        *skin.skeleton_error);
  }
  if (skin.keys > 0 && skin.corrected_error) add_error("with morph targets", *skin.corrected_error);
  if (skin.position_change > gltf::kVisibleChange * size) {
    facts << "; single precision moves vertices by up to " << skin.position_change / size
          << " of the size; move the cage and the model closer to the origin";
  }
  return facts.text();
}

template std::string describe_skin(const gltf::ExportedSkin&, const gltf::Animation<2>&, double);
template std::string describe_skin(const gltf::ExportedSkin&, const gltf::Animation<3>&, double);

}  // namespace flbc::app
