// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/glb_writer.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include <Eigen/Geometry>

#include "model/following_normals.h"
#include "model/gltf_edit.h"
#include "model/gltf_json.h"

namespace flbc::gltf {
namespace {

using Json = io::GltfJson;
using io::GltfPart;
using io::is_about_influences;

// Length of joints drawn as bones, relative to cage size.
constexpr float kBoneLength = 0.02F;

Json list_of(const Eigen::Vector3d& point) {
  return {point.x(), point.y(), point.z()};
}

// Adds skin, joints, and animation to a document.
class SkinBuilder {
 public:
  SkinBuilder(const GlbScene& scene, std::vector<std::string>& left_out)
      : scene_(scene),
        left_out_(left_out),
        edit_(scene.document ? io::GltfEdit(*scene.document) : io::GltfEdit()),
        document_(edit_.document) {
    if (scene.document) {
      const auto missing = document_.embed_pictures();
      left_out_.insert(left_out_.end(), missing.begin(), missing.end());
      drop_old_motion();
      move_to_roots();
      add_joints();
      for (const auto& part : scene.document->parts) skin(part);
      for (const auto& part : scene.document->posed_others) {
        if (is_posed(part.node)) pose(part);
      }
      skin_others();
    } else {
      document_.append("nodes", {{"name", scene.name}, {"mesh", 0}, {"skin", 0}});
      add_joints();
      add_new_mesh();
    }
    add_animations();
    add_scenes();
  }

  std::string glb() { return edit_.glb(); }

 private:
  std::size_t num_nodes() const { return document_.json["nodes"].size(); }

  Json& list(const char* name) { return document_.json[name]; }

  // ---------------------------------------- motion of a document

  // Joints and skins of the model before it got its cage, and the animations that move them.
  void drop_old_motion() {
    const io::GltfPaths to_skins{"nodes/*/skin"};
    const auto skins = io::numbers_at(document_.json, to_skins);
    std::set<std::size_t> moved;
    for (const auto& part : scene_.document->parts) {
      moved.insert(part.node);
      auto& node = edit_.node(part.node);
      if (!node.contains("skin")) continue;
      for (const auto joint : io::wholes(list("skins").at(io::whole(node["skin"])), "joints")) {
        moved.insert(joint);
      }
      node.erase("skin");
    }
    add_ancestors(moved);
    const bool has_skins = io::drop_unused(document_.json, "skins", to_skins, skins) > 0;
    const bool has_animations = drop_animations(moved);
    if (!has_skins && !has_animations) return;
    left_out_.push_back(std::string("its own ") + (has_skins ? "skins" : "") +
                        (has_skins && has_animations ? " and " : "") +
                        (has_animations ? "animations of nodes" : "") +
                        ", because the cage moves the model");
  }

  std::map<std::size_t, std::size_t> parents() {
    std::map<std::size_t, std::size_t> parent_of;
    for (std::size_t k = 0; k < num_nodes(); ++k) {
      for (const auto child : io::wholes(edit_.node(k), "children")) parent_of[child] = k;
    }
    return parent_of;
  }

  void add_ancestors(std::set<std::size_t>& nodes) {
    const auto parent_of = parents();
    for (const auto node : std::set<std::size_t>(nodes)) {
      auto parent = parent_of.find(node);
      while (parent != parent_of.end() && nodes.insert(parent->second).second) {
        parent = parent_of.find(parent->second);
      }
    }
  }

  bool drop_animations(const std::set<std::size_t>& moved) {
    if (!document_.json.contains("animations")) return false;
    const io::GltfPaths to_samplers{"channels/*/sampler"};
    bool has_dropped = false;
    auto animations = Json::array();
    for (auto& animation : list("animations")) {
      const auto samplers = io::numbers_at(animation, to_samplers);
      auto channels = Json::array();
      for (auto& channel : animation.at("channels")) {
        const auto& target = channel.at("target");
        const bool moves = target.contains("node") && target.at("path") != "weights" &&
                           moved.count(io::whole(target["node"])) > 0;
        if (!moves) channels.push_back(channel);
        has_dropped = has_dropped || moves;
      }
      animation["channels"] = std::move(channels);
      io::drop_unused(animation, "samplers", to_samplers, samplers);
      if (!animation["channels"].empty()) animations.push_back(animation);
    }
    document_.json.erase("animations");
    if (!animations.empty()) list("animations") = std::move(animations);
    return has_dropped;
  }

