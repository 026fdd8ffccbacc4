// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reads .glb files for tests, with no more than a JSON parser and the specification of glTF 2.0.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace flbc::testing {

//! A skinned mesh of a .glb file.
class GlbFile {
 public:
  using Json = nlohmann::json;

  //! Expects what the specification demands of header, chunks, buffer views and accessors.
  //! \param node  whose skinned mesh is looked at; default: the first mesh and skin
  explicit GlbFile(const std::string& bytes, int node = -1) : bytes_(bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(4), 2);
    EXPECT_EQ(number(8), bytes.size());
    const std::size_t json_size = number(12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(json_size % 4, 0);
    json = Json::parse(bytes.substr(20, json_size));
    binary_begin_ = 20 + json_size + 8;
    const std::size_t binary_size = number(20 + json_size);
    EXPECT_EQ(bytes.substr(24 + json_size, 4), std::string("BIN\0", 4));
    EXPECT_EQ(binary_size % 4, 0);
    EXPECT_EQ(binary_begin_ + binary_size, bytes.size());
    EXPECT_EQ(json["asset"]["version"], "2.0");
    EXPECT_EQ(json["buffers"].size(), 1);
    const std::size_t buffer_size = json["buffers"][0]["byteLength"];
    EXPECT_LE(buffer_size, binary_size);
    EXPECT_LT(binary_size, buffer_size + 4);
    for (const auto& view : json["bufferViews"]) {
      const std::size_t begin = view.value("byteOffset", 0), size = view["byteLength"];
      EXPECT_EQ(begin % 4, 0);
      EXPECT_LE(begin + size, buffer_size);
    }
    for (std::size_t k = 0; k < json["accessors"].size(); ++k) expect_sound_accessor(k);
    if (node < 0) return;
    mesh_ = json["nodes"][static_cast<std::size_t>(node)]["mesh"];
    skin_ = json["nodes"][static_cast<std::size_t>(node)]["skin"];
  }

  //! A column per element; normalized integers are divided by their unit.
  Eigen::MatrixXd accessor(std::size_t k) const {
    const auto& accessor = json["accessors"][k];
    auto values = raw(k);
    if (accessor.value("normalized", false))
      values /= accessor["componentType"] == 5121 ? 255 : 65535;
    return values;
  }

