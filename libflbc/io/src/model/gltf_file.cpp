// SPDX-License-Identifier: BSD-3-Clause
// glTF 2.0, .glb and .gltf: the triangles of all meshes where nodes, skins, and default morph
// weights put them. Coincident points are one vertex, because files part a vertex where its
// attributes differ.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "model/following_normals.h"
#include "model/gltf_document.h"
#include "model/gltf_json.h"
#include "model/model_scan.h"
#include "model/srgb.h"

namespace flbc::io {
namespace {

using Json = GltfJson;

// Whether points, normals, and texture coordinates do not depend on an extension.
bool is_understood(const std::string& extension) {
  constexpr std::string_view kBegins[] = {
      "KHR_mesh_quantization", "KHR_lights_punctual", "KHR_materials_",  "KHR_texture_basisu",
      "KHR_texture_ktx",       "EXT_texture_",        "GOOGLE_texture_", "KHR_techniques_webgl"};
  return std::any_of(std::begin(kBegins), std::end(kBegins), [&](std::string_view begin) {
    return extension.compare(0, begin.size(), begin) == 0;
  });
}

class GltfScanner {
 public:
  GltfScanner(const std::string& path, ModelScan& scan)
      : path_(path), scan_(scan), model_(scan.model) {}

  void run() {
    model_.is_text = false;
    document_ = GltfDocument(path_, scan_.text);
    if (extension_of(path_) == "gltf") {
      scan_.fixed =
          path_ + ": the numbers of a .gltf file are elsewhere; write .glb or another format";
    }
    check_extensions();
    add_others();
    read_materials();
    visit_scene();
    if (model_.soup.polygons.empty()) {
      const auto num_meshes = json().value("meshes", Json::array()).size();
      fail(!unread_.empty()  ? "the file has " + unread_ + ", but no triangles"
           : num_meshes == 0 ? "the file has no meshes; export the model as a mesh"
           : source_->parts.empty()
               ? "the file has " + std::to_string(num_meshes) +
                     (num_meshes == 1 ? " mesh" : " meshes") + ", but no node of the scene uses one"
               : "the meshes have no triangles");
    }
    if (num_flat_ > 0) {
      model_.notes.push_back(std::to_string(num_flat_) +
                             (num_flat_ == 1 ? " triangle without area is left out"
                                             : " triangles without area are left out"));
      add_other(model_, "triangles without area");
    }
    for (const auto& name : other_pictures_) {
      model_.notes.push_back("pictures of the extension " + name +
                             " are not shown; only .png and .jpg are");
      add_other(model_, "pictures of the extension " + name);
    }
    if (!unread_.empty()) {
      model_.notes.push_back(unread_ + " are not read");
      add_other(model_, unread_);
    }
    finish();
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { document_.fail(message); }
  [[noreturn]] void damaged(const std::string& message) const { document_.damaged(message); }

  const Json& json() const { return document_.json; }

  void check_extensions() {
    std::set<std::string> required;
    for (const auto& name : json().value("extensionsRequired", Json::array())) {
      const auto& extension = *required.insert(name.get<std::string>()).first;
      if (is_understood(extension)) continue;
      const bool is_compression = extension.find("compression") != std::string::npos;
      fail("the file requires the extension " + extension +
           ", which is not supported; export the " +
           (is_compression ? "model uncompressed" : "model without it"));
    }
    for (const auto& name : json().value("extensionsUsed", Json::array())) {
      const auto extension = name.get<std::string>();
      if (required.count(extension) > 0) continue;
      add_other(model_, "the extension " + extension);
      if (is_understood(extension)) continue;
      model_.notes.push_back("the extension " + extension + " is not supported and has no effect");
    }
  }

  void add_others() {
    for (const char* list : {"animations", "skins", "materials", "cameras"}) {
      if (json().contains(list)) add_other(model_, list);
    }
  }

  // ------------------------------------------------------------------------------------- materials

  void read_materials() {
    for (const auto& json : json().value("materials", Json::array())) {
      auto& material = model_.materials.emplace_back();
      coordinate_sets_.emplace_back("TEXCOORD_0");
      material.name = json.value("name", "material" + std::to_string(model_.materials.size() - 1));
      const auto surface = json.value("pbrMetallicRoughness", Json::object());
      const auto extensions = json.value("extensions", Json::object());
      const auto older = extensions.value("KHR_materials_pbrSpecularGlossiness", Json::object());
      const std::vector<double> white{1, 1, 1, 1};
      const auto color = surface.value("baseColorFactor", older.value("diffuseFactor", white));
      for (int k = 0; k < 3; ++k) material.color[k] = std::clamp(color.at(k), 0.0, 1.0);
      material.tint = material.color;
      const auto alpha = json.value("alphaMode", "");
      material.opacity = alpha == "BLEND" ? std::clamp(color.at(3), 0.0, 1.0) : 1;
      if (alpha == "MASK") material.alpha_cutoff = json.value("alphaCutoff", 0.5);
      material.roughness = std::clamp(surface.value("roughnessFactor", 1.0), 0.0, 1.0);
      material.metallic = std::clamp(surface.value("metallicFactor", 1.0), 0.0, 1.0);
      if (surface.contains("baseColorTexture")) {
        read_texture(surface["baseColorTexture"], material);
      } else if (older.contains("diffuseTexture")) {
        read_texture(older["diffuseTexture"], material);
      }
      for (const char* map : {"normalTexture", "occlusionTexture", "emissiveTexture"}) {
        if (json.contains(map)) add_other(model_, "other maps than colors");
      }
      if (surface.contains("metallicRoughnessTexture")) {
        add_other(model_, "other maps than colors");
      }
    }
  }

  void read_texture(const Json& texture, Material& material) {
    coordinate_sets_.back() = "TEXCOORD_" + std::to_string(whole(texture, "texCoord", 0));
    const auto& source = json().at("textures").at(whole(texture.at("index")));
    if (!source.contains("source")) {
      const auto extensions = source.value("extensions", Json::object());
      for (const auto& [name, unused] : extensions.items()) other_pictures_.insert(name);
      return;
    }
    const auto number = whole(source["source"]);
    const auto& image = json().at("images").at(number);
    material.texture = path_ + "#" + std::to_string(number);
    if (image.contains("bufferView")) {
      material.picture = document_.view(whole(image.at("bufferView")));
      return;
    }
    const auto uri = image.at("uri").get<std::string>();
    if (is_data(uri)) {
      material.picture = document_.content_of(uri);
    } else {
      material.texture = document_.file_of(uri);
    }
  }

  // ------------------------------------------------------------------------------------- triangles

  void visit_scene() {
    const auto nodes = json().value("nodes", Json::array());
    parents_.assign(nodes.size(), -1);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const auto child : wholes(nodes[k], "children")) {
        if (parents_.at(child) >= 0) damaged("node " + std::to_string(child) + " has two parents");
        parents_[child] = static_cast<std::ptrdiff_t>(k);
      }
    }
    visited_.resize(nodes.size());
    std::vector<std::size_t> roots;
    if (const auto scenes = json().value("scenes", Json::array()); !scenes.empty()) {
      const auto number = whole(json(), "scene", 0);
      roots = wholes(scenes.at(number), "nodes");
      if (scenes.size() > 1) {
        model_.notes.push_back("only scene " + std::to_string(number) + " of " +
                               std::to_string(scenes.size()) + " is read");
        add_other(model_, "other scenes");
      }
    } else {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (parents_[k] < 0) roots.push_back(k);
      }
    }
    for (const auto root : roots) visit(nodes, root);
  }

