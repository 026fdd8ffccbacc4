// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Files of masks: a JSON list of {"control_points": ..., "region": ...}. Both are a list of
//! numbers from 0, {"vertices": [...]}, or {"box": [lowest, highest]}; a region also {"group":
//! name} of a .obj model.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/masks.h"

namespace flbc::app {

//! Adds --locality. \param path  outlives the command
CLI::Option* add_locality_option(CLI::App& command, std::string& path);

//! The masks of a file, of the vertices of a model or mesh; none for an empty path.
//! \param points  Dim x P \param model  file of the points, for groups; may be empty
//! \throws IoError; InputError naming the file and the entry
template <int Dim>
std::vector<flbc::Mask> load_locality(const std::string& path, const Cage<Dim>& cage,
                                      const PointList<Dim>& points, const std::string& model);

//! The same without masks that end at facets, for weights that obey the others.
template <int Dim>
std::vector<flbc::Mask> load_locality_inside(const std::string& path, const Cage<Dim>& cage,
                                             const PointList<Dim>& points,
                                             const std::string& model);

}  // namespace flbc::app
