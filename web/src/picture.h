// SPDX-License-Identifier: BSD-3-Clause
// Pictures as models in 2D. The browser decodes them: their files hold the width and the height, 4
// bytes each, and a byte per pixel from the upper left corner, 0 where nothing is to be seen.
#pragma once

#include <string>

#include "files/model_facets.h"

namespace flbc::web {

bool is_picture(const std::string& file);

//! \throws InputError
app::Mask read_mask(const std::string& file);

//! Texture coordinates for a picture between two corners.
void spread_picture(io::Model& model, const Vector<2>& low, const Vector<2>& high);

//! Squares that cover what is to be seen, with texture coordinates.
io::Model grid_of_picture(const app::Mask& mask);

}  // namespace flbc::web