  void visit(const Json& nodes, std::size_t root) {
    std::vector<std::size_t> left{root};
    while (!left.empty()) {
      const auto k = left.back();
      left.pop_back();
      const auto& node = nodes.at(k);
      if (visited_[k]) continue;
      visited_[k] = true;
      if (node.contains("mesh")) add_mesh(nodes, k);
      const auto children = wholes(node, "children");
      left.insert(left.end(), children.rbegin(), children.rend());
    }
  }

  Eigen::Affine3d world_transform(const Json& nodes, std::size_t node) const {
    auto transform = transform_of(nodes.at(node));
    std::size_t depth = 0;
    for (auto parent = parents_.at(node); parent >= 0;
         parent = parents_[static_cast<std::size_t>(parent)]) {
      if (++depth > nodes.size()) damaged("nodes form a circle");
      transform = transform_of(nodes[static_cast<std::size_t>(parent)]) * transform;
    }
    return transform;
  }

  void add_mesh(const Json& nodes, std::size_t k) {
    known_.clear();
    node_ = k;
    frame_ = world_transform(nodes, k);
    snap_to_identity(frame_, 1);
    joints_.clear();
    if (nodes[k].contains("skin")) {
      read_skin(nodes, whole(nodes[k].at("skin")));
    } else if (!frame_.matrix().allFinite()) {
      damaged("the transform of a node is not finite");
    } else if (std::abs(frame_.linear().determinant()) < 1e-300) {
      return note_unread("meshes that a scale of 0 flattens");
    }
    const auto mesh = whole(nodes[k].at("mesh"));
    const auto& primitives = json().at("meshes").at(mesh).at("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      document_.part = "mesh " + std::to_string(mesh) + ", primitive " + std::to_string(p) + ": ";
      add_primitive(primitives[p], p);
    }
    document_.part.clear();
    if (!joints_.empty() && !known_.empty()) add_posed_others(primitives);
  }

