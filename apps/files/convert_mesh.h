// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Meshes from one format to another.
#pragma once

#include <string>

#include "flbc/types.h"

namespace flbc::app {

//! The number of vertices of a model or a mesh of the interior. \throws IoError, InputError
Index count_vertices(const std::string& path);

//! Reads a model or a mesh of the interior and writes it in another format, as far as that has
//! places for what it holds; what it does not keep is told unless `quiet`.
//! \throws OptionError if the formats are for different kinds of meshes; IoError; InputError
void convert_mesh(const std::string& input, const std::string& output, bool quiet);

}  // namespace flbc::app
