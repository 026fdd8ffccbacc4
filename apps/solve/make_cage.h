// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Cages round models, as the program makes them.
#pragma once

#include <string>

#include "files/model_facets.h"
#include "flbc/cage_from_model.h"
#include "flbc/repair_cage.h"

namespace flbc::app {

//! \param file  the model's, for messages \throws InputError; OptionError, also where the program
//! was built without CGAL
template <int Dim>
ModelCage<Dim> make_cage(const std::string& file, const ModelFacets<Dim>& model,
                         const CagingOptions& options);

//! As repair_cage(). \param file  the cage's, for messages
template <int Dim>
RepairedCage<Dim> repair_defects(const std::string& file, const Cage<Dim>& cage);

//! "96 control points, 188 triangles, mean distance 2.1 % of its size, symmetric across x = 0"
template <int Dim>
std::string describe(const ModelCage<Dim>& made);

}  // namespace flbc::app
