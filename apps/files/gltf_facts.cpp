// SPDX-License-Identifier: BSD-3-Clause
#include "files/gltf_facts.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "flbc/errors.h"
#include "flbc/io/files.h"

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
  std::int64_t vertices = 0, triangles = 0, joints = 0, influences = 0;
  double seconds = 0;
};

// Primitives may share their vertices.
void count_triangles(const GltfJson& gltf, const GltfJson& primitive,
                     std::set<std::size_t>& positions, Counts& counts) {
  constexpr int kTriangles = 4;
  if (primitive.value("mode", kTriangles) != kTriangles) return;
  const auto& attributes = primitive.at("attributes");
  const auto& accessors = gltf.at("accessors");
  const auto position = attributes.at("POSITION").get<std::size_t>();
  const auto corners = primitive.value("indices", position);
  counts.triangles += accessors.at(corners).at("count").get<std::int64_t>() / 3;
  if (positions.insert(position).second) {
    counts.vertices += accessors.at(position).at("count").get<std::int64_t>();
  }
  constexpr int kSize = 4;  // of a set of influences
  std::int64_t sets = 0;
  while (attributes.contains("JOINTS_" + std::to_string(sets))) ++sets;
  counts.influences = std::max(counts.influences, kSize * sets);
}

Counts count(const GltfJson& gltf) {
  const GltfJson none = GltfJson::array();
  const auto all = [&](const GltfJson& parent, const char* name) {
    return parent.contains(name) ? parent.at(name) : none;
  };
  Counts counts;
  std::set<std::size_t> positions;
  for (const auto& mesh : all(gltf, "meshes")) {
    for (const auto& primitive : mesh.at("primitives")) {
      count_triangles(gltf, primitive, positions, counts);
    }
  }
  for (const auto& skin : all(gltf, "skins")) {
    counts.joints += static_cast<std::int64_t>(skin.at("joints").size());
  }
  for (const auto& animation : all(gltf, "animations")) {
    for (const auto& sampler : animation.at("samplers")) {
      const auto& times = gltf.at("accessors").at(sampler.at("input").get<std::size_t>());
      counts.seconds = std::max(counts.seconds, times.at("max").at(0).get<double>());
    }
  }
  return counts;
}

}  // namespace

bool is_gltf_file(const std::string& path) {
  const auto extension = io::extension_of(path);
  return extension == "glb" || extension == "gltf";
}

std::string describe_gltf(const std::string& path) {
  const auto bytes = io::read_file(path);
  try {
    const auto counts = count(GltfJson::parse(json_of(bytes)));
    std::ostringstream text;
    text << path << ": glTF model of " << counts.vertices << " vertices, " << counts.triangles
         << " triangles\n";
    if (counts.joints > 0) {
      text << "  skin of " << counts.joints << " joints, at most " << counts.influences
           << " influences per vertex\n";
    }
    if (counts.seconds > 0) text << "  animation of " << counts.seconds << " s\n";
    return text.str();
  } catch (const GltfJson::exception&) {
    throw InputError(path + ": not a glTF file, or damaged");
  }
}

}  // namespace flbc::app
