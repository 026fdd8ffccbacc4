// SPDX-License-Identifier: BSD-3-Clause
// Finds points, polygons and attributes among the elements of a PLY file.
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "flbc/errors.h"
#include "model/ply_reader.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

// Attributes of a vertex or a face, in a row.
enum Slot { kPoint = 0, kNormal = 3, kColor = 6, kAlpha = 9, kTexture = 10, kNumSlots = 12 };
constexpr int kNoSlot = -1;

// For each property of an element the slot it fills.
class Slots {
 public:
  explicit Slots(const PlyElement& element)
      : element_(element), slots_(element.properties.size(), kNoSlot) {}

  // Gives the properties consecutive slots if all of them are there. \return whether they are
  bool assign(int first, std::initializer_list<const char*> names) {
    for (const char* name : names) {
      const int k = element_.find(name);
      if (k < 0 || element_.properties[k].count_type) return false;
    }
    for (const char* name : names) slots_[element_.find(name)] = first++;
    return true;
  }

  bool has(int slot) const { return std::find(slots_.begin(), slots_.end(), slot) != slots_.end(); }
  int operator[](std::size_t property) const { return slots_[property]; }

 private:
  const PlyElement& element_;
  std::vector<int> slots_;
};

// The largest value of a channel of colors: 1 for floating types.
double largest_intensity(const PlyType& type) {
  return type.kind == 'f' ? 1 : std::ldexp(1.0, 8 * static_cast<int>(type.bytes)) - 1;
}

class PlyScanner {
 public:
  PlyScanner(const std::string& path, ModelScan& scan)
      : path_(path), scan_(scan), model_(scan.model), reader_(path, scan.text) {}

  void run() {
    model_.is_text = reader_.is_text();
    for (const PlyElement& element : reader_.elements()) {
      reader_.check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else {
        read_others(element);
      }
    }
    check_polygons(model_.soup.polygons, "face ", 3);
    check_polygons(model_.soup.polylines, "edge ", 2);
    keep_finite<3>(model_, model_.attributes.normals);
    keep_finite<2>(model_, model_.attributes.texture_coordinates);
    keep_finite<3>(model_, scan_.face_normals);
    keep_colors_in_range(model_);
    refer_to_vertices(model_);
    std::stable_sort(scan_.sites.begin(), scan_.sites.end(), [](const Site& a, const Site& b) {
      return a.place.begin < b.place.begin;  // coordinates may be in any order
    });
    if (reader_.has_comments()) add_other(model_, "comments");
    if (!reader_.texture_file().empty()) {
      auto& material = model_.materials.emplace_back();
      material.name = "texture";
      material.texture = path_next_to(path_, reader_.texture_file());
      model_.polygon_materials.assign(model_.soup.polygons.size(), 0);
    }
  }

 private:
  // The numbers of an element and their locations.
  struct Row {
    double values[kNumSlots] = {};
    NumberPlace places[kNumSlots];
    std::vector<Index> polygon{};

    Vector<3> three(int first) const { return Eigen::Map<const Vector<3>>(values + first); }
  };

  void read_vertices(const PlyElement& element) {
    if (!model_.soup.points.empty()) reader_.fail("the vertices are declared twice");
    const auto slots = slots_of_vertex(element);
    name_others(element, slots, "vertices");
    allocate(slots, static_cast<Eigen::Index>(element.count));
    Row row;
    row.places[kPoint + 2].form = NumberForm::kInteger;  // without z it cannot be stored
    row.values[kAlpha] = 1;
    double least_alpha = 1;
    for (Index v = 0; v < element.count; ++v) {
      read_row(element, slots, row);
      store_vertex(v, row);
      least_alpha = std::min(least_alpha, row.values[kAlpha]);
    }
    if (least_alpha < 1) add_other(model_, "transparency");
  }

  Slots slots_of_vertex(const PlyElement& element) const {
    Slots slots(element);
    if (element.find("packed_position") >= 0) {
      reader_.fail(
          "compressed Gaussian splats (\"packed_position\") are not supported; export them "
          "uncompressed");
    }
    if (!slots.assign(kPoint, {"x", "y"})) reader_.fail("the vertices have no x and y");
    refuse_incomplete_splats(element);
    slots.assign(kPoint + 2, {"z"});
    slots.assign(kNormal, {"nx", "ny", "nz"});
    if (slots.assign(kColor, {"red", "green", "blue"})) slots.assign(kAlpha, {"alpha"});
    slots.assign(kTexture, {"s", "t"}) || slots.assign(kTexture, {"u", "v"}) ||
        slots.assign(kTexture, {"texture_u", "texture_v"});
    return slots;
  }

  // They would move as bare points, without turning.
  void refuse_incomplete_splats(const PlyElement& element) const {
    for (const char* some : {"f_dc_0", "rot_0", "scale_0"}) {
      if (element.find(some) < 0) continue;
      for (const char* name : kSplatProperties) {
        if (element.find(name) >= 0) continue;
        reader_.fail("the vertices have " + in_quotes(some) + " but no " + in_quotes(name) +
                     ": Gaussian splats need both");
      }
    }
  }

