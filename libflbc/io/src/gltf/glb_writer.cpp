// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/glb_writer.h"

#include <algorithm>
#include <fstream>  // missing in tiny_gltf.h
#include <limits>
#include <map>
#include <sstream>
#include <vector>

#include <Eigen/Geometry>

#include "flbc/version.h"

#include <tiny_gltf.h>
#include <nlohmann/json.hpp>

#include "gltf/glb_buffer.h"

namespace flbc::gltf {
namespace {

// Length of joints drawn as bones, relative to cage size.
constexpr float kBoneLength = 0.02F;

// JSON must be UTF-8, but a file name may not be.
std::string as_utf8(const std::string& name) {
  using Json = nlohmann::json;
  return Json::parse(Json(name).dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::vector<double> to_doubles(const Eigen::Vector3f& point) {
  return {point.x(), point.y(), point.z()};
}

// Adds the parts of the scene to the model of the library.
class ModelBuilder {
 public:
  explicit ModelBuilder(const GlbScene& scene) : scene_(scene), buffer_(model_) {
    model_.asset.version = "2.0";
    model_.asset.generator = "flbc " FLBC_VERSION;
    add_materials();
    add_mesh();
    add_joints();
    add_animation();
    model_.scenes.emplace_back();
    model_.scenes[0].name = "model";
    model_.scenes[0].nodes = {kMeshNode, kCageNode};
    model_.defaultScene = 0;
    if (scene_.wire.cols() > 0) add_wire();
  }

  const tinygltf::Model& model() const { return model_; }

 private:
  // Node indices.
  static constexpr int kMeshNode = 0;
  static constexpr int kCageNode = 1;
  static constexpr int kFirstJoint = 2;

  void add_mesh() {
    std::map<std::string, int> attributes;
    attributes["POSITION"] = buffer_.add_attribute<float>(scene_.positions, true);
    attributes["NORMAL"] = buffer_.add_attribute<float>(scene_.normals);
    if (scene_.texture_coordinates.cols() > 0) {
      attributes["TEXCOORD_0"] = buffer_.add_attribute<float>(scene_.texture_coordinates);
    }
    if (scene_.colors.cols() > 0) {
      attributes["COLOR_0"] = buffer_.add_attribute<float>(scene_.colors);
    }
    if (scene_.sources.cols() > 0) {
      attributes["_VERTEX"] = buffer_.add_attribute<float>(scene_.sources);
    }
    add_influences(attributes);

    tinygltf::Mesh mesh;
    mesh.name = as_utf8(scene_.name);
    for (const auto& [material, triangles] : triangles_by_material()) {
      tinygltf::Primitive primitive;
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      primitive.attributes = attributes;
      primitive.indices = buffer_.add_indices(FacetList<3>(scene_.triangles(Eigen::all, triangles)),
                                              scene_.positions.cols());
      primitive.material = material;
      mesh.primitives.push_back(primitive);
    }
    add_skinned(mesh);
  }

  // Adds a node with the skinned mesh. \return its index
  int add_skinned(const tinygltf::Mesh& mesh) {
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(model_.meshes.size());
    node.skin = 0;
    model_.meshes.push_back(mesh);
    model_.nodes.push_back(node);
    return static_cast<int>(model_.nodes.size()) - 1;
  }

  // By index of the glTF materials.
  std::map<int, std::vector<Index>> triangles_by_material() const {
    std::map<int, std::vector<Index>> result;
    const auto& materials = scene_.look.triangle_materials;
    for (Index t = 0; t < static_cast<Index>(scene_.triangles.cols()); ++t) {
      const Index material = materials.empty() ? -1 : materials[t];
      result[material < 0 ? plain_material_ : material].push_back(t);
    }
    return result;
  }

  // The cage edges, skinned by the control points, in a second scene that is not shown by default.
  void add_wire() {
    const auto count = scene_.joints.cols();
    Eigen::MatrixXf joints = Eigen::MatrixXf::Zero(4, count);
    Eigen::MatrixXf weights = joints;
    for (Eigen::Index i = 0; i < count; ++i) joints(0, i) = static_cast<float>(i);
    weights.row(0).setOnes();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_LINE;
    primitive.attributes["POSITION"] = buffer_.add_attribute<float>(scene_.joints, true);
    primitive.attributes["JOINTS_0"] = buffer_.add_attribute<std::uint16_t>(joints);
    primitive.attributes["WEIGHTS_0"] = buffer_.add_attribute<float>(weights);
    primitive.indices = buffer_.add_indices(scene_.wire, count);
    tinygltf::Mesh mesh;
    mesh.name = "cage_wire";
    mesh.primitives.push_back(primitive);
    tinygltf::Scene both;
    both.name = "model and cage";
    both.nodes = {kMeshNode, kCageNode, add_skinned(mesh)};
    model_.scenes.push_back(both);
  }

  void add_influences(std::map<std::string, int>& attributes) {
    const auto& weights = scene_.weights;
    for (Eigen::Index set = 0; set < weights.joints.rows() / 4; ++set) {
      const auto joints = weights.joints.middleRows(4 * set, 4);
      const auto numbers = weights.numbers.middleRows(4 * set, 4);
      const auto suffix = std::to_string(set);
      // The joint after the control points is the root.
      const bool is_small = scene_.joints.cols() <= 256 && weights.joints.maxCoeff() < 256;
      attributes["JOINTS_" + suffix] = is_small ? buffer_.add_attribute<std::uint8_t>(joints)
                                                : buffer_.add_attribute<std::uint16_t>(joints);
      attributes["WEIGHTS_" + suffix] = add_numbers(numbers);
    }
  }

  template <class Matrix>
  int add_numbers(const Matrix& numbers) {
    if (scene_.weights.format == WeightFormat::kFloat) return buffer_.add_attribute<float>(numbers);
    const int accessor = scene_.weights.format == WeightFormat::kUnsignedShort
                             ? buffer_.add_attribute<std::uint16_t>(numbers)
                             : buffer_.add_attribute<std::uint8_t>(numbers);
    model_.accessors[accessor].normalized = true;
    return accessor;
  }

  // Without a material, viewers show polished metal. Double-sided, because models may be open, and
  // flat models are.
  static tinygltf::Material matt_material() {
    tinygltf::Material material;
    material.name = "model";
    material.doubleSided = true;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;
    return material;
  }

  // The materials of the file, and one for triangles without a material.
  void add_materials() {
    const auto& look = scene_.look;
    for (const auto& picture : look.pictures) {
      tinygltf::Image image;
      image.mimeType = picture.media_type;
      image.bufferView = buffer_.add_bytes(picture.bytes.data(), picture.bytes.size(), 0);
      tinygltf::Texture texture;
      texture.source = static_cast<int>(model_.images.size());
      texture.sampler = 0;
      model_.images.push_back(image);
      model_.textures.push_back(texture);
    }
    if (!look.pictures.empty()) {
      tinygltf::Sampler repeating;
      repeating.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
      repeating.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
      model_.samplers.push_back(repeating);
    }
    for (const auto& [given, picture] : look.materials) {
      auto material = matt_material();
      material.name = as_utf8(given.name);
      auto& surface = material.pbrMetallicRoughness;
      // A texture replaces the color, as intended by programs that write both.
      const Vector<3> color = picture < 0 ? given.color : Vector<3>::Ones();
      surface.baseColorFactor = {color[0], color[1], color[2], given.opacity};
      surface.baseColorTexture.index = picture;
      surface.roughnessFactor = given.roughness;
      surface.metallicFactor = given.metallic;
      if (given.opacity < 1) material.alphaMode = "BLEND";
      model_.materials.push_back(material);
    }
    const auto& used = look.triangle_materials;
    if (!used.empty() && std::find(used.begin(), used.end(), -1) == used.end()) return;
    plain_material_ = static_cast<int>(model_.materials.size());
    model_.materials.push_back(matt_material());
  }

  // All control points are children of one joint at the center of the cage. Programs that draw
  // joints as bones give leaf joints the length of the shortest sibling, which is the helper joint.
  void add_joints() {
    const auto num_points = scene_.joints.cols();
    const Eigen::Vector3f low = scene_.joints.rowwise().minCoeff();
    const Eigen::Vector3f size = scene_.joints.rowwise().maxCoeff() - low;
    centre_ = low + size / 2;
    tinygltf::Skin skin;
    skin.name = "cage";
    skin.skeleton = kCageNode;
    add_joint("cage", centre_, Eigen::Vector3f::Zero());
    const Eigen::Vector3d place = scene_.origin + centre_.cast<double>();
    model_.nodes[kCageNode].translation = {place.x(), place.y(), place.z()};
    if (!scene_.turn.isIdentity(0)) {
      const Eigen::Quaterniond turn(scene_.turn);
      model_.nodes[kCageNode].rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
    }
    for (Eigen::Index i = 0; i < num_points; ++i) {
      add_joint("control_point_" + std::to_string(i), scene_.joints.col(i) - centre_, centre_);
      skin.joints.push_back(joint_node(i));
    }
    add_joint("cage_end", Eigen::Vector3f(kBoneLength * size.norm(), 0, 0), centre_);
    const int helper = joint_node(num_points);
    model_.nodes[kCageNode].children = skin.joints;
    model_.nodes[kCageNode].children.push_back(helper);
    skin.joints.insert(skin.joints.end(), {kCageNode, helper});
    skin.inverseBindMatrices = add_inverse_binds(skin.joints);
    model_.skins.push_back(skin);
  }

  // Appends a node. \param parent  position of its parent
  void add_joint(const std::string& name, const Eigen::Vector3f& place,
                 const Eigen::Vector3f& parent) {
    tinygltf::Node joint;
    joint.name = name;
    joint.translation = to_doubles(place);
    model_.nodes.push_back(joint);
    places_.push_back(parent + place);
  }

  // The inverse bind matrix of each joint.
  int add_inverse_binds(const std::vector<int>& joints) {
    Eigen::MatrixXf inverse_binds(16, joints.size());
    for (std::size_t k = 0; k < joints.size(); ++k) {
      Eigen::Matrix4f inverse_bind = Eigen::Matrix4f::Identity();
      inverse_bind.col(3).head<3>() = -places_[joints[k] - kCageNode];
      inverse_binds.col(static_cast<Eigen::Index>(k)) = inverse_bind.reshaped();
    }
    return buffer_.add_accessor<float>(inverse_binds, 0);
  }

  static int joint_node(Eigen::Index joint) { return kFirstJoint + static_cast<int>(joint); }

  void add_animation() {
    if (scene_.channels.empty()) return;
    tinygltf::Animation animation;
    animation.name = "poses";
    const Eigen::Map<const Eigen::RowVectorXf> times(
        scene_.times.data(), static_cast<Eigen::Index>(scene_.times.size()));
    const int input = buffer_.add_accessor<float>(times, 0, true);
    for (const Channel& moving : scene_.channels) {
      tinygltf::AnimationSampler sampler;
      sampler.input = input;
      sampler.output = buffer_.add_accessor<float>(moving.translations.colwise() - centre_, 0);
      sampler.interpolation = "LINEAR";
      tinygltf::AnimationChannel channel;
      channel.sampler = static_cast<int>(animation.samplers.size());
      channel.target_node = joint_node(moving.joint);
      channel.target_path = "translation";
      animation.samplers.push_back(sampler);
      animation.channels.push_back(channel);
    }
    model_.animations.push_back(animation);
  }

  const GlbScene& scene_;
  tinygltf::Model model_;
  GlbBuffer buffer_;
  int plain_material_ = -1;              // of triangles without a material
  Eigen::Vector3f centre_;               // of the cage
  std::vector<Eigen::Vector3f> places_;  // of the nodes from kCageNode on, at rest
};

}  // namespace

std::string encode_glb(const GlbScene& scene) {
  const ModelBuilder builder(scene);
  std::ostringstream file;
  constexpr bool kIsPretty = false, kIsBinary = true;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&builder.model(), file, kIsPretty, kIsBinary);
  return file.str();
}

}  // namespace flbc::gltf
