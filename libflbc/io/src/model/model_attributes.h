// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What the formats of models have in common.
#pragma once

#include <string>

#include "flbc/io/model_file.h"

namespace flbc::io {

//! Has texture coordinates and normals that are columns v belong to vertices v.
void refer_to_vertices(Model& model);

//! Adds a phrase to what else is in the file, once.
void add_other(Model& model, const std::string& phrase);

//! The nearest of the 256 levels of a colour, from 0 to 1.
int level_of(double intensity);

}  // namespace flbc::io