  // Bits that only rounding has set in products of transforms would change coordinates.
  static void snap_to_identity(Eigen::Affine3d& frame, double size) {
    constexpr double kSinglePrecision = 1.2e-7;
    const auto difference = frame.matrix() - Eigen::Matrix4d::Identity();
    if (difference.cwiseAbs().maxCoeff() < kSinglePrecision * size) frame.setIdentity();
  }

  // The joints move the vertices from where they were bound; the node of the mesh does not.
  void read_skin(const Json& nodes, std::size_t number) {
    const auto& skin = json().at("skins").at(number);
    const auto joints = wholes(skin, "joints");
    if (joints.empty()) damaged("skin " + std::to_string(number) + " has no joints");
    Eigen::MatrixXd inverses;
    if (skin.contains("inverseBindMatrices")) {
      inverses = document_.numbers(whole(skin["inverseBindMatrices"]), 16);
      if (inverses.cols() < static_cast<Eigen::Index>(joints.size())) {
        damaged("skin " + std::to_string(number) + " has fewer inverse bind matrices than joints");
      }
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
      auto frame = world_transform(nodes, joints[j]);
      double size = 1;
      if (inverses.cols() > 0) {
        const Eigen::Matrix4d inverse = inverses.col(static_cast<Eigen::Index>(j)).reshaped(4, 4);
        frame = frame * Eigen::Affine3d(inverse);
        size = std::max(size, inverse.cwiseAbs().maxCoeff());
      }
      snap_to_identity(frame, size);
      joints_.push_back(frame);
    }
  }

  // Means of the transforms of the joints, weighted for each vertex. They do not depend on the
  // order of the joints.
  std::vector<Eigen::Affine3d> skinned_frames(const Json& attributes, Eigen::Index count) {
    std::vector<Eigen::MatrixXd> joints, weights;
    for (int set = 0; attributes.contains("JOINTS_" + std::to_string(set)); ++set) {
      const auto suffix = std::to_string(set);
      joints.push_back(attribute(attributes, "JOINTS_" + suffix, 4, count, "joints"));
      weights.push_back(attribute(attributes, "WEIGHTS_" + suffix, 4, count, "weights"));
    }
    std::vector<Eigen::Affine3d> frames;
    frames.reserve(static_cast<std::size_t>(count));
    std::vector<std::pair<std::size_t, double>> influences;
    for (Eigen::Index k = 0; k < count; ++k) {
      influences.clear();
      for (std::size_t set = 0; set < joints.size(); ++set) {
        for (int slot = 0; slot < 4; ++slot) {
          const double weight = weights[set](slot, k);
          check_weight(weight, k);
          if (weight != 0) influences.emplace_back(to_whole(joints[set](slot, k)), weight);
        }
      }
      frames.push_back(mean_frame(influences));
    }
    return frames;
  }

