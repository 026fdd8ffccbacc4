// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/glb_writer.h"

#include <cstring>
#include <fstream>  // tiny_gltf.h forgets it
#include <limits>
#include <sstream>
#include <type_traits>

#include "flbc/errors.h"
#include "flbc/version.h"

// The library's images and files are not needed: no other library is, then.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

namespace flbc::gltf {
namespace {

// More than that, with its description, might not fit the 32 bits in which the file has its length.
constexpr std::size_t kMaxBytes = 4'000'000'000;

// Of the joints drawn as bones, relative to the cage's size.
constexpr float kBoneLength = 0.02F;

template <class Number>
constexpr int component_type() {
  if constexpr (std::is_same_v<Number, std::uint8_t>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  if constexpr (std::is_same_v<Number, std::uint16_t>) {
    return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  }
  if constexpr (std::is_same_v<Number, std::uint32_t>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if constexpr (std::is_same_v<Number, float>) return TINYGLTF_COMPONENT_TYPE_FLOAT;
}

int element_type(Eigen::Index rows) {
  switch (rows) {
    case 1:
      return TINYGLTF_TYPE_SCALAR;
    case 2:
      return TINYGLTF_TYPE_VEC2;
    case 3:
      return TINYGLTF_TYPE_VEC3;
    case 4:
      return TINYGLTF_TYPE_VEC4;
    default:
      return TINYGLTF_TYPE_MAT4;
  }
}

// JSON must be UTF-8, which the name of a file need not be.
std::string as_utf8(const std::string& name) {
  using Json = nlohmann::json;
  return Json::parse(Json(name).dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::vector<double> to_doubles(const Eigen::Vector3f& point) {
  return {point.x(), point.y(), point.z()};
}

// Puts the parts of the scene into the library's model one after the other.
class ModelBuilder {
 public:
  explicit ModelBuilder(const GlbScene& scene) : scene_(scene) {
    model_.asset.version = "2.0";
    model_.asset.generator = "flbc " FLBC_VERSION;
    model_.buffers.emplace_back();
    add_mesh();
    add_joints();
    add_animation();
    model_.scenes.emplace_back();
    model_.scenes[0].nodes = {kMeshNode, kCageNode};
    model_.defaultScene = 0;
  }

  const tinygltf::Model& model() const { return model_; }

 private:
  // Where the nodes are among all.
  static constexpr int kMeshNode = 0;
  static constexpr int kCageNode = 1;
  static constexpr int kFirstJoint = 2;

  // Appends a column per element. \return the number of the accessor
  template <class Number, class Matrix>
  int add_accessor(const Matrix& columns, int target, bool has_bounds = false) {
    constexpr std::size_t kAlignment = 4;
    const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> numbers =
        columns.template cast<Number>();
    auto& bytes = model_.buffers[0].data;
    bytes.resize((bytes.size() + kAlignment - 1) / kAlignment * kAlignment);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = static_cast<std::size_t>(numbers.size()) * sizeof(Number);
    view.target = target;
    if (view.byteOffset + view.byteLength > kMaxBytes) {
      throw InputError("it has too many vertices: a .glb file cannot be larger than 4 GB");
    }
    bytes.resize(view.byteOffset + view.byteLength);
    std::memcpy(bytes.data() + view.byteOffset, numbers.data(), view.byteLength);
    model_.bufferViews.push_back(view);

    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = component_type<Number>();
    accessor.type = element_type(numbers.rows());
    accessor.count = static_cast<std::size_t>(numbers.cols());
    if (has_bounds) {
      for (const auto& row : numbers.rowwise()) {
        accessor.minValues.push_back(row.minCoeff());
        accessor.maxValues.push_back(row.maxCoeff());
      }
    }
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  template <class Number, class Matrix>
  int add_attribute(const Matrix& columns, bool has_bounds = false) {
    return add_accessor<Number>(columns, TINYGLTF_TARGET_ARRAY_BUFFER, has_bounds);
  }

  void add_mesh() {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    auto& attributes = primitive.attributes;
    attributes["POSITION"] = add_attribute<float>(scene_.positions, true);
    attributes["NORMAL"] = add_attribute<float>(scene_.normals);
    if (scene_.texture_coordinates.cols() > 0) {
      attributes["TEXCOORD_0"] = add_attribute<float>(scene_.texture_coordinates);
    }
    if (scene_.colors.cols() > 0) attributes["COLOR_0"] = add_attribute<float>(scene_.colors);
    if (scene_.sources.cols() > 0) attributes["_VERTEX"] = add_attribute<float>(scene_.sources);
    add_influences(attributes);
    primitive.indices = add_triangles();
    primitive.material = add_material();

    tinygltf::Mesh mesh;
    mesh.name = as_utf8(scene_.name);
    mesh.primitives.push_back(primitive);
    model_.meshes.push_back(mesh);
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = 0;
    node.skin = 0;
    model_.nodes.push_back(node);
  }

  void add_influences(std::map<std::string, int>& attributes) {
    const auto& weights = scene_.weights;
    for (Eigen::Index set = 0; set < weights.joints.rows() / 4; ++set) {
      const auto joints = weights.joints.middleRows(4 * set, 4);
      const auto numbers = weights.numbers.middleRows(4 * set, 4);
      const auto suffix = std::to_string(set);
      attributes["JOINTS_" + suffix] = scene_.joints.cols() <= 256
                                           ? add_attribute<std::uint8_t>(joints)
                                           : add_attribute<std::uint16_t>(joints);
      attributes["WEIGHTS_" + suffix] = add_numbers(numbers);
    }
  }

  template <class Matrix>
  int add_numbers(const Matrix& numbers) {
    if (scene_.weights.format == WeightFormat::kFloat) return add_attribute<float>(numbers);
    const int accessor = scene_.weights.format == WeightFormat::kUnsignedShort
                             ? add_attribute<std::uint16_t>(numbers)
                             : add_attribute<std::uint8_t>(numbers);
    model_.accessors[accessor].normalized = true;
    return accessor;
  }

  // The largest number of each type is kept from being an index.
  int add_triangles() {
    const auto indices = scene_.triangles.reshaped(1, scene_.triangles.size());
    constexpr int kTarget = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    const bool is_short = scene_.positions.cols() <= std::numeric_limits<std::uint16_t>::max();
    return is_short ? add_accessor<std::uint16_t>(indices, kTarget)
                    : add_accessor<std::uint32_t>(indices, kTarget);
  }

  // Without one, viewers show polished metal. Models may be open, and flat ones are.
  int add_material() {
    tinygltf::Material material;
    material.name = "model";
    material.doubleSided = true;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.8;
    model_.materials.push_back(material);
    return 0;
  }

  // Control points hang under one joint in the middle of the cage. Programs that draw joints as
  // bones make those without children as long as the shortest of their parent's: the helper's.
  void add_joints() {
    const auto num_points = scene_.joints.cols();
    const Eigen::Vector3f low = scene_.joints.rowwise().minCoeff();
    const Eigen::Vector3f size = scene_.joints.rowwise().maxCoeff() - low;
    centre_ = low + size / 2;
    tinygltf::Skin skin;
    skin.name = "cage";
    skin.skeleton = kCageNode;
    add_joint("cage", centre_, Eigen::Vector3f::Zero());
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

  // Appends a node. \param parent  where its parent is
  void add_joint(const std::string& name, const Eigen::Vector3f& place,
                 const Eigen::Vector3f& parent) {
    tinygltf::Node joint;
    joint.name = name;
    joint.translation = to_doubles(place);
    model_.nodes.push_back(joint);
    places_.push_back(parent + place);
  }

  // A matrix per joint, which undoes its place at rest.
  int add_inverse_binds(const std::vector<int>& joints) {
    Eigen::MatrixXf inverse_binds(16, joints.size());
    for (std::size_t k = 0; k < joints.size(); ++k) {
      Eigen::Matrix4f inverse_bind = Eigen::Matrix4f::Identity();
      inverse_bind.col(3).head<3>() = -places_[joints[k] - kCageNode];
      inverse_binds.col(static_cast<Eigen::Index>(k)) = inverse_bind.reshaped();
    }
    return add_accessor<float>(inverse_binds, 0);
  }

  static int joint_node(Eigen::Index joint) { return kFirstJoint + static_cast<int>(joint); }

  void add_animation() {
    if (scene_.channels.empty()) return;
    tinygltf::Animation animation;
    animation.name = "poses";
    const Eigen::Map<const Eigen::RowVectorXf> times(
        scene_.times.data(), static_cast<Eigen::Index>(scene_.times.size()));
    const int input = add_accessor<float>(times, 0, true);
    for (const Channel& moving : scene_.channels) {
      tinygltf::AnimationSampler sampler;
      sampler.input = input;
      sampler.output = add_accessor<float>(moving.translations.colwise() - centre_, 0);
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
