// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Model files: reading them exactly, moving their vertices, writing them in other formats.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "flbc/io/model.h"

namespace flbc::io {

//! Reads what cages need of a model file: points, polygons and polylines, exactly as they stand.
//! Attributes are passed over, so that damage there is none here.
//! \param path  a file as ModelFile reads it; "-" is standard input, as .obj
//! \throws IoError; InputError naming file and line, byte or element; OptionError for another
//! extension
PolygonSoup read_polygons(const std::string& path);

//! A file in which the coordinates of the vertices can be exchanged.
class ModelFile {
 public:
  //! Reads .obj, .off (also COFF, NOFF, STOFF headers), .ply, .stl or .om (OpenMesh, up to version
  //! 2.2). Corners of .stl files that coincide are one vertex: numbered as they first occur.
  //! \throws IoError; InputError naming file and line, byte or element; OptionError for another
  //! extension
  explicit ModelFile(const std::string& path);
  ~ModelFile();
  ModelFile(ModelFile&&) noexcept;
  ModelFile& operator=(ModelFile&&) noexcept;

  //! The model in the file.
  const Model& model() const;

  //! The file as it was read, byte by byte.
  const std::string& text() const;

  //! Number of normals in the file that belong to no polygon with an area: they cannot follow the
  //! vertices and stay as they are.
  Index num_loose_normals() const;

  //! Writes the file with each vertex moved to its column of `points` (Dim x P) and all else byte
  //! by byte as it was: text with the digits it takes to read the same numbers back, binary numbers
  //! in the precision they have in the file. In 2D z and the normals stay. In 3D normals turn with
  //! the polygons they belong to: rigidly where these move rigidly, and so that one that is their
  //! area-weighted mean remains it. Normals that someone has chosen, or that point to the other
  //! side, do so still.
  //! \throws InputError if the number of points is another, one is not finite or too large for its
  //! precision, or the file has no room for it (integers; no z in 3D)
  template <int Dim>
  void write(std::ostream& out, const PointList<Dim>& points) const;

  //! The model with its vertices and normals moved likewise.
  template <int Dim>
  Model moved(const PointList<Dim>& points) const;

 private:
  struct Content;
  std::unique_ptr<const Content> content_;
};

//! The attributes of a model that a file of the format that `path` names would lose, a phrase each.
std::vector<std::string> losses(const Model& model, const std::string& path);

//! Writes by extension: .obj, .off, .ply or .stl, the last two as text or binary as the model is.
//! Coordinates have all digits, in .stl those of single precision. What losses() tells is left out.
//! \throws IoError; InputError if a number is not finite; OptionError for another extension
void write_model(const std::string& path, const Model& model);

}  // namespace flbc::io
