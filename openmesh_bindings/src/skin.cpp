// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/skin.h"

#include <cmath>

#include "flbc/io/files.h"
#include "gltf/skin.h"

namespace flbc::openmesh::internal {
namespace {

gltf::SkinFormat format_of(const std::string& path) {
  const auto extension = io::extension_of(path);
  if (extension == "glb") return gltf::SkinFormat::kGlb;
  if (extension == "usda") return gltf::SkinFormat::kUsda;
  throw InputError(path + ": skins are written as .glb or .usda");
}

template <int Dim>
gltf::Animation<Dim> animation_of(const std::vector<PointList<Dim>>& poses,
                                  double frames_per_second) {
  if (!(frames_per_second > 0) || !std::isfinite(frames_per_second)) {
    throw OptionError("frames_per_second must be above 0");
  }
  gltf::Animation<Dim> animation;
  for (const auto& pose : poses) {
    animation.times.push_back(static_cast<double>(animation.poses.size()) / frames_per_second);
    animation.poses.push_back(pose);
  }
  return animation;
}

}  // namespace

template <int Dim>
void write_skin_file(const std::string& path, const Binding<Dim>& binding, io::Model model,
                     const std::vector<PointList<Dim>>& poses, const SkinOptions& options) {
  gltf::SkinOptions skin;
  skin.format = format_of(path);
  skin.max_influences = options.max_influences;
  const auto animation = animation_of(poses, options.frames_per_second);
  const auto rest = binding.rest();
  for (const auto& point : rest.colwise()) {
    Vector<3> place = Vector<3>::Zero();
    place.template head<Dim>() = point;
    model.soup.points.push_back(place);
  }
  const auto made =
      gltf::export_skin<Dim>(binding, gltf::surface_of_model<Dim>(model), skin, animation);
  io::write_file(path, [&](std::ostream& file) { file << made.content; });
}

template void write_skin_file(const std::string&, const Binding<2>&, io::Model,
                              const std::vector<PointList<2>>&, const SkinOptions&);
template void write_skin_file(const std::string&, const Binding<3>&, io::Model,
                              const std::vector<PointList<3>>&, const SkinOptions&);

}  // namespace flbc::openmesh::internal
