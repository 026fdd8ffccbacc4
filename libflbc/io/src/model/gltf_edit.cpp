// SPDX-License-Identifier: BSD-3-Clause
#include "model/gltf_edit.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "flbc/io/cage_io.h"
#include "flbc/io/files.h"
#include "model/following_normals.h"
#include "model/gltf_json.h"

namespace flbc::io {
namespace {

constexpr int kBase = -1;  // in place of a morph target

const GltfPaths kToAccessors{
    "meshes/*/primitives/*/attributes/*", "meshes/*/primitives/*/targets/*/*",
    "meshes/*/primitives/*/indices",      "skins/*/inverseBindMatrices",
    "animations/*/samplers/*/input",      "animations/*/samplers/*/output"};
constexpr const char* kDraco = "KHR_draco_mesh_compression";
const GltfPaths kToViews{"accessors/*/bufferView", "accessors/*/sparse/indices/bufferView",
                         "accessors/*/sparse/values/bufferView", "images/*/bufferView",
                         "meshes/*/primitives/*/extensions/KHR_draco_mesh_compression/bufferView"};

// Whether extensions refer to accessors or buffer views only from these places, so that they can be
// renumbered.
bool are_references_known(const GltfJson& json) {
  constexpr std::string_view kWithout[] = {"KHR_materials_", "KHR_texture_", "KHR_lights_",
                                           "KHR_mesh_quant", "KHR_node_",    "KHR_xmp",
                                           "EXT_texture_",   "VRM",          "FB_ngon_encoding",
                                           "MSFT_lod",       kDraco};
  const auto extensions = json.value("extensionsUsed", std::vector<std::string>());
  return std::all_of(extensions.begin(), extensions.end(), [&](const std::string& extension) {
    return std::any_of(std::begin(kWithout), std::end(kWithout), [&](std::string_view name) {
      return extension.compare(0, name.size(), name) == 0;
    });
  });
}

// The vertices of the model in its file.
PointList<3> points_of(GltfEdit& edit, const GltfSource& source, Eigen::Index count) {
  PointList<3> points = PointList<3>::Zero(3, count);
  for (const auto& part : source.parts) {
    const auto places = edit.places(part);
    for (std::size_t k = 0; k < part.points.size(); ++k) {
      const Vector<3> place = places.col(static_cast<Eigen::Index>(k));
      if (part.points[k] >= count) throw std::out_of_range("a vertex");
      points.col(part.points[k]) = part.frame(k) * place;
    }
  }
  return points;
}

// \param before  the points of the model in its file \param changes  of space around them
GltfMotion motion_of(GltfEdit& edit, const GltfPart& part, const Model& model,
                     const PointList<3>& before, const std::vector<Eigen::Matrix3d>& changes) {
  GltfMotion motion{edit.places(part), edit.normals(part), {}, {}};
  for (std::size_t k = 0; k < part.points.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Index v = part.points[k];
    const Eigen::Matrix3d local = part.frame(k).linear();
    bool moves = model.soup.points[v] != before.col(v) || !changes[v].isZero(0);
    if (motion.normals.cols() > 0) {
      const Vector<3> normal = model.attributes.normals.col(part.first + column);
      const Vector<3> rest = transformed_normal(local, Vector<3>(motion.normals.col(column)));
      moves = moves || (normal != rest && rest.allFinite());
      if (moves) motion.normals.col(column) = (local.transpose() * normal).stableNormalized();
    }
    motion.moves.push_back(moves);
    motion.turns.push_back(Eigen::Matrix3d::Identity());
    if (!moves) continue;
    const Eigen::Affine3d to_file = part.frame(k).inverse();
    if (!to_file.matrix().allFinite()) {
      edit.document.fail("joints with a scale of 0 flatten vertex " + std::to_string(v) +
                         ", in the mesh of node " + std::to_string(part.node) +
                         ", so it cannot move; write .obj");
    }
    motion.places.col(column) = to_file * model.soup.points[v];
    motion.turns.back() += to_file.linear() * changes[v] * local;
  }
  return motion;
}

}  // namespace

bool is_about_influences(const std::string& attribute) {
  return attribute.compare(0, 7, "JOINTS_") == 0 || attribute.compare(0, 8, "WEIGHTS_") == 0;
}

GltfEdit::GltfEdit(const GltfSource& source) : document(source.path, read_file(source.path)) {
  accessors_ = numbers_at(document.json, kToAccessors);
  views_ = numbers_at(document.json, kToViews);
  part_meshes(source);
  find_users();
}

void drop_compressed_copy(GltfJson& primitive) {
  drop_extension(primitive, kDraco);
}

std::string GltfEdit::glb() {
  drop_unused_compression();
  if (are_references_known(document.json)) {
    drop_unused(document.json, "accessors", kToAccessors, accessors_);
    if (drop_unused(document.json, "bufferViews", kToViews, views_) > 0) document.pack();
  }
  return document.glb();
}

void GltfEdit::drop_unused_compression() {
  if (numbers_at(document.json, {kToViews.back()}).empty()) {
    drop_extension_name(document.json, kDraco);
  }
}

// Nodes that show the same mesh get one each, as their vertices move in different ways.
void GltfEdit::part_meshes(const GltfSource& source) {
  std::set<std::size_t> parts, taken;
  for (const auto& part : source.parts) parts.insert(part.node);
  for (std::size_t k = 0; k < document.json["nodes"].size(); ++k) {
    if (node(k).contains("mesh") && parts.count(k) == 0) taken.insert(whole(node(k)["mesh"]));
  }
  for (const auto k : parts) {
    const auto mesh = whole(node(k).at("mesh"));
    if (taken.insert(mesh).second) continue;
    auto copy = document.json["meshes"].at(mesh);
    node(k)["mesh"] = document.append("meshes", std::move(copy));
  }
}

void GltfEdit::find_users() {
  const auto& meshes = document.json["meshes"];
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const auto& primitives = meshes[m].at("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      auto lists = primitives[p].value("targets", GltfJson::array());
      lists.push_back(primitives[p].at("attributes"));
      for (std::size_t t = 0; t < lists.size(); ++t) {
        const int target = t + 1 < lists.size() ? static_cast<int>(t) : kBase;
        for (const auto& [name, number] : lists[t].items()) {
          const auto& accessor = document.json["accessors"].at(whole(number));
          if (!accessor.contains("bufferView")) continue;
          users_[{whole(accessor["bufferView"]), whole(accessor, "byteOffset", 0)}].push_back(
              {m, p, target, name});
        }
      }
    }
  }
}

