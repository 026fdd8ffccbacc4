// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Writes .glb files for tests, with no more than a JSON library and the specification of glTF 2.0.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Geometry>

namespace flbc::testing {

//! A document of which the tests write the JSON, except for accessors.
class NewGlb {
 public:
  using Json = nlohmann::ordered_json;

  explicit NewGlb(const char* text) : json(Json::parse(text)) {
    json["asset"] = {{"version", "2.0"}, {"copyright", "tests"}};
    json["buffers"] = Json::array({{{"byteLength", 0}}});
  }

  std::size_t add_view(const std::string& content) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}});
    bytes += content;
    return json["bufferViews"].size() - 1;
  }

  //! A column per element. \return the number of the accessor
  template <class Number, class Matrix>
  std::size_t add(const Matrix& columns) {
    const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> numbers =
        columns.template cast<Number>();
    const auto size = static_cast<std::size_t>(numbers.size()) * sizeof(Number);
    const char* const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    Json accessor{
        {"bufferView", add_view(std::string(reinterpret_cast<const char*>(numbers.data()), size))},
        {"componentType", std::is_same_v<Number, float>           ? 5126
                          : std::is_same_v<Number, std::uint16_t> ? 5123
                                                                  : 5121},
        {"count", numbers.cols()},
        {"type", numbers.rows() == 16 ? "MAT4" : types[numbers.rows()]}};
    if (numbers.rows() == 3) {
      for (Eigen::Index row = 0; row < 3; ++row) {
        accessor["min"].push_back(static_cast<double>(numbers.row(row).minCoeff()));
        accessor["max"].push_back(static_cast<double>(numbers.row(row).maxCoeff()));
      }
    }
    json["accessors"].push_back(std::move(accessor));
    return json["accessors"].size() - 1;
  }

  Json& primitive(std::size_t mesh, std::size_t number = 0) {
    return json["meshes"][mesh]["primitives"][number];
  }

  std::string glb() const {
    auto copy = json;
    auto binary = bytes;
    binary.resize((binary.size() + 3) / 4 * 4);
    copy["buffers"][0]["byteLength"] = bytes.size();
    auto text = copy.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t number) {
      const auto value = static_cast<std::uint32_t>(number);
      return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    };
    return "glTF" + word(2) + word(28 + text.size() + binary.size()) + word(text.size()) + "JSON" +
           text + word(binary.size()) + std::string("BIN\0", 4) + binary;
  }

  Json json;
  std::string bytes;
};

//! JSON and binary chunk of a .glb file.
struct GlbChunks {
  explicit GlbChunks(const std::string& file) {
    const auto size_at = [&](std::size_t place) {
      std::uint32_t size = 0;
      std::memcpy(&size, file.data() + place, sizeof size);
      return std::size_t{size};
    };
    json = NewGlb::Json::parse(file.substr(20, size_at(12)));
    binary = file.substr(28 + size_at(12), size_at(20 + size_at(12)));
  }
  std::string view(std::size_t number) const {
    const auto& view = json["bufferViews"][number];
    return binary.substr(view.value("byteOffset", std::size_t{0}), view["byteLength"]);
  }
  std::string accessor(std::size_t number) const {
    return view(json["accessors"][number]["bufferView"]);
  }
  //! Columns of floats.
  Eigen::MatrixXf floats(std::size_t number, Eigen::Index rows) const {
    const auto content = accessor(number);
    Eigen::MatrixXf columns(rows, static_cast<Eigen::Index>(content.size() / sizeof(float)) / rows);
    std::memcpy(columns.data(), content.data(), content.size());
    return columns;
  }

  //! Numbers of accessors and of buffer views to which nothing refers.
  std::array<std::set<std::size_t>, 2> unused() const {
    std::array<std::set<std::size_t>, 2> left;
    const char* const lists[] = {"accessors", "bufferViews"};
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t n = 0; n < json[lists[k]].size(); ++n) left[k].insert(n);
    }
    // Other numbers have other names, at least in the documents of tests.
    const std::set<std::string> to_accessors{
        "POSITION", "NORMAL",    "TANGENT",  "TEXCOORD_0",         "TEXCOORD_1",
        "COLOR_0",  "_VERTEX",   "JOINTS_0", "WEIGHTS_0",          "JOINTS_1",
        "input",    "WEIGHTS_1", "output",   "inverseBindMatrices"};
    const std::function<void(const NewGlb::Json&)> visit = [&](const NewGlb::Json& owner) {
      for (const auto& [name, value] : owner.items()) {
        if (value.is_structured()) {
          visit(value);
        } else if (name == "bufferView") {
          left[1].erase(value.get<std::size_t>());
        } else if (to_accessors.count(name) > 0 || (name == "indices" && value.is_number())) {
          left[0].erase(value.get<std::size_t>());
        }
      }
    };
    visit(json);
    return left;
  }

  NewGlb::Json json;
  std::string binary;
};

}  // namespace flbc::testing
