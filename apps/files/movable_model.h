// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A model or domain mesh file that can be written with its vertices elsewhere.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "files/mesh_file.h"

namespace flbc::app {

//! What becomes of the file.
struct MovedFile {
  std::string model;                //!< that is read
  std::string output;               //!< that is written, maybe with a place for a number
  bool shows_displacement = false;  //!< as colours, or as a field in .vtu and .mesh
};

//! \throws OptionError or IoError before any work is done if no such model can be read, or such a
//! result written, in any dimension
void require_formats(const MovedFile& file);

//! The same, now that the dimension is known.
template <int Dim>
void require_formats_of(const MovedFile& file);

//! The file with those that lie beside it in some formats: .node and .ele, .mesh and .sol.
std::vector<std::string> files_of_model(const std::string& path);

//! Models are rewritten in place if the result has the same format and no new colours: then nothing
//! is lost. All else is read and written anew.
template <int Dim>
class MovableModel {
 public:
  //! \throws IoError, InputError; the latter also if the vertices of an .stl file are not those
  //! that weights belong to (load_model())
  explicit MovableModel(const MovedFile& file);

  //! Dim x P.
  const PointList<Dim>& points() const { return points_; }

  //! Normals that cannot follow the vertices.
  Index num_loose_normals() const { return model_ ? model_->num_loose_normals() : 0; }

  //! What the results do not keep of the file, a phrase each.
  const std::vector<std::string>& losses() const { return losses_; }

  //! Writes it with other points (Dim x P). \param lengths  of the displacements (P) \param largest
  //! length of all, which is shown in the last colour; both of no interest unless they are shown
  void write(const std::string& path, const PointList<Dim>& points, const Eigen::VectorXd& lengths,
             double largest) const;

 private:
  void write_model(const std::string& path, const PointList<Dim>& points,
                   const Eigen::VectorXd& lengths, double largest) const;

  bool shows_displacement_;
  bool is_rewritten_ = false;
  PointList<Dim> points_;
  std::unique_ptr<io::ModelFile> model_;  // null: it is a mesh of the interior
  FieldMesh<Dim> mesh_;
  std::vector<std::string> losses_;
};

}  // namespace flbc::app