GltfJson& GltfEdit::primitive(const GltfPart& part, std::size_t number) {
  const auto mesh = whole(node(part.node).at("mesh"));
  return document.json["meshes"].at(mesh).at("primitives").at(number);
}

Eigen::MatrixXd GltfEdit::places(const GltfPart& part) {
  auto columns =
      document.morphed(node(part.node), primitive(part, part.primitives[0]), "POSITION", 3);
  if (columns.cols() != static_cast<Eigen::Index>(part.points.size())) {
    document.fail("the file has changed since it was read; run the command again");
  }
  return columns;
}

Eigen::MatrixXd GltfEdit::normals(const GltfPart& part) {
  return document.morphed(node(part.node), primitive(part, part.primitives[0]), "NORMAL", 3);
}

GltfJson& GltfEdit::attributes(const GltfPart& part, std::size_t number, int target) {
  auto& owner = primitive(part, number);
  return target == kBase ? owner["attributes"]
                         : owner["targets"].at(static_cast<std::size_t>(target));
}

bool GltfEdit::can_replace(const GltfPart& part, int target, const char* name,
                           std::size_t accessor) const {
  const auto& description = document.json["accessors"].at(accessor);
  if (!description.contains("bufferView") || description.contains("sparse") ||
      whole(description.at("componentType")) != kGltfFloat) {
    return false;
  }
  const auto mesh = whole(document.json["nodes"].at(part.node).at("mesh"));
  const auto found =
      users_.find({whole(description["bufferView"]), whole(description, "byteOffset", 0)});
  return found != users_.end() &&
         std::all_of(found->second.begin(), found->second.end(), [&](const User& user) {
           return user.mesh == mesh && user.target == target && user.name == name &&
                  std::count(part.primitives.begin(), part.primitives.end(), user.primitive) > 0;
         });
}

void GltfEdit::set(const GltfPart& part, int target, const char* name, Eigen::MatrixXd columns) {
  const bool is_finite = columns.cast<float>().allFinite();
  if (!is_finite && std::string_view(name) == "POSITION") {
    document.fail(
        "a vertex would have a coordinate that is not finite or too large for the single "
        "precision of the file");
  }
  // Reading counts directions that are not finite as missing, and no file may have them.
  if (!is_finite) {
    columns =
        columns.unaryExpr([](double x) { return std::isfinite(static_cast<float>(x)) ? x : 0; });
  }
  auto accessor = whole(attributes(part, part.primitives[0], target).at(name));
  if (can_replace(part, target, name, accessor)) return document.replace(accessor, columns);
  accessor = document.add_attribute(columns, std::string_view(name) == "POSITION");
  for (const auto number : part.primitives) attributes(part, number, target)[name] = accessor;
}

void GltfEdit::reverse(const GltfPart& part) {
  for (const auto number : part.primitives) {
    auto& reversed = primitive(part, number);
    auto triangles = document.triangles(reversed, part.points.size());
    if (triangles.cols() == 0) continue;
    triangles.row(1).swap(triangles.row(2));
    reversed.erase("mode");  // triangles
    reversed["indices"] =
        document.add_indices(triangles, static_cast<Eigen::Index>(part.points.size()));
  }
}

