// SPDX-License-Identifier: BSD-3-Clause
#include "front/gltf_facts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iostream>
#include <sstream>

#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "model/gltf_document.h"
#include "model/gltf_json.h"

namespace flbc::app {
namespace {

// Of the set that has the most of them.
std::size_t count_influences(io::GltfJson& gltf) {
  constexpr std::size_t kSize = 4;  // of a set
  std::size_t sets = 0;
  const auto path = [&] {
    return "meshes/*/primitives/*/attributes/JOINTS_" + std::to_string(sets);
  };
  while (!io::numbers_at(gltf, {path().c_str()}).empty()) ++sets;
  return kSize * sets;
}

}  // namespace

std::string describe_gltf(const std::string& path) {
  return io::refusing_damage(path, [&] {
    io::GltfDocument document(path, io::read_file(path));
    Eigen::AlignedBox3d box;
    const io::ModelFile file(path);
    const auto& soup = file.model().soup;
    for (const auto& point : soup.points) box.extend(point);
    std::ostringstream text;
    text << path << ": glTF model of " << soup.points.size() << " vertices, "
         << soup.polygons.size() << " triangles\n";
    const Eigen::IOFormat row(6, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
    text << "  from " << box.min().transpose().format(row) << " to "
         << box.max().transpose().format(row) << '\n';
    auto& json = document.json;
    const auto joints =
        io::numbers_at(json, {"skins/*/joints/*"}).size();  // skins may share theirs
    if (joints > 0) {
      text << "  skin of " << joints << " joints, at most " << count_influences(json)
           << " influences per vertex\n";
    }
    for (const auto& note : file.model().notes) text << "  " << note << '\n';
    double seconds = 0;
    for (const auto times : io::numbers_at(json, {"animations/*/samplers/*/input"})) {
      const auto keys = document.numbers(times, 1);
      if (keys.size() > 0) seconds = std::max(seconds, keys.maxCoeff());
    }
    if (seconds > 0) text << "  animation of " << seconds << " s\n";
    return text.str();
  });
}

void warn_left_out(const std::string& result, const std::string& model,
                   const std::vector<std::string>& phrases) {
  for (const auto& phrase : phrases) {
    std::cerr << "flbc: " << result << " does not contain all of " << model << ": " << phrase
              << '\n';
  }
}

}  // namespace flbc::app
