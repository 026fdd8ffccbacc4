// SPDX-License-Identifier: BSD-3-Clause
#include "front/gltf_facts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iostream>
#include <set>
#include <sstream>

#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "model/gltf_document.h"
#include "model/gltf_json.h"

namespace flbc::app {
namespace {

using io::GltfJson;

struct Counts {
  std::size_t vertices = 0, triangles = 0, joints = 0, influences = 0;
  double seconds = 0;
};

// Primitives may share their vertices.
void count_triangles(const GltfJson& gltf, const GltfJson& primitive,
                     std::set<std::size_t>& positions, Counts& counts) {
  if (io::whole(primitive, "mode", io::kGltfTriangles) != io::kGltfTriangles) return;
  const auto& attributes = primitive.at("attributes");
  const auto& accessors = gltf.at("accessors");
  const auto position = io::whole(attributes.at("POSITION"));
  const auto corners = io::whole(primitive, "indices", position);
  counts.triangles += io::whole(accessors.at(corners).at("count")) / 3;
  if (positions.insert(position).second) {
    counts.vertices += io::whole(accessors.at(position).at("count"));
  }
  constexpr std::size_t kSize = 4;  // of a set of influences
  std::size_t sets = 0;
  while (attributes.contains("JOINTS_" + std::to_string(sets))) ++sets;
  counts.influences = std::max(counts.influences, kSize * sets);
}

Counts count(GltfJson& gltf) {
  Counts counts;
  std::set<std::size_t> positions;
  for (const auto& mesh : gltf.value("meshes", GltfJson::array())) {
    for (const auto& primitive : mesh.at("primitives")) {
      count_triangles(gltf, primitive, positions, counts);
    }
  }
  counts.joints = io::numbers_at(gltf, {"skins/*/joints/*"}).size();  // skins may share theirs
  for (const auto times : io::numbers_at(gltf, {"animations/*/samplers/*/input"})) {
    const auto& last = gltf.at("accessors").at(times).at("max").at(0);
    counts.seconds = std::max(counts.seconds, last.get<double>());
  }
  return counts;
}

}  // namespace

std::string describe_gltf(const std::string& path) {
  return io::refusing_damage(path, [&] {
    io::GltfDocument document(path, io::read_file(path));
    const auto counts = count(document.json);
    Eigen::AlignedBox3d box;
    const io::ModelFile file(path);
    for (const auto& point : file.model().soup.points) box.extend(point);
    std::ostringstream text;
    text << path << ": glTF model of " << counts.vertices << " vertices, " << counts.triangles
         << " triangles\n";
    const Eigen::IOFormat row(6, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
    text << "  from " << box.min().transpose().format(row) << " to "
         << box.max().transpose().format(row) << '\n';
    if (counts.joints > 0) {
      text << "  skin of " << counts.joints << " joints, at most " << counts.influences
           << " influences per vertex\n";
    }
    for (const auto& note : file.model().notes) text << "  " << note << '\n';
    if (counts.seconds > 0) text << "  animation of " << counts.seconds << " s\n";
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
