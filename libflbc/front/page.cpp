// SPDX-License-Identifier: BSD-3-Clause
#include "front/page.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/sparsify.h"
#include "front/base64.h"
#include "front/colormap.h"
#include "front/instantiate.h"
#include "model/gltf_writer.h"
#include "model/srgb.h"

namespace flbc::view {

// The page without its content, joined from the files in page/ when the program is built: HTML with
// {{data}} where the content goes.
extern const char* const kPageTemplate;

namespace {

using Json = nlohmann::ordered_json;

template <class Number, class Values>
std::string pack(const Values& values) {
  std::vector<Number> numbers;
  numbers.reserve(static_cast<std::size_t>(values.size()));
  for (const auto value : values) numbers.push_back(static_cast<Number>(value));
  return draw::numbers_to_base64(numbers);
}

// Indices below `limit` in as few bytes as they need.
template <class Values>
Json pack_indices(const Values& values, Eigen::Index limit) {
  if (limit <= 1 << 8) return {{"bytes", 1}, {"data", pack<std::uint8_t>(values)}};
  if (limit <= 1 << 16) return {{"bytes", 2}, {"data", pack<std::uint16_t>(values)}};
  return {{"bytes", 4}, {"data", pack<std::uint32_t>(values)}};
}

template <int Dim>
void check(const PageContent<Dim>& content) {
  const auto n = content.cage.points.cols();
  if (n > std::numeric_limits<std::uint16_t>::max()) {
    throw InputError("the cage has " + std::to_string(n) +
                     " control points, but a page can show 65535 at most");
  }
}

// The influences of all points, one after the other.
Json pack_weights(const SparseWeights& weights) {
  std::vector<std::uint8_t> counts;
  for (Index p = 0; p < weights.num_points(); ++p) {
    counts.push_back(static_cast<std::uint8_t>(weights.count(p)));
  }
  return {{"counts", draw::numbers_to_base64(counts)},
          {"controlPoints", pack_indices(weights.control_points(), weights.num_control_points())},
          {"values", pack<float>(weights.values())}};
}

bool is_identity(const std::vector<Index>& sources, Eigen::Index num_points) {
  for (std::size_t v = 0; v < sources.size(); ++v) {
    if (sources[v] != static_cast<Index>(v)) return false;
  }
  return static_cast<Eigen::Index>(sources.size()) == num_points;
}

// For every vertex the first one of the same point with the same normal: where a file has several
// normals at a point there is a crease.
std::vector<Index> crease_groups(const gltf::Surface& surface) {
  std::vector<Index> groups(surface.sources.size());
  for (std::size_t v = 0; v < groups.size(); ++v) {
    groups[v] = static_cast<Index>(v);
    for (std::size_t u = v; u-- > 0 && surface.sources[u] == surface.sources[v];) {
      if (surface.normals.col(static_cast<Eigen::Index>(u)) ==
          surface.normals.col(static_cast<Eigen::Index>(v))) {
        groups[v] = groups[u];
        break;
      }
    }
  }
  return groups;
}

// \param numbers  of pictures, by their files \param pictures  gets their addresses
Json look_of(const io::Material& material, bool has_coordinates,
             std::map<std::string, Index>& numbers, Json& pictures) {
  std::vector<std::string> left_out;
  const auto [number, is_new] = numbers.emplace(has_coordinates ? material.texture : "", -1);
  const auto bytes =
      is_new && has_coordinates ? io::load_picture(material, left_out) : std::string();
  if (!bytes.empty()) {
    number->second = static_cast<Index>(pictures.size());
    pictures.push_back("data:" + io::media_type_of(bytes) + ";base64," + draw::to_base64(bytes));
  }
  const auto& linear = number->second >= 0 ? material.tint : material.color;
  const Eigen::Vector3d color = linear.unaryExpr(&io::to_srgb);
  return {{"color", std::vector<double>(color.begin(), color.end())},
          {"opacity", material.opacity},
          {"cutoff", material.alpha_cutoff},
          {"picture", number->second}};
}

Json pack_surface(const gltf::Surface& surface, Eigen::Index num_points) {
  const auto num_vertices = static_cast<Eigen::Index>(surface.sources.size());
  std::map<std::pair<double, Index>, std::vector<Index>> parts;  // transparent ones last
  for (Index t = 0; t < static_cast<Index>(surface.triangles.cols()); ++t) {
    const Index material = surface.triangle_materials.empty() ? -1 : surface.triangle_materials[t];
    parts[{material < 0 ? -1 : -surface.materials[material].opacity, material}].push_back(t);
  }
  Json json{{"parts", Json::array()}, {"pictures", Json::array()}};
  std::map<std::string, Index> numbers;
  std::vector<Index> order;
  const bool has_coordinates = surface.texture_coordinates.cols() > 0;
  for (const auto& [key, own] : parts) {
    const auto look = key.second < 0 ? Json::object()
                                     : look_of(surface.materials[key.second], has_coordinates,
                                               numbers, json["pictures"]);
    json["parts"].push_back({{"first", 3 * order.size()}, {"count", 3 * own.size()}});
    json["parts"].back().update(look);
    order.insert(order.end(), own.begin(), own.end());
  }
  json["triangles"] = pack_indices(surface.triangles(Eigen::all, order).reshaped(), num_vertices);
  if (!is_identity(surface.sources, num_points)) {
    json["sources"] = pack_indices(surface.sources, num_points);
    json["groups"] = pack_indices(crease_groups(surface), num_vertices);
  }
  if (surface.texture_coordinates.cols() > 0) {
    json["textureCoordinates"] = pack<float>(surface.texture_coordinates.reshaped());
  }
  if (surface.colors.cols() > 0) {
    const Eigen::MatrixXd bytes =
        surface.colors.unaryExpr([](double color) { return std::round(255 * io::to_srgb(color)); });
    json["colors"] = pack<std::uint8_t>(bytes.reshaped());
  }
  return json;
}

template <int Dim>
Json pack_cage(const ShownCage<Dim>& cage) {
  std::vector<Index> ends;
  for (const auto& edge : cage.edges) ends.insert(ends.end(), edge.begin(), edge.end());
  return {{"points", pack<double>(cage.points.reshaped())},
          {"facets", pack_indices(cage.facets.reshaped(), cage.points.cols())},
          {"edges", pack_indices(ends, cage.points.cols())},
          {"text", cage.text},
          {"isCurved", cage.is_curved}};
}

// The colours of weights from 0 to 1, as in the pictures.
std::string pack_palette() {
  constexpr int kColors = 256;
  std::vector<std::uint8_t> bytes;
  for (int k = 0; k < kColors; ++k) {
    const auto color = draw::weight_color(k / (kColors - 1.0));
    for (const float part : {color.r, color.g, color.b}) {
      bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * part)));
    }
  }
  return draw::numbers_to_base64(bytes);
}