void GltfEdit::move(const GltfPart& part, const GltfMotion& motion) {
  const auto count = motion.places.cols();
  const auto moving = [&](Eigen::Index k) { return motion.moves[static_cast<std::size_t>(k)]; };
  const auto turn = [&](Eigen::Index k) { return motion.turns[static_cast<std::size_t>(k)]; };
  const auto base = [&](const char* name, int rows) {
    const auto& list = attributes(part, part.primitives[0], kBase);
    if (!list.contains(name)) return Eigen::MatrixXd();
    auto columns = document.numbers(whole(list[name]), rows);
    if (columns.cols() < count)
      document.damaged(std::string("a mesh has too few numbers in ") + name);
    return columns;
  };
  auto positions = base("POSITION", 3), normals = base("NORMAL", 3), tangents = base("TANGENT", 4);
  const auto weights = document.morph_weights(node(part.node));
  const auto targets = primitive(part, part.primitives[0]).value("targets", GltfJson::array());
  bool has_morphed_normals = false;
  for (std::size_t t = 0; t < std::min(weights.size(), targets.size()); ++t) {
    has_morphed_normals |= weights[t] != 0 && targets[t].contains("NORMAL") && normals.cols() > 0;
  }
  for (Eigen::Index k = 0; k < count; ++k) {
    if (!moving(k)) continue;
    positions.col(k) = motion.places.col(k);
    const Vector<3> old_normal =
        normals.cols() > 0 ? Vector<3>(normals.col(k)) : Vector<3>(Vector<3>::Zero());
    if (has_morphed_normals) {
      normals.col(k) = transformed_normal(turn(k), Vector<3>(normals.col(k)));
    } else if (normals.cols() > 0) {
      normals.col(k) = motion.normals.col(k);
    }
    if (tangents.cols() == 0) continue;
    const Vector<3> across = turn(k) * old_normal.cross(tangents.col(k).head<3>());
    Vector<3> tangent = turn(k) * tangents.col(k).head<3>();
    if (normals.cols() > 0) tangent -= tangent.dot(normals.col(k)) * normals.col(k);
    if (tangent.stableNorm() > 0) tangents.col(k).head<3>() = tangent.stableNormalized();
    // Mirrored textures stay mirrored on the side to which the normal now points.
    if (normals.cols() > 0 && Vector<3>(normals.col(k)).cross(tangent).dot(across) < 0) {
      tangents(3, k) *= -1;
    }
  }
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const auto target = static_cast<int>(t);
    const double weight = t < weights.size() ? weights[t] : 0;
    for (const char* name : {"POSITION", "NORMAL", "TANGENT"}) {
      if (!targets[t].contains(name)) continue;
      auto columns = document.numbers(whole(targets[t][name]), 3);
      if (columns.cols() != count)
        document.damaged("a morph target has another number of vertices");
      for (Eigen::Index k = 0; k < count; ++k) {
        if (!moving(k)) continue;
        const Vector<3> offset = columns.col(k);
        columns.col(k) =
            *name == 'N' ? transformed_normal(turn(k), offset) : Vector<3>(turn(k) * offset);
        if (*name == 'P') positions.col(k) -= weight * columns.col(k);
      }
      set(part, target, name, columns);
    }
  }
  for (const auto number : part.primitives) drop_compressed_copy(primitive(part, number));
  set(part, kBase, "POSITION", positions);
  if (normals.cols() > 0) set(part, kBase, "NORMAL", normals);
  if (tangents.cols() > 0) set(part, kBase, "TANGENT", tangents);
}

std::string moved_gltf(const Model& model) {
  const auto& source = *model.gltf;
  return refusing_damage(source.path, [&] {
    GltfEdit edit(source);
    edit.document.embed_pictures();
    const auto after = to_points<3>(model.soup, source.path);
    const auto before = points_of(edit, source, after.cols());
    const auto changes = changes_of_space(model.soup.polygons, before, after);
    for (const auto& part : source.parts) {
      const auto motion = motion_of(edit, part, model, before, changes);
      if (std::count(motion.moves.begin(), motion.moves.end(), true) > 0) edit.move(part, motion);
    }
    return edit.glb();
  });
}

std::vector<std::string> missing_pictures(const GltfSource& source) {
  return GltfDocument(source.path, read_file(source.path)).embed_pictures();
}

std::string unposed_gltf(const std::string& path, std::vector<std::string>& left_out) {
  return refusing_damage(path, [&] {
    GltfEdit edit(GltfSource{path, {}});
    auto& json = edit.document.json;
    const GltfPaths to_skins{"nodes/*/skin"};
    const auto skins = numbers_at(json, to_skins);
    if (skins.empty()) edit.document.fail("the file has no skin, so nothing is posed");
    for (auto& node : json["nodes"]) node.erase("skin");
    drop_unused(json, "skins", to_skins, skins);
    for (auto& mesh : json["meshes"]) {
      for (auto& primitive : mesh.at("primitives")) {
        auto kept = GltfJson::object();
        for (const auto& [name, accessor] : primitive.at("attributes").items()) {
          if (!is_about_influences(name)) kept[name] = accessor;
        }
        if (kept.size() < primitive["attributes"].size()) drop_compressed_copy(primitive);
        primitive["attributes"] = std::move(kept);
      }
    }
    left_out = edit.document.embed_pictures();
    return edit.glb();
  });
}

}  // namespace flbc::io