  void check_weight(double weight, Eigen::Index vertex) {
    if (weight >= 0 && std::isfinite(weight)) return;
    const auto name = "vertex " + std::to_string(vertex) + " of a mesh has a ";
    if (!std::isfinite(weight)) damaged(name + "weight that is not finite");
    if (!std::exchange(has_negative_, true)) model_.notes.push_back(name + "negative weight");
  }

  Eigen::Affine3d mean_frame(std::vector<std::pair<std::size_t, double>>& influences) const {
    if (influences.empty()) return joints_.front();
    std::sort(influences.begin(), influences.end());
    double sum = 0;
    for (const auto& influence : influences) sum += influence.second;
    Eigen::Affine3d frame(Eigen::Matrix4d::Zero());
    for (const auto& [joint, weight] : influences) {
      if (joint >= joints_.size()) damaged("a vertex has a joint that is out of range");
      frame.matrix() += weight / sum * joints_[joint].matrix();
    }
    frame.makeAffine();
    if (!frame.matrix().allFinite()) damaged("the transform of a joint is not finite");
    if (influences.size() > 1) snap_to_identity(frame, 1);
    return frame;
  }

  void add_primitive(const Json& primitive, std::size_t number) {
    if (!has_triangles(primitive)) return note_without_triangles(primitive);
    if (primitive.contains("targets")) add_other(model_, "morph targets");
    const auto& attributes = primitive.at("attributes");
    const bool has_material = primitive.contains("material");
    const auto material = whole(primitive, "material", 0);
    if (has_material && material >= model_.materials.size()) damaged("a material is out of range");
    const std::string coordinates = has_material ? coordinate_sets_[material] : "TEXCOORD_0";
    auto& part = part_of(primitive, coordinates);
    part.primitives.push_back(number);
    const auto triangles = document_.triangles(primitive, part.points.size());
    const std::array<bool, 2> has{attributes.contains(coordinates), attributes.contains("NORMAL")};
    for (const auto& corners : triangles.colwise()) {
      add_triangle(part, {corners[0], corners[1], corners[2]}, has,
                   has_material ? static_cast<Index>(material) : -1);
    }
  }

  static bool has_triangles(const Json& primitive) {
    const auto mode = whole(primitive, "mode", kGltfTriangles);
    return mode >= kGltfTriangles && mode <= kGltfFan;
  }

