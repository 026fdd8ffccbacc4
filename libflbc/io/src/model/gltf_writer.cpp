// SPDX-License-Identifier: BSD-3-Clause
#include "model/gltf_writer.h"

#include <map>
#include <ostream>

#include "flbc/io/files.h"
#include "model/gltf_edit.h"
#include "model/model_scan.h"

namespace flbc::io {
namespace {

// The materials of a surface in a document.
class MaterialWriter {
 public:
  MaterialWriter(GltfDocument& document, const gltf::Surface& surface,
                 std::vector<std::string>& left_out)
      : document_(document), surface_(surface), left_out_(left_out) {}

  //! \param number  in the surface, -1 = none \return the number in the document
  std::size_t add(Index number) {
    GltfJson surface{{"metallicFactor", 0}, {"roughnessFactor", 0.8}};
    // Models may be open, and flat ones are.
    GltfJson json{{"name", "model"}, {"doubleSided", true}};
    if (number >= 0)
      describe(surface_.materials.at(static_cast<std::size_t>(number)), json, surface);
    json["pbrMetallicRoughness"] = std::move(surface);
    return document_.append("materials", std::move(json));
  }

 private:
  void describe(const Material& material, GltfJson& json, GltfJson& surface) {
    json["name"] = material.name;
    const int texture = surface_.texture_coordinates.cols() > 0 ? texture_of(material) : -1;
    const auto& color = texture >= 0 ? material.tint : material.color;
    surface = {{"baseColorFactor", {color[0], color[1], color[2], material.opacity}},
               {"metallicFactor", material.metallic},
               {"roughnessFactor", material.roughness}};
    if (texture >= 0) surface["baseColorTexture"] = {{"index", texture}};
    if (material.opacity < 1) json["alphaMode"] = "BLEND";
    if (material.alpha_cutoff <= 0) return;
    json["alphaMode"] = "MASK";
    json["alphaCutoff"] = material.alpha_cutoff;
  }

  // \return the number of the texture, -1 if there is none
  int texture_of(const Material& material) {
    if (material.texture.empty()) return -1;
    const auto [known, is_new] = textures_.emplace(material.texture, -1);
    if (!is_new) return known->second;
    const auto bytes = load_picture(material, left_out_);
    if (bytes.empty()) return -1;
    constexpr int kLinear = 9729, kMipmaps = 9987;
    if (!document_.json.contains("samplers")) {
      document_.append("samplers", {{"magFilter", kLinear}, {"minFilter", kMipmaps}});
    }
    const auto image = document_.append(
        "images", {{"bufferView", document_.add_view(bytes)}, {"mimeType", media_type_of(bytes)}});
    const auto texture = document_.append("textures", {{"sampler", 0}, {"source", image}});
    return known->second = static_cast<int>(texture);
  }

  GltfDocument& document_;
  const gltf::Surface& surface_;
  std::vector<std::string>& left_out_;
  std::map<std::string, int> textures_;
};

}  // namespace

std::string load_picture(const Material& material, std::vector<std::string>& left_out) {
  if (material.texture.empty()) return {};
  try {
    auto bytes = material.picture.empty() ? read_file(material.texture) : material.picture;
    const auto type = media_type_of(bytes);
    if (type == "image/png" || type == "image/jpeg") return bytes;
    left_out.push_back("the picture " + material.texture + ": glTF has .png and .jpg only");
  } catch (const IoError& error) {
    left_out.push_back(std::string("a picture: ") + error.what());
  }
  return {};
}

GltfJson add_mesh(GltfDocument& document, const gltf::Surface& surface,
                  const Eigen::Matrix3Xf& positions, const Eigen::RowVectorXf& sources,
                  std::vector<std::string>& left_out) {
  GltfJson attributes{{"POSITION", document.add_attribute(positions, true)}};
  const auto add = [&](const char* name, const auto& columns) {
    if (columns.cols() > 0) attributes[name] = document.add_attribute(columns);
  };
  add("NORMAL", surface.normals);
  add("TEXCOORD_0", surface.texture_coordinates);
  add("COLOR_0", surface.colors);
  add("_VERTEX", sources);
  std::map<Index, std::vector<Index>> triangles;  // by material
  for (Index t = 0; t < static_cast<Index>(surface.triangles.cols()); ++t) {
    triangles[surface.triangle_materials.empty() ? -1 : surface.triangle_materials[t]].push_back(t);
  }
  MaterialWriter materials(document, surface, left_out);
  auto primitives = GltfJson::array();
  for (const auto& [material, numbers] : triangles) {
    const FacetList<3> some = surface.triangles(Eigen::all, numbers);
    primitives.push_back({{"attributes", attributes},
                          {"indices", document.add_indices(some, positions.cols())},
                          {"material", materials.add(material)}});
  }
  return {{"primitives", std::move(primitives)}};
}

void write_glb(std::ostream& out, const Model& model) {
  if (model.gltf) {
    out << moved_gltf(model);
    return;
  }
  auto surface = gltf::surface_of_model<3>(model);
  if (model.attributes.normals.cols() == 0) surface.normals.resize(3, 0);
  Eigen::Matrix3Xf positions(3, static_cast<Eigen::Index>(surface.sources.size()));
  for (Eigen::Index v = 0; v < positions.cols(); ++v) {
    positions.col(v) = model.soup.points[surface.sources[v]].cast<float>();
  }
  if (!positions.allFinite()) {
    throw InputError("a coordinate is too large for single precision, which glTF has");
  }
  GltfDocument document;
  std::vector<std::string> left_out;
  document.json["scene"] = 0;
  document.append("scenes", {{"nodes", {0}}});
  document.append("nodes", {{"mesh", 0}});
  document.append("meshes", add_mesh(document, surface, positions, {}, left_out));
  out << document.glb();
}

}  // namespace flbc::io
