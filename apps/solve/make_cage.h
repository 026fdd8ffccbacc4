// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Cages round models, as the program makes them.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "flbc/cage_from_model.h"
#include "flbc/repair_cage.h"
#include "front/model_facets.h"

namespace flbc::app {

//! --symmetric of the commands that make cages.
//! \param more  of the help
CLI::Option* add_symmetric_option(CLI::App& command, CageSymmetry& symmetry,
                                  const std::string& more = "");

//! "FILE: has N vertices, more than cages usually have", which a model has; empty for fewer.
std::string note_many_vertices(const std::string& file, std::size_t vertices);

//! Shows the progress of each stage, and says which vertices and limits the cage leaves out, and
//! whether points became several parts.
//! \param file  the model's, for messages \throws InputError; OptionError, also where the program
//! was built without CGAL
template <int Dim>
ModelCage<Dim> make_cage(const std::string& file, const ModelFacets<Dim>& model,
                         CagingOptions options, bool quiet);

//! As repair_cage(). \param file  the cage's, for messages
template <int Dim>
RepairedCage<Dim> repair_defects(const std::string& file, const Cage<Dim>& cage);

//! "96 control points, 188 triangles, mean distance 2.1% of its size, volume 1.8 times that of the
//! model, at most 10 edges at a control point, symmetric across x = 0"
template <int Dim>
std::string describe(const ModelCage<Dim>& made);

//! "volume 3.94 (before: 3.94), at most 0 from the old surface, 14 of 16 control points kept"
//! \param control_points  before
template <int Dim>
std::string describe(const RepairedCage<Dim>& repaired, Index control_points);

}  // namespace flbc::app
