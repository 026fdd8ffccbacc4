// SPDX-License-Identifier: BSD-3-Clause
// A glTF 2.0 document: read from .glb or .gltf, edited, and written as .glb. Content that is not
// edited keeps its bytes.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <Eigen/Geometry>

#include "flbc/errors.h"
#include "flbc/types.h"

namespace flbc::io {

using GltfJson = nlohmann::ordered_json;

constexpr std::size_t kGltfFloat = 5126;
constexpr std::size_t kGltfTriangles = 4, kGltfStrip = 5, kGltfFan = 6;
constexpr int kVertexTarget = 34962, kIndexTarget = 34963;  // uses of buffer views

//! The triangles of a node that share their vertices, or points or lines.
struct GltfPart {
  std::size_t node = 0;
  std::vector<std::size_t> primitives{};  //!< of the mesh of the node
  std::vector<Index> points{};            //!< vertex of the model or -1, by vertex of the file
  Index first = 0;                        //!< number of their first normal in the model
  //! From the file, morphed by default weights, to the model: one for all vertices or one for each.
  std::vector<Eigen::Affine3d> frames{};
  bool is_skinned = false;
  bool is_mirrored = false;  //!< by its node: triangles of the file have their front at the back

  const Eigen::Affine3d& frame(std::size_t vertex) const {
    return frames[frames.size() == 1 ? 0 : vertex];
  }
};

//! The file of a model and the triangles in it, for writing it with all its content.
struct GltfSource {
  std::string path{};
  std::vector<GltfPart> parts{};
  std::vector<GltfPart> posed_others{};  //!< points and lines in skinned meshes with triangles
};

//! Places of numbers in JSON, such as "nodes/*/mesh"; "*" stands for all entries.
using GltfPaths = std::vector<std::string_view>;

//! The numbers at paths. \throws std::out_of_range if one is not an index
std::set<std::size_t> numbers_at(GltfJson& json, const GltfPaths& paths);

//! Removes entries of a list to which no number at the paths refers any more, and renumbers.
//! \param before  entries to which a number referred; others stay \return how many are removed
std::size_t drop_unused(GltfJson& json, const char* list, const GltfPaths& paths,
                        const std::set<std::size_t>& before);

//! Removes the data of an extension from its owner. \return whether there were any
bool drop_extension(GltfJson& owner, const char* name);
//! Removes the name of an extension from "extensionsUsed".
void drop_extension_name(GltfJson& json, const char* name);

//! Whether an address holds its content.
bool is_data(const std::string& uri);

//! "image/png", "image/jpeg", "image/webp", "image/avif", or "image/ktx2"; empty for other bytes.
std::string media_type_of(const std::string& picture);

class GltfDocument {
 public:
  GltfDocument();
  //! All buffers become one, without optional compressed copies of buffer views, which edits would
  //! make outdated. \param path  for messages, and for files next to it
  //! \throws InputError, IoError
  GltfDocument(std::string path, const std::string& bytes);

  //! The part of the file that is read, for damaged().
  std::string part;
  [[noreturn]] void damaged(const std::string& message) const {
    fail("damaged glTF, " + part + message + "; export the model again");
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(path_ + (path_.empty() ? "" : ": ") + message);
  }

  //! A column per element of an accessor; sparse ones are filled in, normalized ones are in [-1,
  //! 1].
  //! \param rows  that are needed \throws InputError
  Eigen::MatrixXd numbers(std::size_t accessor, int rows) const;

  //! The triangles of a primitive in any mode of them, a column of vertices each.
  Eigen::Matrix<std::size_t, 3, Eigen::Dynamic> triangles(const GltfJson& primitive,
                                                          std::size_t num_vertices) const;

  std::string_view view(std::size_t number) const;

  //! The bytes at an address in the document: data, or a file next to it.
  std::string content_of(const std::string& uri) const;
  //! \return the path of a file with this address
  std::string file_of(const std::string& uri) const;

