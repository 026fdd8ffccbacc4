// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A reader of Universal Scene Description as text, strict about the little that skins need of it:
//! every word that is not expected, and every value that its type does not allow, is an error.
#pragma once

#include <cctype>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace flbc::testing {

//! A value or list of values.
struct UsdaValue {
  std::string type{};
  std::size_t count = 0;  //!< of the list, else 1
  std::vector<double> numbers{};
  std::vector<std::string> words{};
};

struct UsdaAttribute {
  UsdaValue value{};
  std::map<double, UsdaValue> samples{};  //!< by time, instead of a value
  std::map<std::string, UsdaValue> metadata{};
};

class UsdaFile {
 public:
  //! \throws std::runtime_error saying where something else was expected
  explicit UsdaFile(const std::string& text) : text_(text) {
    expect("#usda 1.0\n");
    metadata_ = read_metadata();
    while (peek() != '\0') read_prim("");
  }

  //! As "/model/surface.points". \throws std::out_of_range
  const UsdaAttribute& operator[](const std::string& path) const { return attributes_.at(path); }
  bool has(const std::string& path) const { return attributes_.count(path) > 0; }
  const std::string& type_of(const std::string& prim) const { return types_.at(prim); }
  const std::string& target(const std::string& path) const { return relations_.at(path); }
  const std::map<std::string, UsdaValue>& metadata() const { return metadata_; }

  //! The vertices of the skin where its bound skeleton puts them in the scene, as the schema
  //! UsdSkel says: 3 x S. \param time  in time codes, one of the animation's; none: at rest
  Eigen::MatrixXd skinned(const double* time = nullptr) const {
    const std::string surface = "/model/surface", cage = target(surface + ".skel:skeleton");
    const auto worlds = world_transforms(cage, time);
    const auto binds = matrices((*this)[cage + ".bindTransforms"].value);
    const auto& points = (*this)[surface + ".points"].value;
    const auto& joints = (*this)[surface + ".primvars:skel:jointIndices"];
    const auto& weights = (*this)[surface + ".primvars:skel:jointWeights"];
    const auto slots = static_cast<std::size_t>(joints.metadata.at("elementSize").numbers[0]);
    require(slots * points.count == joints.value.count, "jointIndices do not fit the points");
    require(slots * points.count == weights.value.count, "jointWeights do not fit the points");
    const auto place = matrices((*this)[surface + ".primvars:skel:geomBindTransform"].value)[0];
    Eigen::Matrix4d scene = Eigen::Matrix4d::Identity();
    const std::string transform = "/model.xformOp:transform";
    if (has(transform)) scene = matrices((*this)[transform].value)[0];
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(3, static_cast<Eigen::Index>(points.count));
    for (std::size_t k = 0; k < joints.value.count; ++k) {
      const auto v = k / slots;
      const auto joint = static_cast<std::size_t>(joints.value.numbers[k]);
      require(joint < worlds.size(), "an influence of no joint");
      const Eigen::RowVector4d point(points.numbers[3 * v], points.numbers[3 * v + 1],
                                     points.numbers[3 * v + 2], 1);
      const Eigen::RowVector4d moved =
          point * place * binds[joint].inverse() * worlds[joint] * scene;
      result.col(static_cast<Eigen::Index>(v)) +=
          weights.value.numbers[k] * moved.head<3>().transpose();
    }
    return result;
  }

 private:
  using Matrices = std::vector<Eigen::Matrix4d>;

  static Matrices matrices(const UsdaValue& value) {
    Matrices result(value.count);
    for (std::size_t k = 0; k < 16 * value.count; ++k) {
      result[k / 16](static_cast<int>(k % 16 / 4), static_cast<int>(k % 4)) = value.numbers[k];
    }
    return result;
  }

  // Names are paths; a parent comes before its children, and there is one root.
  Matrices world_transforms(const std::string& cage, const double* time) const {
    const auto& names = (*this)[cage + ".joints"].value.words;
    auto local = matrices((*this)[cage + ".restTransforms"].value);
    require(local.size() == names.size(), "restTransforms do not fit the joints");
    if (time != nullptr) {
      const auto poses = target(cage + ".skel:animationSource");
      require((*this)[poses + ".joints"].value.words == names, "the animation has other joints");
      const auto& moved = (*this)[poses + ".translations"].samples.at(*time);
      require(moved.count == names.size(), "translations do not fit the joints");
      for (std::size_t j = 0; j < names.size(); ++j) {
        for (int d = 0; d < 3; ++d) local[j](3, d) = moved.numbers[3 * j + d];
      }
      const auto& turns = (*this)[poses + ".rotations"].samples;
      for (std::size_t j = 0; !turns.empty() && j < names.size(); ++j) {
        const double* const turn = turns.at(*time).numbers.data() + 4 * j;
        const Eigen::Quaterniond rotation(turn[0], turn[1], turn[2], turn[3]);
        local[j].topLeftCorner<3, 3>() = rotation.toRotationMatrix().transpose();
      }
    }
    std::map<std::string, std::size_t> number;
    Matrices world = local;
    for (std::size_t j = 0; j < names.size(); ++j) {
      const auto slash = names[j].rfind('/');
      require((slash == std::string::npos) == (j == 0), "not one root that comes first");
      if (j > 0) world[j] = local[j] * world[number.at(names[j].substr(0, slash))];
      require(number.emplace(names[j], j).second, "a joint twice");
    }
    return world;
  }

