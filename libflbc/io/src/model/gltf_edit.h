// SPDX-License-Identifier: BSD-3-Clause
// Edits the document of a model. What is not edited keeps its bytes.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "flbc/io/model.h"
#include "model/gltf_document.h"

namespace flbc::io {

//! New places of the vertices of a part, in its file.
struct GltfMotion {
  Eigen::MatrixXd places{};              //!< 3 x V, with the default weights of morph targets
  Eigen::MatrixXd normals{};             //!< 3 x V of length 1, alike; no columns if there are none
  std::vector<Eigen::Matrix3d> turns{};  //!< of directions such as tangents
  std::vector<bool> moves{};             //!< whether a vertex changes
};

class GltfEdit {
 public:
  GltfEdit() = default;  //!< of an empty document
  //! Reads the file again. \throws InputError, IoError
  explicit GltfEdit(const GltfSource& source);

  GltfJson& node(std::size_t number) { return document.json["nodes"].at(number); }
  GltfJson& primitive(const GltfPart& part, std::size_t number);

  //! The vertices of the file and their normals, with default weights of morph targets.
  Eigen::MatrixXd places(const GltfPart& part);
  Eigen::MatrixXd normals(const GltfPart& part);

  //! Turns the triangles of a part over, which become indexed ones.
  void reverse(const GltfPart& part);

  //! Replaces positions, normals, tangents, and morph targets.
  void move(const GltfPart& part, const GltfMotion& motion);

  //! The .glb file, without numbers that only the edits have left unused.
  std::string glb();

  GltfDocument document;

 private:
  using Place = std::pair<std::size_t, std::size_t>;  // buffer view and offset
  struct User {
    std::size_t mesh, primitive;
    int target;  // of morph targets; -1 = none
    std::string name;
  };

  void part_meshes(const GltfSource& source);
  void drop_unused_compression();
  void find_users();
  GltfJson& attributes(const GltfPart& part, std::size_t primitive, int target);
  void set(const GltfPart& part, int target, const char* name, Eigen::MatrixXd columns);
  bool can_replace(const GltfPart& part, int target, const char* name, std::size_t accessor) const;

  std::map<Place, std::vector<User>> users_;  // of numbers
  std::set<std::size_t> accessors_, views_;   // that the file uses
};

//! The .glb file of a model that was read from such a file, with its vertices and normals moved.
std::string moved_gltf(const Model& model);

//! Pictures in other files that moved_gltf() cannot embed, one phrase each. \throws IoError
std::vector<std::string> missing_pictures(const GltfSource& source);

//! The .glb file of a model without skins: each mesh is where its node is, as it was bound.
//! \param left_out  gets pictures that cannot be read, one phrase each
//! \throws InputError if there are none; IoError
std::string unposed_gltf(const std::string& path, std::vector<std::string>& left_out);

//! Whether an attribute of vertices belongs to a skin.
bool is_about_influences(const std::string& attribute);

//! Removes the Draco copy of the attributes and indices of a primitive, which edits make outdated:
//! readers that decode it ignore what has changed.
void drop_compressed_copy(GltfJson& primitive);

}  // namespace flbc::io
