// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Pictures as SVG files.
#pragma once

#include <string>

#include "draw/primitives.h"

namespace flbc::draw {

//! The text of an SVG file: lines, discs and text as such, filled areas as embedded PNG. Text is
//! set in a font of the reader's machine, to the width it has in the PNG.
//! \param image  of layers
std::string encode_svg(const Image& image);

}  // namespace flbc::draw
