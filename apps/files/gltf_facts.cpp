// SPDX-License-Identifier: BSD-3-Clause
#include "files/gltf_facts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "model/gltf_node.h"

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

// The box around all meshes where the nodes of the file put them. Skins are at rest where their
// meshes are, whatever the transforms of their nodes.
class SceneBox {
 public:
  explicit SceneBox(const GltfJson& gltf) : gltf_(gltf) {
    if (!gltf.contains("nodes")) return;
    std::set<std::size_t> children;
    for (const auto& node : gltf.at("nodes")) {
      for (const auto& child : node.value("children", GltfJson::array()))
        children.insert(child.get<std::size_t>());
    }
    for (std::size_t k = 0; k < gltf.at("nodes").size(); ++k) {
      if (children.count(k) == 0) add_node(k, Eigen::Matrix4d::Identity(), 0);
    }
  }

  const Eigen::AlignedBox3d& box() const { return box_; }

 private:
  void add_node(std::size_t k, const Eigen::Matrix4d& parent, std::size_t depth) {
    const auto& nodes = gltf_.at("nodes");
    const auto& node = nodes.at(k);
    if (depth > nodes.size())
      throw GltfJson::other_error::create(501, "nodes form a circle", &node);
    const Eigen::Matrix4d transform = parent * io::transform_of(node).matrix();
    if (node.contains("mesh")) {
      const auto mesh = node.at("mesh").get<std::size_t>();
      for (const auto& primitive : gltf_.at("meshes").at(mesh).at("primitives")) {
        add_primitive(primitive, node.contains("skin") ? Eigen::Matrix4d::Identity() : transform);
      }
    }
    for (const auto& child : node.value("children", GltfJson::array())) {
      add_node(child, transform, depth + 1);
    }
  }

  void add_primitive(const GltfJson& primitive, const Eigen::Matrix4d& transform) {
    const auto position = primitive.at("attributes").at("POSITION").get<std::size_t>();
    const auto& accessor = gltf_.at("accessors").at(position);
    const auto low = accessor.at("min").get<std::vector<double>>();
    const auto high = accessor.at("max").get<std::vector<double>>();
    for (int corner = 0; corner < 8; ++corner) {
      Eigen::Vector4d point(0, 0, 0, 1);
      for (int d = 0; d < 3; ++d) point[d] = (corner >> d & 1) != 0 ? high.at(d) : low.at(d);
      box_.extend((transform * point).eval().head<3>());
    }
  }

  const GltfJson& gltf_;
  Eigen::AlignedBox3d box_;
};

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
    const auto gltf = GltfJson::parse(json_of(bytes));
    const auto counts = count(gltf);
    const auto box = SceneBox(gltf).box();
    std::ostringstream text;
    text << path << ": glTF model of " << counts.vertices << " vertices, " << counts.triangles
         << " triangles\n";
    if (!box.isEmpty()) {
      const Eigen::IOFormat row(6, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
      text << "  from " << box.min().transpose().format(row) << " to "
           << box.max().transpose().format(row) << '\n';
    }
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