  //! An object that shows this node and, if it has default weights, the sum of its morph targets.
  //! \return columns of an attribute, empty if there is none
  Eigen::MatrixXd morphed(const GltfJson& node, const GltfJson& primitive, const char* attribute,
                          int rows) const;
  //! The default weights of the morph targets of a node.
  std::vector<double> morph_weights(const GltfJson& node) const;

  //! \return the number of the buffer view \throws InputError beyond 4 GB
  std::size_t add_view(std::string_view bytes, int target = 0);

  //! Appends one column per element. \return the number of the accessor
  template <class Number, class Matrix>
  std::size_t add_accessor(const Matrix& columns, int target = 0, bool has_bounds = false) {
    // The values must be contiguous. NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
    const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> numbers =
        columns.template cast<Number>();
    GltfJson accessor{
        {"bufferView", add_view({reinterpret_cast<const char*>(numbers.data()),
                                 static_cast<std::size_t>(numbers.size()) * sizeof(Number)},
                                target)},
        {"componentType", component_type<Number>()},
        {"count", numbers.cols()},
        {"type", type_of(numbers.rows())}};
    if (has_bounds) set_bounds(accessor, numbers.template cast<double>());
    return append("accessors", std::move(accessor));
  }

  template <class Matrix>
  std::size_t add_attribute(const Matrix& columns, bool has_bounds = false) {
    return add_accessor<float>(columns, kVertexTarget, has_bounds);
  }

  //! Vertex numbers; the largest value of each type is not a valid one.
  template <class Matrix>
  std::size_t add_indices(const Matrix& elements, Eigen::Index num_vertices) {
    const auto indices = elements.reshaped(1, elements.size());
    return num_vertices <= std::numeric_limits<std::uint16_t>::max()
               ? add_accessor<std::uint16_t>(indices, kIndexTarget)
               : add_accessor<std::uint32_t>(indices, kIndexTarget);
  }

  //! Replaces the numbers of an accessor of floats, where nothing else is.
  void replace(std::size_t accessor, const Eigen::MatrixXd& columns);

  //! Appends to a list of the document. \return the number in it
  std::size_t append(const char* list, GltfJson value);

  //! Puts pictures from other files into the document. \return those that cannot be read, one
  //! phrase each
  std::vector<std::string> embed_pictures();

  //! Removes bytes that belong to no buffer view.
  void pack();

  //! The content of a .glb file. \throws InputError beyond 4 GB
  std::string glb() const;

  GltfJson json;

 private:
  struct Place {
    const char* data;
    std::size_t stride;
  };

  template <class Number>
  static constexpr std::size_t component_type() {
    if constexpr (std::is_same_v<Number, std::uint8_t>) return 5121;
    if constexpr (std::is_same_v<Number, std::uint16_t>) return 5123;
    if constexpr (std::is_same_v<Number, std::uint32_t>) return 5125;
    if constexpr (std::is_same_v<Number, float>) return kGltfFloat;
  }
  static const char* type_of(Eigen::Index rows);
  static void set_bounds(GltfJson& accessor, const Eigen::MatrixXd& columns);
  bool drop_compressed_views();
  void merge_buffers(std::string binary_chunk);
  Place place(const GltfJson& description, std::size_t element, std::size_t count,
              const std::string& owner) const;

  std::string path_;
  std::string binary_;
};

//! Runs an action on a document. \throws InputError if its JSON is not what it should be
template <class Action>
auto refusing_damage(const std::string& path, const Action& action) {
  try {
    return action();
  } catch (const GltfJson::out_of_range& error) {
    const std::string_view reason = error.what();
    throw InputError(path + ": not a glTF file, or damaged:" +
                     std::string(reason.substr(reason.find(']') + 1)) + "; export the model again");
  } catch (const GltfJson::exception&) {
    throw InputError(path + ": not a glTF file, or damaged; export the model again");
  } catch (const std::out_of_range&) {
    throw InputError(path + ": not a glTF file, or damaged; export the model again");
  }
}

}  // namespace flbc::io
