// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Content of model files and the places of their numbers, a source file for each format.
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

//! How a number is written: as a word; as bytes, little-endian unless big is said; or in a way that
//! leaves no room for a coordinate.
enum class NumberForm : std::uint8_t { kText, kFloat, kDouble, kBigFloat, kBigDouble, kInteger };

//! The bytes of a number in a file. Size 0: there is none, but as text one could stand here.
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

//! How much of a file is read.
enum class Extent : std::uint8_t { kGeometry, kEverything };

//! A file, read.
struct ModelScan {
  std::string text{};           //!< the whole file
  Model model{};                //!< what it holds
  PointList<3> face_normals{};  //!< 3 x number of polygons, or empty
  std::vector<Site> sites{};    //!< in the order of the file
};

//! Three numbers in a row.
struct PlacedNumbers {
  std::array<NumberPlace, 3> places;
  Vector<3> values = Vector<3>::Zero();
};

//! Reads the next three numbers on this line. One that is missing is 0, and its place is right
//! after the one before.
//! \param reader  of a file of `size` bytes
//! \param needed  an error if there are fewer
PlacedNumbers next_numbers(TextReader& reader, std::size_t size, int needed);

//! Appends the sites of three numbers.
void add_sites(ModelScan& scan, const std::array<NumberPlace, 3>& places, TripleKind kind,
               Index index);

//! Has texture coordinates and normals that are columns v belong to vertices v.
void refer_to_vertices(Model& model);

//! Adds a phrase to what else is in the file, once.
void add_other(Model& model, const std::string& phrase);

//! Attributes in columns, without those that are not finite: some scanners write NaN as the normal
//! of a vertex without polygons. These become 0, which is told among what else is in the file.
template <int Dim>
void keep_finite(Model& model, PointList<Dim>& attributes);

//! Drops the colours unless all are between 0 and 1, and tells so among what else is in the file.
void keep_colors_in_range(Model& model);

//! The nearest of the 256 levels of a colour, from 0 to 1.
int level_of(double intensity);

//! Attributes for formats that have them at vertices, no columns where a model has none.
struct VertexAttributes {
  explicit VertexAttributes(const Model& model);

  PointList<3> normals;
  PointList<2> texture;
  const PointList<3>& colors;
};

//! Read a file, whose text `scan` has; .ply, .stl and .om are read to every extent.
//! \throws as ModelFile does
void read_obj(const std::string& path, Extent extent, ModelScan& scan);
void read_off(const std::string& path, Extent extent, ModelScan& scan);
void read_ply(const std::string& path, Extent extent, ModelScan& scan);
void read_stl(const std::string& path, Extent extent, ModelScan& scan);
void read_om(const std::string& path, Extent extent, ModelScan& scan);

//! Reads what a .mtl file says of these materials. \return false if it cannot be read
bool read_mtl(const std::string& path, std::vector<Material>& materials);

//! A file that is named in another one, relative to that one's folder.
std::string beside(const std::string& path, const std::string& name);

//! The words that are left on a line: a name that may have blanks.
std::string rest_of_line(TextReader& reader);

//! Write a model.
void write_obj(std::ostream& out, const Model& model);
void write_off(std::ostream& out, const Model& model);
void write_ply(std::ostream& out, const Model& model);
void write_stl(std::ostream& out, const Model& model);

}  // namespace flbc::io
