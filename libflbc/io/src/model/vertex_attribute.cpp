// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/formats.h"
#include "flbc/io/model_file.h"
#include "model/gltf_document.h"
#include "model/gltf_json.h"
#include "model/ply_reader.h"

namespace flbc::io {
namespace {

// Empty if there is none.
Eigen::VectorXd from_ply(const std::string& path, const std::string& name) {
  const auto text = read_file(path);
  PlyReader reader(path, text);
  for (const auto& element : reader.elements()) {
    reader.check_count(element);
    const bool is_vertex = element.name == "vertex";
    const int wanted = is_vertex ? element.find(name) : -1;
    if (is_vertex && wanted < 0) break;
    Eigen::VectorXd values = Eigen::VectorXd::Zero(element.count);
    for (double& value : values) {
      for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
        const auto& property = element.properties[p];
        const Index count = property.count_type == nullptr ? 1 : reader.list_length(property);
        for (Index k = 0; k < count; ++k) {
          const double number = reader.number(*property.type).value;
          if (p == wanted) value = number;
        }
      }
    }
    if (is_vertex) return values;
  }
  return {};
}

Eigen::VectorXd from_gltf(const std::string& path, const std::string& name) {
  const ModelFile file(path);
  const auto& model = file.model();
  Eigen::VectorXd values;
  refusing_damage(path, [&] {
    const GltfDocument document(path, file.text());
    for (const auto& part : model.gltf->parts) {
      const auto& mesh =
          document.json.at("meshes").at(whole(document.json.at("nodes").at(part.node).at("mesh")));
      const auto& attributes = mesh.at("primitives").at(part.primitives.front()).at("attributes");
      if (!attributes.contains(name)) continue;
      if (values.size() == 0) {
        values.setZero(static_cast<Eigen::Index>(model.soup.points.size()));
      }
      const auto numbers = document.numbers(whole(attributes[name]), 1);
      const auto count = std::min<std::size_t>(part.points.size(), numbers.cols());
      for (std::size_t k = 0; k < count; ++k) {
        auto& value = values[part.points[k]];
        value = std::max(value, numbers(0, static_cast<Eigen::Index>(k)));
      }
    }
  });
  return values;
}

}  // namespace

Eigen::VectorXd vertex_attribute(const std::string& path, const std::string& name) {
  const auto extension = extension_of(path);
  const bool is_gltf = extension == "glb" || extension == "gltf" || extension == "vrm";
  if (!is_gltf && extension != "ply") {
    throw InputError(path + ": only .ply, .glb, and .gltf models have attributes");
  }
  auto values = is_gltf ? from_gltf(path, name) : from_ply(path, name);
  if (values.size() == 0) {
    throw InputError(path + ": the vertices have no attribute \"" + name + "\"");
  }
  return values;
}

}  // namespace flbc::io