  // Viewers ignore where the node of a skinned mesh is, and validators warn of it.
  void move_to_roots() {
    const auto joints = io::numbers_at(document_.json, {"skins/*/joints/*", "skins/*/skeleton"});
    auto parent_of = parents();
    const auto& parts = scene_.document->parts;
    // Children first, because a node with children stays.
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
      auto& node = edit_.node(part->node);
      const bool has_use = joints.count(part->node) > 0 || node.contains("children") ||
                           node.contains("camera") || node.contains("extensions");
      if (has_use) continue;
      // Viewers take the front of triangles from the transform of their node.
      if (part->is_mirrored) edit_.reverse(*part);
      for (const char* name : {"matrix", "translation", "rotation", "scale"}) node.erase(name);
      if (parent_of.count(part->node) > 0) detach(part->node, parent_of);
    }
  }

  void detach(std::size_t number, std::map<std::size_t, std::size_t>& parent_of) {
    auto root = number;
    while (parent_of.count(root) > 0) root = parent_of.at(root);
    for (std::size_t k = 0; document_.json.contains("scenes") && k < list("scenes").size(); ++k) {
      const auto nodes = io::wholes(list("scenes")[k], "nodes");
      const auto place = std::find(nodes.begin(), nodes.end(), root);
      if (place == nodes.end()) continue;
      auto& order = list("scenes")[k]["nodes"];
      order.insert(order.begin() + (place - nodes.begin()) + 1, number);
    }
    auto& parent = edit_.node(parent_of.at(number));
    auto siblings = io::wholes(parent, "children");
    siblings.erase(std::find(siblings.begin(), siblings.end(), number));
    parent["children"] = siblings;
    if (siblings.empty()) parent.erase("children");
    parent_of.erase(number);
  }

  // ---------------------------------------- influences

  // What another skin has posed is written in its pose.
  bool is_posed(std::size_t node) const {
    const auto& parts = scene_.document->parts;
    return std::any_of(parts.begin(), parts.end(),
                       [&](const GltfPart& part) { return part.node == node && part.is_skinned; });
  }

  void skin(const GltfPart& part) {
    const bool has_pose = is_posed(part.node);
    if (has_pose) pose(part);
    const auto origin = Eigen::Affine3d(Eigen::Translation3d(scene_.origin));
    edit_.node(part.node)["skin"] = skin_from(has_pose ? origin : part.frame(0));
    const auto& weights = scene_.weights;
    auto influences = influences_of(
        {weights.joints(Eigen::all, part.points), weights.numbers(Eigen::all, part.points)});
    const auto count = static_cast<Eigen::Index>(part.points.size());
    const Eigen::RowVectorXf sources =
        Eigen::Map<const Eigen::Matrix<Index, 1, Eigen::Dynamic>>(part.points.data(), count)
            .cast<float>();
    influences["_VERTEX"] = document_.add_attribute(sources);
    for (const auto number : part.primitives) set_influences(part, number, influences);
    correct(list("meshes").at(io::whole(edit_.node(part.node).at("mesh"))), part.node,
            part.primitives, part.points, (has_pose ? origin : part.frame(0)).linear());
  }

  // Adds the corrections as morph targets. \param points  their columns \param frame  of the mesh
  template <class Points>
  void correct(Json& mesh, std::size_t node, const std::vector<std::size_t>& primitives,
               const Points& points, const Eigen::Matrix3d& frame) {
    if (scene_.corrections.empty()) return;
    auto targets = Json::array();
    for (const auto& correction : scene_.corrections) {
      const Eigen::MatrixXd columns = correction(Eigen::all, points).template cast<double>();
      const Eigen::MatrixXf shifts = (frame.inverse() * columns).cast<float>();
      targets.push_back({{"POSITION", document_.add_attribute(shifts, true)}});
    }
    for (const auto number : primitives) {
      auto& primitive = mesh["primitives"].at(number);
      if (primitive.contains("targets")) {
        document_.fail("the model has morph targets, which --correct cannot keep; leave one out");
      }
      primitive["targets"] = targets;
    }
    mesh["weights"] = std::vector<double>(targets.size(), 0);
    corrected_.insert(node);
  }

