// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A model or domain mesh file that can be written with its vertices elsewhere.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/polygon_text.h"

namespace flbc::app {

//! \throws OptionError or IoError before any work is done if no such model can be read, or such a
//! result written, in any dimension
void require_formats(const std::string& model, const std::string& output);

//! The same, now that the dimension is known.
template <int Dim>
void require_formats_of(const std::string& model, const std::string& output);

//! The file with those that lie beside it in some formats: .node and .ele, .mesh and .sol.
std::vector<std::string> files_of_model(const std::string& path);

//! OBJ and OFF are rewritten as text if the result has the same format; all else is a domain mesh.
template <int Dim>
class MovableModel {
 public:
  //! \throws IoError, InputError
  MovableModel(const std::string& path, const std::string& output);

  //! Dim x P.
  const PointList<Dim>& points() const { return points_; }

  //! Normals that cannot follow the vertices.
  Index num_loose_normals() const { return text_ ? text_->num_loose_normals() : 0; }

  //! Writes it with other points (Dim x P).
  void write(const std::string& path, const PointList<Dim>& points) const;

 private:
  PointList<Dim> points_;
  std::unique_ptr<io::PolygonText> text_;
  CellList<Dim> cells_;  // of a domain mesh
  std::vector<io::VertexField> fields_;
};

}  // namespace flbc::app
