// SPDX-License-Identifier: BSD-3-Clause
// Models and meshes of the interior: read once, shown, moved, written in every format.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/io/formats.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/splat_file.h"
#include "model/surface.h"
#include "model/svg_document.h"

namespace flbc::app {

constexpr std::initializer_list<io::Content> kMeshFiles = {
    io::Content::kModel, io::Content::kMesh2D, io::Content::kMesh3D};

//! A file and the file it becomes.
struct MovedFile {
  std::string model;                //!< that is read
  std::string output;               //!< that is written, maybe with a place for a number
  bool shows_displacement = false;  //!< as colours, or as a field in .vtu
  bool is_anew = false;             //!< even into the format it has
};

//! \throws OptionError if the file's name has no extension of a model or a mesh of the interior
void require_mesh_readable(const std::string& path);

//! \throws OptionError or IoError before any work is done if no such model can be read, or such a
//! result written, in any dimension
void require_formats(const MovedFile& file);

//! The same, now that the dimension is known.
template <int Dim>
void require_formats_of(const MovedFile& file);

//! Whether Gaussian splats become moved splats, which takes the Jacobians of the poses.
bool moves_splats(const MovedFile& file);

//! Whether a drawing becomes a moved drawing. It then moves by points of its curves.
bool moves_drawing(const MovedFile& file);

//! A model or a mesh of the interior. Models are rewritten in place if the result has the same
//! format and no new colours: then nothing is lost. All else is written anew.
template <int Dim>
class MovableModel {
 public:
  //! \throws IoError, InputError
  explicit MovableModel(MovedFile file);

  //! Dim x P.
  const PointList<Dim>& points() const;

  //! Content of a model's file; null for points and for meshes of the interior.
  const io::Model* model() const { return model_ ? &model_->model() : nullptr; }

  //! A mesh of the interior; empty for models.
  const DomainMesh<Dim>& mesh() const { return mesh_; }

  //! Along polygons, polylines and cells. \throws InputError naming the file
  EdgeList edges() const;

  //! Polygons with all their attributes, the triangles of a 2D mesh, the boundary of a 3D one.
  //! \throws InputError naming the file if there are none
  gltf::Surface surface() const;

  //! The drawing, or null if it is none that stays one.
  const io::SvgDocument* drawing() const { return drawing_ ? &*drawing_ : nullptr; }

  //! Normals that cannot follow the vertices.
  Index num_loose_normals() const { return model_ ? model_->num_loose_normals() : 0; }

  //! Prints to standard error which data of the file the results lack.
  void print_losses() const;

  //! Writes it with other points (Dim x P). \param lengths  of the displacements (P) \param largest
  //! length of all, which is shown in the last colour; both of no interest unless they are shown
  //! \param jacobians  9 x P, by which normals turn; empty: with their polygons.
  //! Splats need them
  //! \throws IoError, InputError
  void write(const std::string& path, const PointList<Dim>& points, const Eigen::VectorXd& lengths,
             double largest, const Eigen::MatrixXd& jacobians = {}) const;

 private:
  void read();
  void find_losses(io::Model model);

  MovedFile file_;
  PointList<Dim> points_;
  std::optional<io::ModelFile> model_;
  std::optional<io::SplatFile> splats_;
  std::optional<io::SvgDocument> drawing_;
  DomainMesh<Dim> mesh_;
  std::vector<std::string> losses_;  // a phrase each
};

//! Either dimension. Models that remain models are taken for 3D ones, which loses nothing.
using AnyModel = std::variant<MovableModel<2>, MovableModel<3>>;

//! Reads a file whose dimension may follow only from the result, with the checks of
//! require_formats_of().
//! \throws OptionError, IoError, InputError
AnyModel load_any_model(const MovedFile& file);

}  // namespace flbc::app