  static void require(bool holds, const std::string& message) {
    if (!holds) throw std::runtime_error(message);
  }
  [[noreturn]] void fail(const std::string& expected) const {
    throw std::runtime_error("expected " + expected + " at '" + text_.substr(next_, 40) + "'");
  }

  char peek() {
    while (next_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[next_]))) ++next_;
    return next_ < text_.size() ? text_[next_] : '\0';
  }
  bool accept(const std::string& word) {
    peek();
    if (text_.compare(next_, word.size(), word) != 0) return false;
    next_ += word.size();
    return true;
  }
  void expect(const std::string& word) {
    if (!accept(word)) fail(word);
  }
  std::string name() {
    peek();
    const auto begin = next_;
    while (next_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[next_])) ||
                                    text_[next_] == '_' || text_[next_] == ':')) {
      ++next_;
    }
    if (next_ == begin) fail("a name");
    return text_.substr(begin, next_ - begin);
  }
  std::string quoted(char open, char close) {
    expect(std::string(1, open));
    const auto end = text_.find(close, next_);
    if (end == std::string::npos) fail("an end of the text");
    const auto word = text_.substr(next_, end - next_);
    next_ = end + 1;
    return word;
  }
  double number() {
    peek();
    const char* begin = text_.c_str() + next_;
    if (!std::isdigit(static_cast<unsigned char>(*begin)) && *begin != '-') fail("a number");
    char* end = nullptr;
    const double value = std::strtod(begin, &end);
    next_ += static_cast<std::size_t>(end - begin);
    return value;
  }

  // Numbers in nested brackets of these sizes.
  void read_tuple(const std::vector<int>& shape, std::size_t depth, UsdaValue& value) {
    if (depth == shape.size()) {
      value.numbers.push_back(number());
      return;
    }
    expect("(");
    for (int k = 0; k < shape[depth]; ++k) {
      if (k > 0) expect(",");
      read_tuple(shape, depth + 1, value);
    }
    expect(")");
  }

  void read_element(const std::string& type, UsdaValue& value) {
    static const std::map<std::string, std::vector<int>> shapes{
        {"bool", {}},     {"int", {}},         {"float", {}},    {"double", {}},
        {"float3", {3}},  {"half3", {3}},      {"point3f", {3}}, {"normal3f", {3}},
        {"color3f", {3}}, {"texCoord2f", {2}}, {"quatf", {4}},   {"matrix4d", {4, 4}}};
    ++value.count;
    if (type == "token" || type == "string") {
      value.words.push_back(quoted('"', '"'));
      return;
    }
    if (shapes.count(type) == 0) fail("a known type instead of " + type);
    read_tuple(shapes.at(type), 0, value);
    const double last = value.numbers.back();
    if (type == "int" && last != static_cast<int>(last)) fail("a whole number before");
    if (type == "bool" && last != 0 && last != 1) fail("0 or 1 before");
  }

  UsdaValue read_value(const std::string& type, bool is_list) {
    UsdaValue value{type};
    if (!is_list) {
      read_element(type, value);
      return value;
    }
    expect("[");
    while (!accept("]")) {
      if (value.count > 0) expect(",");
      read_element(type, value);
    }
    return value;
  }

  std::map<std::string, UsdaValue> read_metadata() {
    static const std::map<std::string, std::string> types{
        {"defaultPrim", "string"},   {"upAxis", "token"},       {"timeCodesPerSecond", "double"},
        {"startTimeCode", "double"}, {"endTimeCode", "double"}, {"elementSize", "int"},
        {"interpolation", "token"}};
    std::map<std::string, UsdaValue> result;
    if (!accept("(")) return result;
    while (!accept(")")) {
      const bool is_prepended = accept("prepend ");
      const auto key = name();
      if (is_prepended != (key == "apiSchemas")) fail("apiSchemas to be prepended");
      if (!is_prepended && types.count(key) == 0) fail("known metadata instead of " + key);
      expect("=");
      result[key] = is_prepended ? read_value("token", true) : read_value(types.at(key), false);
    }
    return result;
  }

  void read_prim(const std::string& parent) {
    expect("def ");
    const auto type = name();
    const auto path = parent + '/' + quoted('"', '"');
    if (!types_.emplace(path, type).second) fail("one prim named " + path);
    const auto metadata = read_metadata();
    expect("{");
    while (!accept("}")) {
      if (text_.compare(next_, 4, "def ") == 0) {
        read_prim(path);
      } else {
        read_property(path);
      }
    }
  }

  void read_property(const std::string& prim) {
    if (accept("rel ")) {
      const auto key = name();
      expect("=");
      relations_[prim + '.' + key] = quoted('<', '>');
      return;
    }
    accept("uniform ");
    const auto type = name();
    const bool is_list = accept("[]");
    const auto key = name();
    UsdaAttribute attribute;
    const bool has_samples = accept(".timeSamples");
    expect("=");
    if (has_samples) {
      expect("{");
      while (!accept("}")) {
        const double time = number();
        expect(":");
        if (!attribute.samples.emplace(time, read_value(type, is_list)).second) fail("other times");
        expect(",");
      }
    } else {
      attribute.value = read_value(type, is_list);
    }
    attribute.metadata = read_metadata();
    if (!attributes_.emplace(prim + '.' + key, attribute).second) fail("one attribute " + key);
  }

  const std::string text_;
  std::size_t next_ = 0;
  std::map<std::string, UsdaValue> metadata_;
  std::map<std::string, std::string> types_, relations_;
  std::map<std::string, UsdaAttribute> attributes_;
};

}  // namespace flbc::testing