  void pose(const GltfPart& part) {
    io::GltfMotion motion{edit_.places(part), edit_.normals(part), {}, {}};
    for (Eigen::Index k = 0; k < motion.places.cols(); ++k) {
      const auto& frame = part.frame(static_cast<std::size_t>(k));
      motion.places.col(k) = frame * Vector<3>(motion.places.col(k)) - scene_.origin;
      motion.turns.emplace_back(frame.linear());
      if (motion.normals.cols() > 0) {
        motion.normals.col(k) =
            io::transformed_normal(frame.linear(), Vector<3>(motion.normals.col(k)))
                .stableNormalized();
      }
    }
    motion.moves.assign(part.points.size(), true);
    edit_.move(part, motion);
  }

  void set_influences(const GltfPart& part, std::size_t number, const Json& influences) {
    auto& primitive = edit_.primitive(part, number);
    io::drop_compressed_copy(primitive);
    auto& attributes = primitive["attributes"];
    auto kept = Json::object();
    for (const auto& [name, accessor] : attributes.items()) {
      if (!is_about_influences(name)) kept[name] = accessor;
    }
    kept.update(influences);
    attributes = std::move(kept);
  }

  // Points and lines of a skinned mesh belong to the root, which no pose moves.
  void skin_others() {
    std::map<std::size_t, std::set<std::size_t>> done;
    for (const auto& part : scene_.document->parts) {
      done[part.node].insert(part.primitives.begin(), part.primitives.end());
    }
    for (const auto& [node, primitives] : done) {
      const GltfPart part{node};
      const auto mesh = io::whole(edit_.node(node).at("mesh"));
      for (std::size_t p = 0; p < list("meshes").at(mesh).at("primitives").size(); ++p) {
        if (primitives.count(p) > 0) continue;
        if (!scene_.corrections.empty()) {
          document_.fail("a mesh has points or lines, which --correct cannot move; leave one out");
        }
        const auto position = io::whole(edit_.primitive(part, p).at("attributes").at("POSITION"));
        const auto count =
            document_.json.at("accessors").at(position).at("count").get<Eigen::Index>();
        JointWeights still;
        still.joints.setZero(4, count);
        still.numbers.setZero(4, count);
        still.joints.row(0).setConstant(static_cast<std::uint16_t>(scene_.num_joints()));
        still.numbers.row(0).setOnes();
        set_influences(part, p, influences_of(still));
      }
    }
  }

  Json influences_of(const JointWeights& weights) {
    auto attributes = Json::object();
    // The joint after the control points is the root.
    const bool is_small = scene_.num_joints() <= 256 && (weights.joints.array() < 256).all();
    for (Eigen::Index set = 0; set < weights.joints.rows() / 4; ++set) {
      const auto joints = weights.joints.middleRows(4 * set, 4);
      const auto suffix = std::to_string(set);
      attributes["JOINTS_" + suffix] =
          is_small ? document_.add_accessor<std::uint8_t>(joints, io::kVertexTarget)
                   : document_.add_accessor<std::uint16_t>(joints, io::kVertexTarget);
      attributes["WEIGHTS_" + suffix] =
          document_.add_attribute(weights.numbers.middleRows(4 * set, 4));
    }
    return attributes;
  }

  // ---------------------------------------------------------------------------------------- a mesh

  void add_new_mesh() {
    skin_from(Eigen::Affine3d(Eigen::Translation3d(scene_.origin)));
    auto mesh =
        io::add_mesh(document_, scene_.surface, scene_.positions, scene_.sources, left_out_);
    const auto influences = influences_of(scene_.weights);
    for (auto& primitive : mesh["primitives"]) primitive["attributes"].update(influences);
    std::vector<std::size_t> all(mesh["primitives"].size());
    std::iota(all.begin(), all.end(), 0);
    correct(mesh, 0, all, Eigen::all, Eigen::Matrix3d::Identity());
    mesh["name"] = scene_.name;
    document_.append("meshes", std::move(mesh));
  }

  // ---------------------------------------- joints

