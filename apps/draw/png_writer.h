// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Pictures as PNG files.
#pragma once

#include <string>

#include "draw/primitives.h"

namespace flbc::draw {

//! The bytes of a PNG file (8 bits per channel, sRGB), for the caller to write where it likes.
//! Components outside [0, 1] are clamped.
//! \throws IoError if libpng cannot encode the picture, for example because it is empty
std::string encode_png(const Image& image);

//! The same of a layer, with its transparency.
std::string encode_png(const FilledLayer& layer);

}  // namespace flbc::draw
