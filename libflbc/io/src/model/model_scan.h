// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What model files hold and where their numbers stand, a source file for each format.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "flbc/io/model_file.h"

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

//! What three numbers are together.
enum class TripleKind : std::uint8_t { kPoint, kNormal, kFaceNormal };

//! A number that changes when vertices move.
struct Site {
  NumberPlace place;
  TripleKind kind;
  std::uint8_t axis;  //!< which of the three
  Index index;        //!< of the vertex, normal or polygon
};

//! A file, read.
struct ModelScan {
  std::string text{};           //!< the whole file
  Model model{};                //!< what it holds
  PointList<3> face_normals{};  //!< 3 x number of polygons, or empty
  std::vector<Site> sites{};    //!< in the order of the file
};

//! Appends the sites of three numbers.
inline void add_sites(ModelScan& scan, const std::array<NumberPlace, 3>& places, TripleKind kind,
                      Index index) {
  for (std::uint8_t d = 0; d < 3; ++d) scan.sites.push_back({places[d], kind, d, index});
}

//! Read a file. \throws as ModelFile does
ModelScan scan_obj(const std::string& path);
ModelScan scan_off(const std::string& path);
ModelScan scan_ply(const std::string& path);
ModelScan scan_stl(const std::string& path);
ModelScan scan_om(const std::string& path);

//! Write a model.
void write_obj(std::ostream& out, const Model& model);
void write_off(std::ostream& out, const Model& model);
void write_ply(std::ostream& out, const Model& model);
void write_stl(std::ostream& out, const Model& model);

}  // namespace flbc::io