  void allocate(const Slots& slots, Eigen::Index num_points) {
    auto& attributes = model_.attributes;
    model_.soup.points.reserve(static_cast<std::size_t>(num_points));
    if (slots.has(kNormal)) attributes.normals.resize(3, num_points);
    if (slots.has(kColor)) attributes.colors.resize(3, num_points);
    if (slots.has(kTexture)) attributes.texture_coordinates.resize(2, num_points);
  }

  void store_vertex(Index v, const Row& row) {
    auto& attributes = model_.attributes;
    model_.soup.points.push_back(row.three(kPoint));
    if (!model_.soup.points.back().allFinite()) {
      reader_.fail("vertex " + std::to_string(v) + " is not finite");
    }
    add_sites(scan_, places_of(row, kPoint), TripleKind::kPoint, v);
    if (attributes.normals.cols() > 0) {
      attributes.normals.col(v) = row.three(kNormal);
      add_sites(scan_, places_of(row, kNormal), TripleKind::kNormal, v);
    }
    if (attributes.colors.cols() > 0) attributes.colors.col(v) = row.three(kColor);
    if (attributes.texture_coordinates.cols() > 0) {
      attributes.texture_coordinates.col(v) << row.values[kTexture], row.values[kTexture + 1];
    }
  }

  // Faces, with normals and vertices; other properties are skipped.
  void read_others(const PlyElement& element) {
    const bool are_faces = element.name == "face";
    if (are_faces && !model_.soup.polygons.empty()) reader_.fail("the faces are declared twice");
    Slots slots(element);
    const bool has_normals = are_faces && slots.assign(kNormal, {"nx", "ny", "nz"});
    if (has_normals) scan_.face_normals.resize(3, static_cast<Eigen::Index>(element.count));
    if (are_faces) {
      name_others(element, slots, "polygons");
    } else if (element.count > 0) {
      add_other(model_, "elements " + in_quotes(element.name));
    }
    Row row;
    for (Index f = 0; f < element.count; ++f) {
      read_row(element, slots, row);
      // A face of two vertices is an edge, which has no normal.
      const bool is_edge = row.polygon.size() == 2 && !has_normals;
      if (are_faces) {
        (is_edge ? model_.soup.polylines : model_.soup.polygons).push_back(row.polygon);
      }
      if (!has_normals) continue;
      scan_.face_normals.col(f) = row.three(kNormal);
      add_sites(scan_, places_of(row, kNormal), TripleKind::kFaceNormal, f);
    }
  }

  static std::array<NumberPlace, 3> places_of(const Row& row, int first) {
    return {row.places[first], row.places[first + 1], row.places[first + 2]};
  }

  static bool is_polygon(const PlyProperty& property) {
    return property.count_type &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
  }

  void read_row(const PlyElement& element, const Slots& slots, Row& row) {
    row.polygon.clear();
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (property.count_type) {
        read_list(property, row);
        continue;
      }
      auto [value, place] = reader_.number(*property.type);
      const int slot = slots[k];
      if (slot == kNoSlot) continue;
      if (slot >= kColor && slot <= kAlpha) value /= largest_intensity(*property.type);
      row.values[slot] = value;
      row.places[slot] = place;
    }
  }

  void read_list(const PlyProperty& property, Row& row) {
    const Index length = reader_.list_length(property);
    for (Index k = 0; k < length; ++k) {
      if (is_polygon(property)) {
        row.polygon.push_back(reader_.index(*property.type));
      } else {
        reader_.number(*property.type);
      }
    }
  }

  void name_others(const PlyElement& element, const Slots& slots, const char* things) {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      const bool is_face_normal = element.name == "face" && slots[k] >= kNormal;
      if (is_face_normal) add_other(model_, "normals of polygons");
      if (slots[k] != kNoSlot || is_polygon(property)) continue;
      add_other(model_, "property " + in_quotes(property.name) + " of " + things);
    }
  }

  void check_polygons(const std::vector<std::vector<Index>>& polygons, const char* kind,
                      std::size_t fewest) const {
    for (std::size_t f = 0; f < polygons.size(); ++f) {
      const auto& polygon = polygons[f];
      const auto name = [&] { return path_ + ": " + kind + std::to_string(f); };
      if (polygon.size() < fewest) {
        throw InputError(name() + " has fewer than " + std::to_string(fewest) + " vertices");
      }
      const Index largest = *std::max_element(polygon.begin(), polygon.end());
      if (static_cast<std::size_t>(largest) < model_.soup.points.size()) continue;
      throw InputError(name() + " names vertex " + std::to_string(largest) + ", but there are " +
                       std::to_string(model_.soup.points.size()) + " vertices");
    }
  }

  const std::string& path_;
  ModelScan& scan_;
  Model& model_;
  PlyReader reader_;
};

}  // namespace

void read_ply(const std::string& path, Extent, ModelScan& scan) {
  PlyScanner(path, scan).run();
}

}  // namespace flbc::io
