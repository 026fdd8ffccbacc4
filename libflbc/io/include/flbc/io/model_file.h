// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reads model files exactly, moves their vertices, and writes them in other formats.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "flbc/io/model.h"

namespace flbc::io {

//! Reads points, polygons, and polylines of a model file exactly, which is all a cage needs.
//! \param path  a file that ModelFile can read; "-" is standard input in .obj format
//! \throws IoError; InputError naming file and line, byte or element; OptionError for another
//! extension
PolygonSoup read_polygons(const std::string& path);

//! A model file whose vertex coordinates can be replaced.
class ModelFile {
 public:
  //! Reads .obj, .off (also COFF, NOFF, STOFF headers), .ply, .stl, .glb, .vrm, .gltf (2.0,
  //! uncompressed), or the outline of a drawing in .svg, by librsvg, which is loaded at run time.
  //! Coincident corners of .stl files and vertices of glTF are merged into one vertex; vertices are
  //! numbered by first occurrence.
  //! \throws IoError; InputError naming file and line, byte or element; OptionError for another
  //! extension
  explicit ModelFile(const std::string& path);
  ~ModelFile();
  ModelFile(ModelFile&&) noexcept;
  ModelFile& operator=(ModelFile&&) noexcept;

  //! The model in the file.
  const Model& model() const;

  //! The unmodified bytes of the file.
  const std::string& text() const;

  //! Number of normals that belong to no polygon with nonzero area. They cannot follow the vertices
  //! and stay unchanged.
  Index num_loose_normals() const;

  //! Writes the file with vertices moved to `points` (Dim x P); all other bytes are unchanged. Text
  //! coordinates have enough digits to read the same numbers back; binary coordinates keep the
  //! precision of the file. In 2D, z and normals are unchanged. In 3D, normals are multiplied by
  //! the inverse transpose of the local deformation, which the polygons around their vertices show:
  //! exactly if it is affine. An area-weighted mean normal remains one. Custom and inward normals
  //! stay custom and inward. In .glb files tangents and morph targets follow the same deformation.
  //! \param jacobians  if not empty, 9 x P Jacobians at the vertices (flbc/gradients.h): normals are
  //! then multiplied by the inverse transpose of the mean Jacobian of their vertices, and keep
  //! their lengths
  //! \throws InputError if the number of points differs, a coordinate is not finite or too large
  //! for its precision, or the file cannot store it (integers; no z in 3D)
  template <int Dim>
  void write(std::ostream& out, const PointList<Dim>& points,
             const Eigen::MatrixXd& jacobians = {}) const;

  //! The model with vertices and normals moved as in write().
  template <int Dim>
  Model moved(const PointList<Dim>& points, const Eigen::MatrixXd& jacobians = {}) const;

 private:
  struct Content;
  std::unique_ptr<const Content> content_;
};

//! Reads a custom attribute of vertices, such as a painted region, of a .ply, .glb, .vrm, or .gltf
//! file: a property of the element "vertex", or an attribute such as "_BELT". Where several
//! vertices of a glTF file are one vertex of the model, the largest number counts; vertices of
//! meshes without it have 0.
//! \return a number for each vertex, in the order of ModelFile
//! \throws IoError; InputError naming the file if there is no such attribute
Eigen::VectorXd vertex_attribute(const std::string& path, const std::string& name);

//! Lists the attributes of a model that the format of `path` would lose, one phrase each.
std::vector<std::string> losses(const Model& model, const std::string& path);

//! Writes .obj, .off, .ply, .stl, or .glb, by extension. .stl is binary, and .ply unless
//! Model::is_text. Coordinates have full double precision, in .stl and .glb single precision.
//! Attributes listed by losses() are not written.
//! \throws IoError; InputError if a number is not finite; OptionError for another extension
void write_model(const std::string& path, const Model& model);

}  // namespace flbc::io
