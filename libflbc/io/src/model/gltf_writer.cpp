// SPDX-License-Identifier: BSD-3-Clause
// Writes .glb: a mesh of triangles with all attributes, its materials, and their pictures.
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <tuple>

#include "flbc/errors.h"
#include "flbc/io/cut_polygon.h"
#include "flbc/io/files.h"
#include "model/model_scan.h"
#include "model/srgb.h"
#include "text/bytes.h"

namespace flbc::io {
namespace {

using Json = nlohmann::ordered_json;
using Corner = std::tuple<Index, Index, Index>;  // point, texture coordinate, normal; -1 = none

constexpr int kSingles = 5126, kIndices = 5125;

class GlbWriter {
 public:
  explicit GlbWriter(const Model& model) : model_(model) {
    collect_triangles();
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "flbc"}}},
             {"scene", 0},
             {"scenes", {{{"nodes", {0}}}}},
             {"nodes", {{{"mesh", 0}}}}};
    const auto attributes = add_attributes();
    auto primitives = Json::array();
    for (const auto& [material, corners] : triangles_) {
      std::vector<std::uint32_t> indices;
      for (const Corner& corner : corners) indices.push_back(number_of_[corner]);
      Json primitive{{"attributes", attributes}, {"indices", add(indices, "SCALAR", kIndices, 1)}};
      if (material >= 0) primitive["material"] = material;
      primitives.push_back(std::move(primitive));
    }
    json_["meshes"] = {{{"primitives", std::move(primitives)}}};
    for (const auto& material : model.materials) add_material(material);
    json_["buffers"] = {{{"byteLength", binary_.size()}}};
  }

  void write(std::ostream& out) const {
    auto text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [&](std::size_t number) {
      char bytes[4];
      put_number(static_cast<std::uint32_t>(number), bytes);
      out.write(bytes, sizeof bytes);
    };
    out << "glTF";
    word(2);
    word(28 + text.size() + binary_.size());
    word(text.size());
    out << "JSON" << text;
    word(binary_.size());
    out.write("BIN\0", 4);
    out << binary_;
  }

 private:
  void collect_triangles() {
    const auto& soup = model_.soup;
    std::vector<Vector<3>> places;
    for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
      const auto& polygon = soup.polygons[f];
      places.clear();
      for (const Index point : polygon) places.push_back(soup.points[point]);
      auto& corners =
          triangles_[model_.polygon_materials.empty() ? -1 : model_.polygon_materials[f]];
      const auto parts = cut_polygon(places);
      for (const Index k : parts.reshaped()) {
        const auto references = model_.attributes.corners.empty() ? CornerReferences()
                                                                  : model_.attributes.corners[f][k];
        corners.emplace_back(polygon[k], references.texture_coordinate, references.normal);
        number_of_[corners.back()];
      }
    }
    if (number_of_.empty()) throw InputError("a .glb file needs triangles, and the model has none");
    std::uint32_t number = 0;
    for (auto& entry : number_of_) entry.second = number++;
  }

  // \return the number of the accessor
  template <class Number>
  int add(const std::vector<Number>& numbers, const char* type, int component, std::size_t rows) {
    const int view = add_view(numbers.data(), numbers.size() * sizeof(Number));
    json_["accessors"].push_back({{"bufferView", view},
                                  {"componentType", component},
                                  {"count", numbers.size() / rows},
                                  {"type", type}});
    return static_cast<int>(json_["accessors"].size()) - 1;
  }

  int add_view(const void* data, std::size_t size) {
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}});
    binary_.append(static_cast<const char*>(data), size);
    binary_.resize((binary_.size() + 3) / 4 * 4);
    return static_cast<int>(json_["bufferViews"].size()) - 1;
  }

  Json add_attributes() {
    std::vector<float> points, normals, texture, colors;
    const auto& attributes = model_.attributes;
    const auto append = [](std::vector<float>& list, const auto& numbers) {
      for (const double number : numbers) list.push_back(static_cast<float>(number));
    };
    for (const auto& entry : number_of_) {
      const auto [point, texture_coordinate, normal] = entry.first;
      append(points, model_.soup.points[point]);
      if (attributes.normals.cols() > 0) {
        Vector<3> direction = Vector<3>::UnitZ();
        if (normal >= 0 && !attributes.normals.col(normal).isZero(0)) {
          direction = attributes.normals.col(normal).normalized();
        }
        append(normals, direction);
      }
      if (attributes.texture_coordinates.cols() > 0) {
        Vector<2> place = Vector<2>::Zero();
        if (texture_coordinate >= 0) place = attributes.texture_coordinates.col(texture_coordinate);
        append(texture, Vector<2>(place.x(), 1 - place.y()));
      }
      if (attributes.colors.cols() > 0) {
        append(colors, Vector<3>(attributes.colors.col(point).unaryExpr(&to_linear)));
      }
    }
    Json json{{"POSITION", add(points, "VEC3", kSingles, 3)}};
    const auto places = Eigen::Map<const Eigen::Matrix3Xf>(points.data(), 3, points.size() / 3);
    const Eigen::Vector3f low = places.rowwise().minCoeff(), high = places.rowwise().maxCoeff();
    if (!low.allFinite() || !high.allFinite()) {
      throw InputError("a coordinate is too large for single precision, which glTF has");
    }
    json_["accessors"][0]["min"] = {low.x(), low.y(), low.z()};
    json_["accessors"][0]["max"] = {high.x(), high.y(), high.z()};
    if (!normals.empty()) json["NORMAL"] = add(normals, "VEC3", kSingles, 3);
    if (!texture.empty()) json["TEXCOORD_0"] = add(texture, "VEC2", kSingles, 2);
    if (!colors.empty()) json["COLOR_0"] = add(colors, "VEC3", kSingles, 3);
    return json;
  }

  void add_material(const Material& material) {
    const auto& color = material.color;
    Json surface{{"baseColorFactor", {color[0], color[1], color[2], material.opacity}},
                 {"metallicFactor", material.metallic},
                 {"roughnessFactor", material.roughness}};
    const int picture = add_picture(material);
    if (picture >= 0) {
      // It replaces the color, as intended by programs that write both.
      if (material.picture.empty()) surface["baseColorFactor"] = {1, 1, 1, material.opacity};
      surface["baseColorTexture"] = {{"index", picture}};
    }
    Json json{{"name", material.name}, {"doubleSided", true}, {"pbrMetallicRoughness", surface}};
    if (material.opacity < 1) json["alphaMode"] = "BLEND";
    json_["materials"].push_back(std::move(json));
  }

  // \return the number of the texture, -1 if there is none that can be read
  int add_picture(const Material& material) {
    if (material.texture.empty()) return -1;
    std::string bytes = material.picture;
    try {
      if (bytes.empty()) bytes = read_file(material.texture);
    } catch (const IoError&) {
      return -1;
    }
    const bool is_png = bytes.compare(1, 3, "PNG") == 0;
    json_["images"].push_back({{"bufferView", add_view(bytes.data(), bytes.size())},
                               {"mimeType", is_png ? "image/png" : "image/jpeg"}});
    json_["textures"].push_back({{"source", json_["images"].size() - 1}});
    return static_cast<int>(json_["textures"].size()) - 1;
  }

  const Model& model_;
  Json json_;
  std::string binary_;
  std::map<Index, std::vector<Corner>> triangles_;  // by material
  std::map<Corner, std::uint32_t> number_of_;
};

}  // namespace

void write_glb(std::ostream& out, const Model& model) {
  GlbWriter(model).write(out);
}

}  // namespace flbc::io
