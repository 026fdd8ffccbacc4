// SPDX-License-Identifier: BSD-3-Clause
// glTF 2.0, .glb and .gltf: the triangles of all meshes where the nodes of the scene put them.
// Coincident points are one vertex, because files part a vertex where its attributes differ.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include <Eigen/Geometry>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "model/gltf_json.h"
#include "model/model_scan.h"
#include "model/srgb.h"
#include "text/bytes.h"

namespace flbc::io {
namespace {

using Json = nlohmann::ordered_json;
using Chunk = std::pair<std::size_t, std::size_t>;  // begin and end in the file

constexpr std::size_t kGlbHeader = 12, kChunkHead = 8;

// Of a .glb file: the JSON and, if there is one, the binary chunk.
std::array<Chunk, 2> chunks_of(const std::string& path, const std::string& bytes) {
  std::array<Chunk, 2> chunks{};
  std::size_t begin = kGlbHeader;
  for (auto& chunk : chunks) {
    if (bytes.size() < begin + kChunkHead) break;
    const auto size = number_at<std::uint32_t>(bytes.data() + begin);
    begin += kChunkHead;
    if (size > bytes.size() - begin) {
      throw InputError(path + ": the file ends within the chunk at byte " +
                       std::to_string(begin - kChunkHead));
    }
    chunk = {begin, begin + size};
    begin += size;
  }
  return chunks;
}

bool is_binary(const std::string& bytes) {
  return bytes.compare(0, 4, "glTF") == 0;
}

std::string from_base64(const std::string& text) {
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (value < 0) continue;
    bits = bits << 6 | static_cast<unsigned>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

// Sizes of the numbers of an accessor by its type; 0 = unknown.
std::size_t component_size(std::size_t type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 0, 4, 4};  // 5120 .. 5126
  return type >= 5120 && type <= 5126 ? kSizes[type - 5120] : 0;
}
constexpr std::size_t kFloat = 5126;

int rows_of(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

class GltfScanner {
 public:
  GltfScanner(const std::string& path, ModelScan& scan)
      : path_(path), scan_(scan), model_(scan.model) {}

  void run() {
    model_.is_text = false;
    read_json();
    read_materials();
    visit_scene();
    if (model_.soup.polygons.empty()) fail("the file has no triangles");
    finish();
  }

 private:
  // A run of numbers in a buffer. Those of the binary chunk have a place in the file.
  struct View {
    const char* data = nullptr;
    std::size_t count = 0, stride = 0;
    std::size_t place = 0;  // 0 = none
    std::size_t type = 0;
    int rows = 0;
    bool is_normalized = false;

    double at(std::size_t k, int row) const {
      const auto size = component_size(type);
      const bool is_signed = type % 2 == 0;
      const double value =
          decode_number(data + k * stride + row * size, size, type == kFloat, is_signed);
      if (!is_normalized || type == kFloat) return value;
      return std::max(-1.0, value / (std::ldexp(1.0, static_cast<int>(8 * size - is_signed)) - 1));
    }
  };

  // The vertices of a primitive: those of the file, and of the model.
  struct Vertices {
    Index first = 0;
    std::vector<Index> numbers;
    bool has_normals = false, has_texture = false;
  };

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(path_ + ": " + message);
  }

  void read_json() {
    const auto& bytes = scan_.text;
    if (is_binary(bytes)) {
      const auto [json, binary] = chunks_of(path_, bytes);
      binary_ = binary;
      scan_.finish = with_bounds_of_points;
      json_ = Json::parse(bytes.begin() + static_cast<std::ptrdiff_t>(json.first),
                          bytes.begin() + static_cast<std::ptrdiff_t>(json.second));
    } else {
      json_ = Json::parse(bytes);
      scan_.fixed =
          path_ + ": the numbers of a .gltf file are elsewhere; write .glb or another format";
    }
    for (const auto& name : json_.value("extensionsRequired", Json::array())) {
      const auto extension = name.get<std::string>();
      if (extension.find("compression") != std::string::npos) {
        fail("the extension " + extension + " is not supported; export the model uncompressed");
      }
    }
    if (json_.contains("animations")) add_other(model_, "animations");
    if (json_.contains("skins")) add_other(model_, "skins");
    if (json_.contains("materials")) add_other(model_, "materials");
    for (const auto& buffer : json_.value("buffers", Json::array())) {
      buffers_.push_back(buffer.contains("uri") ? content_of(buffer.at("uri")) : "");
    }
  }

  // Of an address in the file: data, or a file next to it.
  std::string content_of(const std::string& uri) const {
    const auto comma = uri.find(',');
    if (uri.compare(0, 5, "data:") == 0 && comma != std::string::npos) {
      return from_base64(uri.substr(comma + 1));
    }
    return read_file(beside(path_, uri));
  }

  View view_of(const Json& index, std::size_t offset) const {
    const auto number = whole(index);
    const auto& json = json_.at("bufferViews").at(number);
    const auto buffer = whole(json.at("buffer"));
    const auto begin = whole(json, "byteOffset", 0);
    const auto length = whole(json.at("byteLength"));
    const bool is_inside = buffers_.at(buffer).empty();
    const auto size = is_inside ? binary_.second - binary_.first : buffers_[buffer].size();
    if (begin > size || length > size - begin || offset > length) {
      fail("buffer view " + std::to_string(number) + " ends outside its buffer");
    }
    View view;
    view.place = is_inside ? binary_.first + begin + offset : 0;
    view.data =
        is_inside ? scan_.text.data() + view.place : buffers_[buffer].data() + begin + offset;
    view.count = length - offset;  // bytes
    view.stride = whole(json, "byteStride", 0);
    return view;
  }

  View accessor(const Json& index, int rows) const {
    const auto number = whole(index);
    const auto& json = json_.at("accessors").at(number);
    const auto name = "accessor " + std::to_string(number);
    if (json.contains("sparse") || !json.contains("bufferView")) {
      fail(name + " is sparse, which is not supported");
    }
    auto view = view_of(json.at("bufferView"), whole(json, "byteOffset", 0));
    const auto bytes = view.count;
    view.count = whole(json.at("count"));
    view.type = whole(json.at("componentType"));
    view.rows = rows_of(json.at("type"));
    view.is_normalized = json.value("normalized", false);
    const auto size = component_size(view.type) * static_cast<std::size_t>(view.rows);
    if (size == 0 || view.rows < rows) fail(name + " has another type than its use needs");
    if (view.stride == 0) view.stride = size;
    if (view.count > 0 &&
        (view.stride < size || bytes < size || (view.count - 1) > (bytes - size) / view.stride)) {
      fail(name + " ends outside its buffer view");
    }
    return view;
  }

  // ------------------------------------------------------------------------------------- materials

  void read_materials() {
    for (const auto& json : json_.value("materials", Json::array())) {
      auto& material = model_.materials.emplace_back();
      material.name = json.value("name", "material" + std::to_string(model_.materials.size() - 1));
      const auto surface = json.value("pbrMetallicRoughness", Json::object());
      const auto color = surface.value("baseColorFactor", std::vector<double>{1, 1, 1, 1});
      for (int k = 0; k < 3; ++k) material.color[k] = std::clamp(color.at(k), 0.0, 1.0);
      material.opacity =
          json.value("alphaMode", "") == "BLEND" ? std::clamp(color.at(3), 0.0, 1.0) : 1;
      material.roughness = std::clamp(surface.value("roughnessFactor", 1.0), 0.0, 1.0);
      material.metallic = std::clamp(surface.value("metallicFactor", 1.0), 0.0, 1.0);
      if (surface.contains("baseColorTexture")) read_texture(surface["baseColorTexture"], material);
      if (json.contains("normalTexture")) add_other(model_, "normal maps");
    }
  }

  void read_texture(const Json& texture, Material& material) {
    const auto source = json_.at("textures").at(whole(texture.at("index")));
    if (!source.contains("source")) return;
    const auto number = whole(source["source"]);
    const auto& image = json_.at("images").at(number);
    material.texture = path_ + "#" + std::to_string(number);
    if (image.contains("bufferView")) {
      const auto view = view_of(image.at("bufferView"), 0);
      material.picture.assign(view.data, view.count);
      return;
    }
    const auto uri = image.at("uri").get<std::string>();
    if (uri.compare(0, 5, "data:") == 0) {
      material.picture = content_of(uri);
    } else {
      material.texture = beside(path_, uri);
    }
  }

  // ------------------------------------------------------------------------------------- triangles

  void visit_scene() {
    const auto nodes = json_.value("nodes", Json::array());
    parents_.assign(nodes.size(), -1);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const auto child : wholes(nodes[k], "children"))
        parents_.at(child) = static_cast<std::ptrdiff_t>(k);
    }
    std::vector<std::size_t> roots;
    if (json_.contains("scenes")) {
      const auto& scene = json_["scenes"].at(whole(json_, "scene", 0));
      roots = wholes(scene, "nodes");
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
      if (++visits_ > nodes.size()) fail("a node has two parents");
      const auto& node = nodes.at(k);
      if (node.contains("mesh")) {
        begin_node(node.contains("skin") ? transform_of_skin(nodes, whole(node.at("skin")))
                                         : world_transform(nodes, k));
        for (const auto& primitive :
             json_.at("meshes").at(whole(node.at("mesh"))).at("primitives")) {
          add_primitive(primitive);
        }
      }
      const auto children = wholes(node, "children");
      left.insert(left.end(), children.rbegin(), children.rend());
    }
  }

