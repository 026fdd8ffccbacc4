// SPDX-License-Identifier: BSD-3-Clause
#include "files/gltf_facts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "model/gltf_json.h"

namespace flbc::app {
namespace {

using GltfJson = nlohmann::json;

// The text of the JSON: the whole file, or the first chunk of a binary one.
std::string json_of(const std::string& bytes) {
  constexpr std::size_t kBegin = 20;
  if (bytes.compare(0, 4, "glTF") != 0) return bytes;
  std::uint32_t size = 0;
  if (bytes.size() >= kBegin) std::memcpy(&size, bytes.data() + 12, sizeof size);
  return bytes.size() < kBegin ? "" : bytes.substr(kBegin, size);
}

struct Counts {
  std::size_t vertices = 0, triangles = 0, joints = 0, influences = 0;
  double seconds = 0;
};

// Primitives may share their vertices.
void count_triangles(const GltfJson& gltf, const GltfJson& primitive,
                     std::set<std::size_t>& positions, Counts& counts) {
  constexpr std::size_t kTriangles = 4;
  if (io::whole(primitive, "mode", kTriangles) != kTriangles) return;
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

Counts count(const GltfJson& gltf) {
  const GltfJson none = GltfJson::array();
  const auto all = [&](const GltfJson& parent, const char* name) {
    return parent.contains(name) ? parent.at(name) : none;
  };
  Counts counts;
  std::set<std::size_t> positions, joints;  // skins may share theirs
  for (const auto& mesh : all(gltf, "meshes")) {
    for (const auto& primitive : mesh.at("primitives")) {
      count_triangles(gltf, primitive, positions, counts);
    }
  }
  for (const auto& skin : all(gltf, "skins")) {
    for (const auto& joint : skin.at("joints")) joints.insert(io::whole(joint));
  }
  counts.joints = joints.size();
  for (const auto& animation : all(gltf, "animations")) {
    for (const auto& sampler : animation.at("samplers")) {
      const auto& times = gltf.at("accessors").at(io::whole(sampler.at("input")));
      counts.seconds = std::max(counts.seconds, times.at("max").at(0).get<double>());
    }
  }
  return counts;
}

}  // namespace

std::string describe_gltf(const std::string& path) {
  const auto bytes = io::read_file(path);
  try {
    const auto gltf = GltfJson::parse(json_of(bytes));
    const auto counts = count(gltf);
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
  } catch (const GltfJson::exception&) {
    throw InputError(path + ": not a glTF file, or damaged");
  } catch (const std::out_of_range&) {
    throw InputError(path + ": not a glTF file, or damaged");
  }
}

}  // namespace flbc::app
