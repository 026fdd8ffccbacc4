// SPDX-License-Identifier: BSD-3-Clause
// Loading what the subcommands work on, with the file's name in every message.
#pragma once

#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/formats.h"

namespace flbc::app {

//! Calls `action`, and puts the file's name before what an InputError says about its content.
template <class Action>
auto naming(const std::string& path, const Action& action) {
  try {
    return action();
  } catch (const InputError& error) {
    throw InputError(path + ": " + error.what());
  }
}

//! A cage that has passed all checks, self-intersection included where CGAL was built in.
io::AnyCage load_cage(const std::string& path);

//! The same of a file that has been read. \param path  for messages
io::AnyCage checked_cage(const io::PolygonSoup& soup, const std::string& path);

//! Defects of a cage, at most `most`, self-intersections included where CGAL was built in.
template <int Dim>
std::vector<Defect> defects_of(const Cage<Dim>& cage, std::size_t most);

//! Has the messages of defects name faces of the file as well, where triangles were cut from
//! polygons with more corners: " (faces 3 and 7 of the file)", numbered from 0.
void name_faces(std::vector<Defect>& defects, const io::PolygonSoup& soup);

//! Whether a path names a mere list of points: .npy or .csv with a row of coordinates per point.
bool is_point_file(const std::string& path);

//! The points of such a file. \throws InputError unless there are rows of Dim numbers
template <int Dim>
PointList<Dim> load_points(const std::string& path);

//! The vertices of a model, or the points of a list. \throws InputError if there are none
template <int Dim>
PointList<Dim> load_model(const std::string& path);

//! \throws OptionError before any work is done if the file could not be written in the end: unknown
//! extension; IoError: missing or unwritable folder. Nothing is checked for an empty path.
void require_writable(const std::string& path, const char* extension);
void require_writable(const std::string& path, const std::vector<std::string>& extensions);
void require_writable(const std::string& path, std::initializer_list<io::Content> contents);

//! \throws IoError before any work is done if the file's folder is missing or must not be written in.
//! Nothing is checked for an empty path.
void require_writable_folder(const std::string& path);

//! Makes a folder for results unless it is there. \throws IoError
void make_folder(const std::string& path);

//! Checks --control-point. \throws OptionError unless it is in [0, count)
void require_control_point(Index control_point, Eigen::Index count);

//! Writes a result of text; signals wait meanwhile. \throws IoError
void write_text(const std::string& path, const std::string& text);

constexpr const char* kWeightFormats = ".npz (a binding), .mtx, .npy, .csv";

std::string describe_weight_file();

std::string mesh_formats();

//! \throws OptionError before any work is done if a result would replace a file that is read, or
//! another result. Empty paths and "-" are no files.
void require_distinct(const std::vector<std::string>& inputs,
                      const std::vector<std::string>& outputs);

}  // namespace flbc::app