template <int Dim>
Json pack_points(const PageContent<Dim>& content) {
  const auto& rest = content.cage.points;
  // Seen from the middle, single precision has digits enough wherever the model is.
  const Vector<Dim> center = (rest.rowwise().minCoeff() + rest.rowwise().maxCoeff()) / 2;
  const PointList<Dim> offsets = content.points.colwise() - center;
  return {{"center", std::vector<double>(center.begin(), center.end())},
          {"offsets", pack<float>(offsets.reshaped())}};
}

template <int Dim>
Json to_json(const PageContent<Dim>& content) {
  const auto& weights = content.weights;
  Json json{{"dim", Dim},
            {"title", content.title},
            {"up", content.up},
            {"front", content.front},
            {"files",
             {{"model", content.model_file},
              {"weights", content.weights_file},
              {"cage", content.cage_file}}},
            {"cage", pack_cage(content.cage)},
            {"points", pack_points(content)},
            {"weights", pack_weights(weights)},
            {"palette", pack_palette()},
            {"picture", content.picture}};
  json["surface"] = pack_surface(content.surface, content.points.cols());
  json["poses"] = Json::array();
  for (const auto& pose : content.poses) {
    json["poses"].push_back({{"name", pose.name},
                             {"time", pose.time},
                             {"points", pack<double>(pose.points.reshaped())}});
  }
  return json;
}

}  // namespace

template <int Dim>
SparseWeights limit_influences(const Binding<Dim>& binding, Index most) {
  if (most < Dim + 1 || most > kMostInfluences) {
    throw OptionError("-k " + std::to_string(most) + ": a page holds from " +
                      std::to_string(Dim + 1) + " to " + std::to_string(kMostInfluences) +
                      " influences per vertex");
  }
  if (!binding.solid.empty()) return binding.reduced({most}, {}, Reduction::kQuadratic).weights;
  const auto& weights = binding.weights;
  std::vector<Index> crowded, number;
  for (Index p = 0; p < weights.num_points(); ++p) {
    if (weights.count(p) > most) crowded.push_back(p);
  }
  if (crowded.empty()) return weights;
  const auto part =
      ModelPart<Dim>{binding.points, {}, weights, binding.masks}.taken(crowded, number);
  SparsifyOptions limits{most};
  limits.masks = part.masks;
  const auto few = sparsify<Dim>(binding.cage.points, part.points, part.weights, limits);
  return SparseWeights::of(weights.num_control_points(), weights.num_points(),
                           [&](Index p) -> Eigen::VectorXd {
                             return number[p] < 0 ? weights.at(p) : few.at(number[p]);
                           });
}

template <int Dim>
std::vector<std::array<Index, 2>> edges_of_cage(const std::vector<std::vector<Index>>& polygons,
                                                const FacetList<Dim>& facets) {
  std::set<std::array<Index, 2>> edges;
  const auto add = [&](Index a, Index b) {
    if (a != b) edges.insert({std::min(a, b), std::max(a, b)});
  };
  for (const auto& polygon : polygons) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      add(polygon[k], polygon[(k + 1) % polygon.size()]);
    }
  }
  if (edges.empty()) {
    for (const auto& facet : facets.colwise()) {
      for (int k = 0; k < Dim; ++k) add(facet[k], facet[(k + 1) % Dim]);
    }
  }
  return {edges.begin(), edges.end()};
}

template <int Dim>
std::string make_content(const PageContent<Dim>& content) {
  check(content);
  const auto text = to_json(content).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string result;  // may be large
  result.reserve(text.size());
  for (const char c : text) c == '<' ? result += "\\u003c" : result += c;
  return result;
}

template <int Dim>
std::string make_page(const PageContent<Dim>& content) {
  const auto data = make_content(content);
  const std::string_view page = kPageTemplate, place = "{{data}}";
  const auto begin = page.find(place);
  std::string result;
  result.reserve(page.size() + data.size());
  result += page.substr(0, begin);
  result += data;
  result += page.substr(begin + place.size());
  return result;
}

FLBC_INSTANTIATE_FUNCTION(edges_of_cage)
FLBC_INSTANTIATE_FUNCTION(limit_influences)
FLBC_INSTANTIATE_FUNCTION(make_content)
FLBC_INSTANTIATE_FUNCTION(make_page)

}  // namespace flbc::view