  //! The numbers as they are stored.
  Eigen::MatrixXd raw(std::size_t k) const {
    const auto& accessor = json["accessors"][k];
    const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    EXPECT_FALSE(view.contains("byteStride"));
    const std::size_t begin = binary_begin_ + view.value("byteOffset", std::size_t{0}) +
                              accessor.value("byteOffset", std::size_t{0});
    Eigen::MatrixXd values(rows(accessor), accessor["count"].get<Eigen::Index>());
    const auto size = component_size(accessor);
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      values.reshaped()[i] =
          component(begin + static_cast<std::size_t>(i) * size, accessor["componentType"]);
    }
    return values;
  }

  const Json& primitive() const { return json["meshes"][mesh_]["primitives"][0]; }
  bool has(const std::string& attribute) const {
    return primitive()["attributes"].contains(attribute);
  }
  std::size_t number_of(const std::string& attribute) const {
    return primitive()["attributes"][attribute];
  }
  Eigen::MatrixXd attribute(const std::string& name) const { return accessor(number_of(name)); }

  //! 3 x T, vertices.
  Eigen::MatrixXd triangles() const {
    const Eigen::MatrixXd indices = raw(primitive()["indices"]);
    return indices.reshaped(3, indices.size() / 3);
  }

  //! Slots x S, from all sets.
  Eigen::MatrixXd influences(const std::string& name, bool is_raw = false) const {
    Eigen::MatrixXd all(0, attribute("POSITION").cols());
    for (int set = 0; has(name + std::to_string(set)); ++set) {
      const auto k = number_of(name + std::to_string(set));
      all.conservativeResize(all.rows() + 4, Eigen::NoChange);
      all.bottomRows(4) = is_raw ? raw(k) : accessor(k);
    }
    return all;
  }

  //! Which vertex of the model each one is.
  std::vector<Eigen::Index> sources() const {
    std::vector<Eigen::Index> result(static_cast<std::size_t>(attribute("POSITION").cols()));
    std::iota(result.begin(), result.end(), 0);
    if (!has("_VERTEX")) return result;
    const Eigen::MatrixXd numbers = attribute("_VERTEX");
    for (auto& source : result) source = static_cast<Eigen::Index>(numbers(0, source));
    return result;
  }

  //! The joint of which all others are children.
  const Json& root_joint() const {
    return json["nodes"][json["skins"][skin_]["skeleton"].get<std::size_t>()];
  }

  //! From the coordinates of the root joint to those of the scene.
  Eigen::Isometry3d root() const {
    const auto& translation = root_joint()["translation"];
    const auto turn = root_joint().value("rotation", Json{0, 0, 0, 1});
    Eigen::Isometry3d root(Eigen::Quaterniond(turn[3], turn[0], turn[1], turn[2]));
    for (int k = 0; k < 3; ++k) root.translation()(k) = translation[k];
    return root;
  }

  //! 3 x n, by the nodes of the control points, in the scene.
  Eigen::MatrixXd joints() const {
    const auto& nodes = json["skins"][skin_]["joints"];
    constexpr std::size_t kOthers = 2;
    Eigen::MatrixXd result(3, nodes.size() - kOthers);
    for (std::size_t i = 0; i + kOthers < nodes.size(); ++i) {
      const auto& translation = json["nodes"][nodes[i].get<std::size_t>()]["translation"];
      for (std::size_t axis = 0; axis < 3; ++axis) result(axis, i) = translation[axis];
    }
    return (root().linear() * result).colwise() + root().translation();
  }

  //! The same at a moment of the animation, linearly between its keys.
  Eigen::MatrixXd joints(double time) const {
    Eigen::MatrixXd result = joints();
    const auto& animation = json["animations"][0];
    for (const auto& channel : animation["channels"]) {
      if (channel["target"]["path"] == "rotation") continue;
      EXPECT_EQ(channel["target"]["path"], "translation");
      const auto& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      EXPECT_EQ(sampler["interpolation"], "LINEAR");
      const Eigen::MatrixXd times = accessor(sampler["input"]);
      const Eigen::MatrixXd values = accessor(sampler["output"]);
      EXPECT_EQ(times.cols(), values.cols());
      const auto& nodes = json["skins"][skin_]["joints"];
      const auto joint = std::find(nodes.begin(), nodes.end(), channel["target"]["node"]);
      EXPECT_NE(joint, nodes.end());
      result.col(joint - nodes.begin()) = root() * between(times, values, time);
    }
    return result;
  }

  //! The rotations of the same joints at key k.
  std::vector<Eigen::Quaterniond> turns(Eigen::Index k) const {
    const auto& nodes = json["skins"][skin_]["joints"];
    std::vector<Eigen::Quaterniond> result(nodes.size(), Eigen::Quaterniond::Identity());
    const auto& animation = json["animations"][0];
    for (const auto& channel : animation["channels"]) {
      if (channel["target"]["path"] != "rotation") continue;
      const auto& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
      const auto joint = std::find(nodes.begin(), nodes.end(), channel["target"]["node"]);
      EXPECT_NE(joint, nodes.end());
      result[static_cast<std::size_t>(joint - nodes.begin())].coeffs() =
          accessor(sampler["output"]).col(k);
    }
    return result;
  }

  //! 3 x S: sum of w_i M_i x, where M_i is the joint's matrix times its inverse bind matrix.
  Eigen::MatrixXd skinned(const Eigen::MatrixXd& joints,
                          const std::vector<Eigen::Quaterniond>& turns = {}) const {
    const Eigen::MatrixXd binds = accessor(json["skins"][skin_]["inverseBindMatrices"]);
    const Eigen::MatrixXd positions = attribute("POSITION");
    const Eigen::MatrixXd numbers = influences("JOINTS_"), weights = influences("WEIGHTS_");
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, positions.cols());
    for (Eigen::Index v = 0; v < positions.cols(); ++v) {
      for (Eigen::Index slot = 0; slot < numbers.rows(); ++slot) {
        const auto joint = static_cast<Eigen::Index>(numbers(slot, v));
        Eigen::Isometry3d global = root();
        global.translation() = joints.col(joint);
        if (!turns.empty()) global.rotate(turns[static_cast<std::size_t>(joint)]);
        const Eigen::Matrix4d matrix = global.matrix() * binds.col(joint).reshaped(4, 4);
        const Eigen::Vector4d moved = matrix * positions.col(v).homogeneous();
        result.col(v) += weights(slot, v) * moved.head<3>();
      }
    }
    return result;
  }

  Json json;

 private:
  static Eigen::Vector3d between(const Eigen::MatrixXd& times, const Eigen::MatrixXd& values,
                                 double time) {
    Eigen::Index next = 0;
    while (next < times.cols() && times(0, next) <= time) ++next;
    if (next == 0) return values.col(0);
    if (next == times.cols()) return values.col(next - 1);
    const double part = (time - times(0, next - 1)) / (times(0, next) - times(0, next - 1));
    return (1 - part) * values.col(next - 1) + part * values.col(next);
  }

  static Eigen::Index rows(const Json& accessor) {
    return std::map<std::string, int>{
        {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}
        .at(accessor["type"]);
  }
  static std::size_t component_size(const Json& accessor) {
    return std::map<int, std::size_t>{{5121, 1}, {5123, 2}, {5125, 4}, {5126, 4}}.at(
        accessor["componentType"]);
  }

  void expect_sound_accessor(std::size_t k) const {
    const auto& accessor = json["accessors"][k];
    const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const auto values = raw(k);
    EXPECT_GT(values.cols(), 0);
    EXPECT_LE(static_cast<std::size_t>(values.size()) * component_size(accessor),
              view["byteLength"].get<std::size_t>());
    EXPECT_TRUE(values.allFinite());
    for (Eigen::Index row = 0; accessor.contains("min") && row < values.rows(); ++row) {
      EXPECT_EQ(accessor["min"][row], values.row(row).minCoeff());
      EXPECT_EQ(accessor["max"][row], values.row(row).maxCoeff());
    }
  }

  template <class Number>
  Number read(std::size_t begin) const {
    Number value{};
    EXPECT_LE(begin + sizeof value, bytes_.size());
    std::memcpy(&value, bytes_.data() + begin, sizeof value);
    return value;
  }
  std::size_t number(std::size_t begin) const { return read<std::uint32_t>(begin); }
  double component(std::size_t begin, int type) const {
    switch (type) {
      case 5121:
        return read<std::uint8_t>(begin);
      case 5123:
        return read<std::uint16_t>(begin);
      case 5125:
        return read<std::uint32_t>(begin);
      default:
        return read<float>(begin);
    }
  }

  std::string bytes_;
  std::size_t binary_begin_ = 0, mesh_ = 0, skin_ = 0;
};

}  // namespace flbc::testing