  // All control points are children of one joint at the center of the cage. Programs that draw
  // joints as bones give leaf joints the length of the shortest sibling, which is the helper joint.
  void add_joints() {
    cage_ = num_nodes();
    if (scene_.skeleton) return add_skeleton(*scene_.skeleton);
    const auto num_points = scene_.joints.cols();
    const Eigen::Vector3f low = scene_.joints.rowwise().minCoeff();
    const Eigen::Vector3f size = scene_.joints.rowwise().maxCoeff() - low;
    centre_ = low + size / 2;
    add_joint("cage", centre_, Eigen::Vector3f::Zero());
    edit_.node(cage_)["translation"] =
        list_of(scene_.turn * (scene_.origin + centre_.cast<double>()));
    if (!scene_.turn.isIdentity(0)) {
      const Eigen::Quaterniond turn(scene_.turn);
      edit_.node(cage_)["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
    }
    auto children = Json::array();
    for (Eigen::Index i = 0; i < num_points; ++i) {
      children.push_back(joint_node(i));
      add_joint(joint_name(scene_, i), scene_.joints.col(i) - centre_, centre_);
    }
    joints_ = children;
    const auto helper = joint_node(num_points);
    add_joint("cage_end", Eigen::Vector3f(kBoneLength * size.norm(), 0, 0), centre_);
    children.push_back(helper);
    edit_.node(cage_)["children"] = std::move(children);
    joints_.push_back(cage_);
    joints_.push_back(helper);
    std::rotate(binds_.begin(), binds_.begin() + 1, binds_.end() - 1);  // as the joints
  }

  void add_skeleton(const Skeleton& skeleton) {
    document_.append("nodes", {{"name", "skeleton"}});
    for (const auto& node : skeleton.nodes) document_.append("nodes", node);
    for (std::size_t k = 0; k < skeleton.nodes.size(); ++k) {
      edit_.node(joint_node(skeleton.parents[k]))["children"].push_back(joint_node(k));
    }
    for (const auto joint : skeleton.joints) joints_.push_back(joint_node(joint));
    joints_.push_back(cage_);
    binds_ = skeleton.binds;
    binds_.push_back(Eigen::Affine3d::Identity());
  }

  // Appends a node. \param parent  position of its parent
  void add_joint(const std::string& name, const Eigen::Vector3f& place,
                 const Eigen::Vector3f& parent) {
    document_.append("nodes", {{"name", name}, {"translation", list_of(place.cast<double>())}});
    const Eigen::Vector3f sum = parent + place;
    binds_.emplace_back(Eigen::Translation3d(-sum.cast<double>()));
  }

  std::size_t joint_node(Eigen::Index joint) const {
    return cage_ + 1 + static_cast<std::size_t>(joint);
  }

  // \param frame  from the coordinates of a mesh to those of the cage \return the number of a skin
  std::size_t skin_from(const Eigen::Affine3d& frame) {
    const std::vector<double> key(frame.data(), frame.data() + 16);
    const auto known = skins_.find(key);
    if (known != skins_.end()) return known->second;
    Eigen::MatrixXf inverse_binds(16, binds_.size());
    const auto from_origin = Eigen::Translation3d(-scene_.origin) * frame;
    for (std::size_t k = 0; k < binds_.size(); ++k) {
      inverse_binds.col(static_cast<Eigen::Index>(k)) =
          (binds_[k] * from_origin).matrix().cast<float>().reshaped();
    }
    const auto binds = document_.add_accessor<float>(inverse_binds);
    return skins_[key] = document_.append("skins", {{"name", "cage"},
                                                    {"inverseBindMatrices", binds},
                                                    {"skeleton", cage_},
                                                    {"joints", joints_}});
  }

  void add_animations() {
    if (scene_.skeleton) {
      for (const auto& clip : scene_.skeleton->clips) add_animation(clip);
    } else if (!scene_.channels.empty()) {
      Clip poses{"poses"};
      const Eigen::Map<const Eigen::RowVectorXf> times(
          scene_.times.data(), static_cast<Eigen::Index>(scene_.times.size()));
      for (const auto& moving : scene_.channels) {
        const Eigen::Matrix3Xf values = moving.translations.colwise() - centre_;
        const auto add = [&](const char* path, const Eigen::MatrixXf& keys) {
          poses.channels.push_back({static_cast<std::size_t>(moving.joint), path, false,
                                    times.cast<double>(), keys.cast<double>()});
        };
        add("translation", values);
        if (moving.rotations.cols() > 0) add("rotation", moving.rotations);
      }
      add_animation(poses);
    }
  }

  void add_animation(const Clip& clip) {
    auto samplers = Json::array(), channels = Json::array();
    Eigen::RowVectorXd known;
    std::size_t input = 0;
    const auto add = [&](std::size_t node, const std::string& path, bool is_step,
                         const Eigen::RowVectorXd& keys, const Eigen::MatrixXd& values) {
      if (keys.size() != known.size() || keys != known) {
        input = document_.add_accessor<float>(known = keys, 0, true);
      }
      channels.push_back(
          {{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
      samplers.push_back({{"input", input},
                          {"interpolation", is_step ? "STEP" : "LINEAR"},
                          {"output", document_.add_accessor<float>(values)}});
    };
    for (const auto& channel : clip.channels) {
      add(joint_node(channel.node), channel.path, channel.is_step, channel.keys, channel.values);
    }
    // At each key the weight of its correction is 1.
    const auto count = static_cast<Eigen::Index>(clip.keys.size());
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(scene_.corrections.size(), count);
    if (!corrected_.empty()) weights.middleRows(num_keys_, count).setIdentity();
    num_keys_ += count;
    for (const auto node : corrected_) {
      add(node, "weights", false, Eigen::RowVectorXd::Map(clip.keys.data(), count),
          weights.reshaped(1, weights.size()));
    }
    document_.append("animations",
                     {{"name", clip.name}, {"channels", channels}, {"samplers", samplers}});
  }

  // ---------------------------------------- scenes

  void add_scenes() {
    if (!scene_.document) {
      document_.json["scene"] = 0;
      document_.append("scenes", {{"name", "model"}, {"nodes", {0}}});
    }
    if (!document_.json.contains("scenes")) document_.append("scenes", {{"nodes", roots()}});
    // Joints must be in every scene that shows their skin.
    const auto shown = io::whole(document_.json, "scene", 0);
    std::set<std::size_t> skinned;
    if (scene_.document) {
      for (const auto& part : scene_.document->parts) skinned.insert(part.node);
    }
    add_ancestors(skinned);
    auto& scenes = list("scenes");
    for (std::size_t k = 0; k < scenes.size(); ++k) {
      const auto nodes = io::wholes(scenes[k], "nodes");
      const bool has_model = std::any_of(nodes.begin(), nodes.end(),
                                         [&](std::size_t node) { return skinned.count(node) > 0; });
      if (has_model || k == shown) scenes[k]["nodes"].push_back(cage_);
    }
  }

  Json roots() {
    const auto parent_of = parents();
    auto result = Json::array();
    for (std::size_t k = 0; k < cage_; ++k) {
      if (parent_of.count(k) == 0) result.push_back(k);
    }
    return result;
  }

  const GlbScene& scene_;
  std::vector<std::string>& left_out_;
  io::GltfEdit edit_;
  io::GltfDocument& document_;
  Eigen::Vector3f centre_;                              // of the cage
  std::size_t cage_ = 0;                                // node of the root joint
  Json joints_ = Json::array();                         // nodes of all joints
  std::vector<Eigen::Affine3d> binds_{};                // of these, from the origin
  std::set<std::size_t> corrected_{};                   // nodes with corrections
  Eigen::Index num_keys_ = 0;                           // of the animations so far
  std::map<std::vector<double>, std::size_t> skins_{};  // by the frame of their mesh
};

}  // namespace

std::string joint_name(const GlbScene& scene, Eigen::Index joint) {
  const auto num_points = scene.joints.cols() - scene.solid_regions;
  return joint < num_points ? "control_point_" + std::to_string(joint)
                            : "solid_" + std::to_string(joint - num_points);
}

std::string encode_glb(const GlbScene& scene, std::vector<std::string>& left_out) {
  const auto make = [&] { return SkinBuilder(scene, left_out).glb(); };
  return scene.document ? io::refusing_damage(scene.document->path, make) : make();
}

}  // namespace flbc::gltf