  void add_posed_others(const Json& primitives) {
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const auto& attributes = primitives[p].at("attributes");
      if (has_triangles(primitives[p]) || !attributes.contains("POSITION")) continue;
      const auto positions = document_.numbers(whole(attributes["POSITION"]), 3);
      auto& part = source_->posed_others.emplace_back();
      part.node = node_;
      part.primitives = {p};
      part.points.assign(static_cast<std::size_t>(positions.cols()), -1);
      set_frames(part, attributes);
    }
  }

  void note_without_triangles(const Json& primitive) {
    const auto extensions = primitive.value("extensions", Json::object()).dump();
    const bool are_splats = extensions.find("gaussian_splatting") != std::string::npos;
    note_unread(are_splats                      ? "Gaussian splats"
                : whole(primitive["mode"]) == 0 ? "points"
                                                : "lines");
  }

  void note_unread(const std::string& name) {
    if (unread_.find(name) != std::string::npos) return;
    unread_ += (unread_.empty() ? "" : " and ") + name;
  }

  void add_triangle(const GltfPart& part, std::array<std::size_t, 3> corners,
                    const std::array<bool, 2>& has, Index material) {
    for (const auto corner : corners) {
      if (corner >= part.points.size())
        damaged("a triangle has the vertex " + std::to_string(corner) + ", which is out of range");
    }
    if (part.is_mirrored) std::swap(corners[1], corners[2]);
    std::vector<Index> polygon;
    std::vector<CornerReferences> references;
    for (const auto corner : corners) {
      polygon.push_back(part.points[corner]);
      const auto attribute = part.first + static_cast<Index>(corner);
      references.push_back({has[0] ? attribute : -1, has[1] ? attribute : -1});
    }
    // Without an area it is no polygon for anyone.
    if (polygon[0] == polygon[1] || polygon[1] == polygon[2] || polygon[2] == polygon[0]) {
      ++num_flat_;
      return;
    }
    model_.soup.polygons.push_back(std::move(polygon));
    model_.attributes.corners.push_back(std::move(references));
    model_.polygon_materials.push_back(material);
  }

  // Primitives may share their vertices. \param coordinates  of the texture
  GltfPart& part_of(const Json& primitive, const std::string& coordinates) {
    const auto& attributes = primitive.at("attributes");
    const auto key =
        attributes.dump() + primitive.value("targets", Json::array()).dump() + coordinates;
    if (const auto found = known_.find(key); found != known_.end()) {
      return source_->parts[found->second];
    }
    known_[key] = source_->parts.size();
    auto& part = source_->parts.emplace_back();
    part.node = node_;
    part.first = static_cast<Index>(normals_.size() / 3);
    const auto& node = json().at("nodes").at(node_);
    whole(attributes.at("POSITION"));
    const auto places = document_.morphed(node, primitive, "POSITION", 3);
    part.is_mirrored = frame_.linear().determinant() < 0;
    part.points.resize(static_cast<std::size_t>(places.cols()));
    set_frames(part, attributes);
    for (Eigen::Index k = 0; k < places.cols(); ++k) {
      const Vector<3> place = places.col(k);
      const auto vertex = static_cast<std::size_t>(k);
      part.points[vertex] = add_point(part.frame(vertex) * place, k);
    }
    add_normals(part, document_.morphed(node, primitive, "NORMAL", 3), attributes);
    add_texture(attributes, coordinates, places.cols());
    add_colors(attributes, part);
    for (const auto& [name, unused] : attributes.items()) {
      const bool is_texture = name.compare(0, 9, "TEXCOORD_") == 0 && name != coordinates;
      if (is_texture || name == "COLOR_1" || name == "TANGENT") add_other(model_, name);
    }
    return part;
  }

  void set_frames(GltfPart& part, const Json& attributes) {
    part.is_skinned = !joints_.empty() && attributes.contains("JOINTS_0");
    part.frames = part.is_skinned
                      ? skinned_frames(attributes, static_cast<Eigen::Index>(part.points.size()))
                      : std::vector<Eigen::Affine3d>{frame_};
  }

  Index add_point(const Vector<3>& point, Eigen::Index k) {
    if (!point.allFinite()) damaged("vertex " + std::to_string(k) + " of a mesh is not finite");
    const auto next = static_cast<Index>(model_.soup.points.size());
    const auto [entry, is_new] =
        number_of_.emplace(std::tuple(point.x(), point.y(), point.z()), next);
    if (is_new) model_.soup.points.push_back(point);
    return entry->second;
  }

  Eigen::MatrixXd attribute(const Json& attributes, const std::string& name, int rows,
                            Eigen::Index vertices, const char* things) const {
    auto columns = document_.numbers(whole(attributes.at(name)), rows);
    require_all(columns, vertices, things);
    return columns;
  }

  void require_all(const Eigen::MatrixXd& columns, Eigen::Index vertices,
                   const char* things) const {
    if (columns.cols() < vertices)
      damaged("a mesh has fewer " + std::string(things) + " than vertices");
  }

  void add_normals(const GltfPart& part, const Eigen::MatrixXd& normals, const Json& attributes) {
    const auto count = static_cast<Eigen::Index>(part.points.size());
    if (!attributes.contains("NORMAL")) {
      normals_.insert(normals_.end(), 3 * part.points.size(), 0.0);
      return;
    }
    require_all(normals, count, "normals");
    for (Eigen::Index k = 0; k < count; ++k) {
      const Vector<3> normal = transformed_normal(part.frame(static_cast<std::size_t>(k)).linear(),
                                                  Vector<3>(normals.col(k)));
      normals_.insert(normals_.end(), normal.begin(), normal.end());
    }
    has_normals_ = true;
  }

  void add_texture(const Json& attributes, const std::string& name, Eigen::Index count) {
    if (!attributes.contains(name)) {
      texture_.insert(texture_.end(), 2 * static_cast<std::size_t>(count), 0.0);
      return;
    }
    const auto places = attribute(attributes, name, 2, count, "texture coordinates");
    for (Eigen::Index k = 0; k < count; ++k) {
      texture_.push_back(places(0, k));
      texture_.push_back(1 - places(1, k));
    }
    has_texture_ = true;
  }

  // From linear colors to those that most other files have.
  void add_colors(const Json& attributes, const GltfPart& part) {
    if (!attributes.contains("COLOR_0")) return;
    const auto count = static_cast<Eigen::Index>(part.points.size());
    const auto colors = attribute(attributes, "COLOR_0", 3, count, "colors");
    for (Eigen::Index k = 0; k < count; ++k) {
      colors_[part.points[static_cast<std::size_t>(k)]] = colors.col(k).unaryExpr(&to_srgb);
    }
  }

  void finish() {
    auto& attributes = model_.attributes;
    const auto count = static_cast<Eigen::Index>(normals_.size() / 3);
    if (has_normals_)
      attributes.normals = Eigen::Map<const PointList<3>>(normals_.data(), 3, count);
    if (has_texture_)
      attributes.texture_coordinates = Eigen::Map<const PointList<2>>(texture_.data(), 2, count);
    if (!has_normals_ && !has_texture_) attributes.corners.clear();
    if (colors_.size() == model_.soup.points.size()) {
      attributes.colors.resize(3, static_cast<Eigen::Index>(colors_.size()));
      for (const auto& [vertex, color] : colors_) attributes.colors.col(vertex) = color;
      keep_colors_in_range(model_);
    }
    keep_finite<3>(model_, attributes.normals);
    keep_finite<2>(model_, attributes.texture_coordinates);
    const auto& materials = model_.polygon_materials;
    if (std::all_of(materials.begin(), materials.end(), [](Index m) { return m < 0; })) {
      model_.polygon_materials.clear();
    }
    source_->path = path_;
    model_.gltf = std::move(source_);
  }

  const std::string& path_;
  ModelScan& scan_;
  Model& model_;
  GltfDocument document_;
  std::shared_ptr<GltfSource> source_ = std::make_shared<GltfSource>();
  std::vector<std::ptrdiff_t> parents_;
  std::vector<bool> visited_;
  std::size_t node_ = 0;                      // with the present mesh
  Eigen::Affine3d frame_;                     // of it
  std::vector<Eigen::Affine3d> joints_;       // of its skin, from where it was bound
  std::vector<std::string> coordinate_sets_;  // of the textures of materials
  std::set<std::string> other_pictures_;      // extensions by which textures have pictures
  std::map<std::string, std::size_t> known_;  // parts of it, by their attributes
  std::string unread_;                        // kinds of primitives and meshes
  std::map<std::tuple<double, double, double>, Index> number_of_;
  std::vector<double> normals_, texture_;  // of the vertices of the file
  std::map<Index, Vector<3>> colors_;      // of those of the model
  bool has_normals_ = false, has_texture_ = false, has_negative_ = false;
  std::size_t num_flat_ = 0;  // triangles without area
};

}  // namespace

void read_gltf(const std::string& path, Extent, ModelScan& scan) {
  refusing_damage(path, [&] { GltfScanner(path, scan).run(); });
}

}  // namespace flbc::io