  Eigen::Affine3d world_transform(const Json& nodes, std::size_t node) const {
    auto transform = transform_of(nodes.at(node));
    std::size_t depth = 0;
    for (auto parent = parents_.at(node); parent >= 0;
         parent = parents_[static_cast<std::size_t>(parent)]) {
      if (++depth > nodes.size()) fail("nodes form a circle");
      transform = transform_of(nodes[static_cast<std::size_t>(parent)]) * transform;
    }
    return transform;
  }

  // At rest all joints of a skin move its mesh alike, and its node not at all.
  Eigen::Affine3d transform_of_skin(const Json& nodes, std::size_t number) const {
    const auto& skin = json_.at("skins").at(number);
    auto transform = world_transform(nodes, whole(skin.at("joints").at(0)));
    if (!skin.contains("inverseBindMatrices")) return transform;
    const auto matrices = accessor(skin.at("inverseBindMatrices"), 16);
    Eigen::Affine3d inverse = Eigen::Affine3d::Identity();
    for (int k = 0; k < 16 && matrices.count > 0; ++k)
      inverse.matrix()(k % 4, k / 4) = matrices.at(0, k);
    return transform * inverse;
  }

  void begin_node(const Eigen::Affine3d& transform) {
    if (!transform.matrix().allFinite() || std::abs(transform.linear().determinant()) < 1e-300) {
      fail("the transform of a node cannot be inverted");
    }
    // Bits that only rounding has set in products of transforms would change coordinates.
    frame_ = transform;
    if ((transform.matrix() - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff() < 1e-7)
      frame_.setIdentity();
    scan_.frames.push_back(frame_);
    if (scan_.frames.size() > std::numeric_limits<std::uint16_t>::max()) fail("too many nodes");
    number_of_frame_ = static_cast<std::uint16_t>(scan_.frames.size());
    known_.clear();
  }

  void add_primitive(const Json& primitive) {
    constexpr std::size_t kTriangles = 4, kStrip = 5, kFan = 6;
    const auto mode = whole(primitive, "mode", kTriangles);
    if (mode < kTriangles || mode > kFan) return add_other(model_, "points and lines");
    if (primitive.contains("targets")) add_other(model_, "morph targets");
    const auto& vertices = vertices_of(primitive.at("attributes"));
    std::vector<std::size_t> corners;
    if (primitive.contains("indices")) {
      const auto indices = accessor(primitive.at("indices"), 1);
      for (std::size_t k = 0; k < indices.count; ++k) corners.push_back(to_whole(indices.at(k, 0)));
    } else {
      for (std::size_t k = 0; k < vertices.numbers.size(); ++k) corners.push_back(k);
    }
    const bool has_material = primitive.contains("material");
    const auto number = whole(primitive, "material", 0);
    if (has_material && number >= model_.materials.size()) fail("a material is out of range");
    const auto material = has_material ? static_cast<Index>(number) : -1;
    for (std::size_t k = 2; k < corners.size(); k += mode == kTriangles ? 3 : 1) {
      const bool is_odd = mode == kStrip && k % 2 == 1;
      const std::size_t first = mode == kFan ? 0 : k - 2;
      add_triangle(vertices,
                   {corners[is_odd ? k - 1 : first], corners[is_odd ? k - 2 : k - 1], corners[k]},
                   material);
    }
  }

  void add_triangle(const Vertices& vertices, const std::array<std::size_t, 3>& corners,
                    Index material) {
    auto& polygon = model_.soup.polygons.emplace_back();
    auto& references = model_.attributes.corners.emplace_back();
    for (const auto corner : corners) {
      if (corner >= vertices.numbers.size())
        fail("a triangle has the vertex " + std::to_string(corner) + ", which is out of range");
      polygon.push_back(vertices.numbers[corner]);
      const auto attribute = vertices.first + static_cast<Index>(corner);
      references.push_back(
          {vertices.has_texture ? attribute : -1, vertices.has_normals ? attribute : -1});
    }
    // Without an area it is no polygon for anyone.
    if (polygon[0] == polygon[1] || polygon[1] == polygon[2] || polygon[2] == polygon[0]) {
      model_.soup.polygons.pop_back();
      model_.attributes.corners.pop_back();
      return;
    }
    model_.polygon_materials.push_back(material);
  }

  // Primitives may share their vertices.
  const Vertices& vertices_of(const Json& attributes) {
    const auto key = attributes.dump();
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    auto& vertices = known_[key];
    vertices.first = static_cast<Index>(normals_.size() / 3);
    const auto number = whole(attributes.at("POSITION"));
    const auto places = accessor(attributes.at("POSITION"), 3);
    const bool has_sites = places.place != 0;
    if (has_sites && !placed_.insert(number).second) {
      scan_.fixed =
          path_ + ": two nodes or primitives place the same vertices; write another format";
    }
    for (std::size_t k = 0; k < places.count; ++k) {
      vertices.numbers.push_back(add_point(places, k));
      for (int d = 0; d < 3 && has_sites; ++d)
        add_site(places, k, d, TripleKind::kPoint, vertices.numbers.back());
    }
    vertices.has_normals = attributes.contains("NORMAL");
    vertices.has_texture = attributes.contains("TEXCOORD_0");
    add_normals(attributes, vertices);
    add_texture(attributes, vertices);
    add_colors(attributes, vertices);
    return vertices;
  }

  Index add_point(const View& places, std::size_t k) {
    const Vector<3> local(places.at(k, 0), places.at(k, 1), places.at(k, 2));
    const Vector<3> point = frame_ * local;
    if (!point.allFinite()) fail("vertex " + std::to_string(k) + " of a mesh is not finite");
    const auto next = static_cast<Index>(model_.soup.points.size());
    const auto [entry, is_new] =
        number_of_.emplace(std::tuple(point.x(), point.y(), point.z()), next);
    if (is_new) model_.soup.points.push_back(point);
    return entry->second;
  }

  void add_site(const View& view, std::size_t k, int axis, TripleKind kind, Index index) {
    const auto size = component_size(view.type);
    const NumberPlace place{view.place + k * view.stride + axis * size,
                            static_cast<std::uint32_t>(size),
                            view.type == kFloat ? NumberForm::kFloat : NumberForm::kInteger};
    scan_.sites.push_back({place, kind, static_cast<std::uint8_t>(axis), index, number_of_frame_});
  }

  View attribute(const Json& attributes, const char* name, int rows, std::size_t vertices,
                 const char* numbers) const {
    const auto view = accessor(attributes.at(name), rows);
    if (view.count < vertices) fail("a mesh has fewer " + std::string(numbers) + " than vertices");
    return view;
  }

  void add_normals(const Json& attributes, const Vertices& vertices) {
    const auto count = vertices.numbers.size();
    if (!vertices.has_normals) {
      normals_.insert(normals_.end(), 3 * count, 0.0);
      return;
    }
    const auto view = attribute(attributes, "NORMAL", 3, count, "normals");
    const Eigen::Matrix3d turn = frame_.linear().inverse().transpose();
    for (std::size_t k = 0; k < count; ++k) {
      const Vector<3> normal = turn * Vector<3>(view.at(k, 0), view.at(k, 1), view.at(k, 2));
      const auto index = static_cast<Index>(normals_.size() / 3);
      normals_.insert(normals_.end(), normal.begin(), normal.end());
      for (int d = 0; d < 3 && view.place != 0; ++d)
        add_site(view, k, d, TripleKind::kNormal, index);
    }
    has_normals_ = true;
  }

  void add_texture(const Json& attributes, const Vertices& vertices) {
    const auto count = vertices.numbers.size();
    if (!vertices.has_texture) {
      texture_.insert(texture_.end(), 2 * count, 0.0);
      return;
    }
    const auto view = attribute(attributes, "TEXCOORD_0", 2, count, "texture coordinates");
    for (std::size_t k = 0; k < count; ++k) {
      texture_.push_back(view.at(k, 0));
      texture_.push_back(1 - view.at(k, 1));
    }
    has_texture_ = true;
  }

  // From linear colors to those that most other files have.
  void add_colors(const Json& attributes, const Vertices& vertices) {
    if (!attributes.contains("COLOR_0")) return;
    const auto view = attribute(attributes, "COLOR_0", 3, vertices.numbers.size(), "colors");
    for (std::size_t k = 0; k < vertices.numbers.size(); ++k) {
      auto& color = colors_[vertices.numbers[k]];
      for (int d = 0; d < 3; ++d) color[d] = to_srgb(view.at(k, d));
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
    std::stable_sort(scan_.sites.begin(), scan_.sites.end(),
                     [](const Site& a, const Site& b) { return a.place.begin < b.place.begin; });
  }

  const std::string& path_;
  ModelScan& scan_;
  Model& model_;
  Json json_;
  Chunk binary_{};
  std::vector<std::string> buffers_;  // empty: the binary chunk
  std::vector<std::ptrdiff_t> parents_;
  std::size_t visits_ = 0;
  Eigen::Affine3d frame_;
  std::uint16_t number_of_frame_ = 0;
  std::map<std::string, Vertices> known_;  // of the present node, by their attributes
  std::set<std::size_t> placed_;           // accessors
  std::map<std::tuple<double, double, double>, Index> number_of_;
  std::vector<double> normals_, texture_;  // of the vertices of the file
  std::map<Index, Vector<3>> colors_;      // of those of the model
  bool has_normals_ = false, has_texture_ = false;
};

template <class Action>
auto refusing_damage(const std::string& path, const Action& action) {
  try {
    return action();
  } catch (const Json::exception&) {
    throw InputError(path + ": not a glTF file, or damaged");
  } catch (const std::out_of_range&) {
    throw InputError(path + ": not a glTF file, or damaged");
  }
}

}  // namespace

void read_gltf(const std::string& path, Extent, ModelScan& scan) {
  refusing_damage(path, [&] { GltfScanner(path, scan).run(); });
}

std::string with_bounds_of_points(std::string bytes) {
  const auto [json_chunk, binary] = chunks_of("", bytes);
  auto json = Json::parse(bytes.substr(json_chunk.first, json_chunk.second - json_chunk.first));
  std::set<std::size_t> positions;
  for (const auto& mesh : json.at("meshes")) {
    for (const auto& primitive : mesh.at("primitives")) {
      positions.insert(whole(primitive.at("attributes").at("POSITION")));
    }
  }
  for (const auto number : positions) {
    auto& accessor = json.at("accessors").at(number);
    if (accessor.at("componentType") != kFloat || !accessor.contains("bufferView")) continue;
    const auto& view = json.at("bufferViews").at(whole(accessor.at("bufferView")));
    const auto stride = whole(view, "byteStride", 12);
    const char* point = bytes.data() + binary.first + whole(view, "byteOffset", 0) +
                        whole(accessor, "byteOffset", 0);
    Eigen::AlignedBox3f box;
    for (std::size_t k = 0; k < whole(accessor.at("count")); ++k, point += stride) {
      box.extend(number_at<Eigen::Vector3f>(point));
    }
    for (int d = 0; d < 3; ++d) {
      accessor["min"][d] = box.min()[d];
      accessor["max"][d] = box.max()[d];
    }
  }
  auto text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string result =
      bytes.substr(0, kGlbHeader + kChunkHead) + text + bytes.substr(json_chunk.second);
  put_number(static_cast<std::uint32_t>(result.size()), result.data() + 8);
  put_number(static_cast<std::uint32_t>(text.size()), result.data() + kGlbHeader);
  return result;
}

}  // namespace flbc::io
