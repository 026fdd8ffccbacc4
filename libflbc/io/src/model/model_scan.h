// SPDX-License-Identifier: BSD-3-Clause
// Reads content of model files and the locations of their numbers, with one source file per
// format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "flbc/io/model.h"
#include "text/text_reader.h"

namespace flbc::io {

//! How a number is written: as a word; as bytes, little-endian unless stated otherwise; or in a way
//! that cannot store a coordinate.
enum class NumberForm : std::uint8_t { kText, kFloat, kDouble, kBigFloat, kBigDouble, kInteger };

//! The bytes of a number in a file. Size 0: no number, but text can be inserted here.
struct NumberPlace {
  std::size_t begin = 0;
  std::uint32_t size = 0;
  NumberForm form = NumberForm::kText;
};

//! Meaning of three numbers in a row.
enum class TripleKind : std::uint8_t { kPoint, kNormal, kFaceNormal };

//! A number that changes when vertices move.
struct Site {
  NumberPlace place;
  TripleKind kind;
  std::uint8_t axis;  //!< which of the three
  Index index;        //!< of the vertex, normal or polygon
};

enum class Extent : std::uint8_t { kGeometry, kEverything };

struct ModelScan {
  std::string text{};           //!< the whole file
  Model model{};                //!< its content
  PointList<3> face_normals{};  //!< 3 x number of polygons, or empty
  std::vector<Site> sites{};    //!< in the order of the file; none for glTF, which has documents
  std::string fixed{};          //!< why the file cannot be rewritten; empty if it can
};

//! Three numbers in a row.
struct PlacedNumbers {
  std::array<NumberPlace, 3> places;
  Vector<3> values = Vector<3>::Zero();
};

//! Reads the next three numbers on this line. A missing number is 0, located right after the
//! previous one.
//! \param reader  of a file of `size` bytes
//! \param needed  an error if there are fewer
//! \param kind  points must be finite \param most  further numbers belong to something else
PlacedNumbers next_numbers(TextReader& reader, std::size_t size, int needed, TripleKind kind,
                           int most = 3);

void add_sites(ModelScan& scan, const std::array<NumberPlace, 3>& places, TripleKind kind,
               Index index);

//! Assigns column v of texture coordinates and normals to vertex v.
void refer_to_vertices(Model& model);

//! Adds a phrase to Model::others, once.
void add_other(Model& model, const std::string& phrase);

//! Attributes in columns. Non-finite values become 0 and are listed in Model::others; some scanners
//! write NaN as the normal of a vertex without polygons.
template <int Dim>
void keep_finite(Model& model, PointList<Dim>& attributes);

//! Whether all numbers are in [0, 1], where NaN is not.
bool are_colors(const PointList<3>& numbers);

//! Drops the colors unless all are in [0, 1], and adds this to Model::others.
void keep_colors_in_range(Model& model);

//! The nearest of 256 color levels in [0, 1].
int level_of(double intensity);

//! Attributes for formats with vertex attributes; no columns if a model has none.
struct VertexAttributes {
  explicit VertexAttributes(const Model& model);

  PointList<3> normals;
  PointList<2> texture;
  const PointList<3>& colors;
};

//! Read a file, whose text `scan` has; .ply and .stl support every extent.
//! \throws as ModelFile does
void read_obj(const std::string& path, Extent extent, ModelScan& scan);
void read_off(const std::string& path, Extent extent, ModelScan& scan);
void read_ply(const std::string& path, Extent extent, ModelScan& scan);
void read_stl(const std::string& path, Extent extent, ModelScan& scan);
void read_gltf(const std::string& path, Extent extent, ModelScan& scan);
void read_su2(const std::string& path, Extent extent, ModelScan& scan);
void read_svg(const std::string& path, Extent extent, ModelScan& scan);

//! Reads these materials from a .mtl file. \return false if it cannot be read
bool read_mtl(const std::string& path, std::vector<Material>& materials);

//! Path of a file that is named in another file, relative to its directory.
std::string path_next_to(const std::string& path, const std::string& name);

//! The remaining words on a line: a name that may contain blanks.
std::string rest_of_line(TextReader& reader);

//! Write a model.
void write_obj(std::ostream& out, const Model& model);
void write_off(std::ostream& out, const Model& model);
void write_ply(std::ostream& out, const Model& model);
void write_stl(std::ostream& out, const Model& model);
void write_glb(std::ostream& out, const Model& model);

}  // namespace flbc::io
