// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Pictures as PDF files.
#pragma once

#include <string>

#include "draw/primitives.h"

namespace flbc::draw {

//! The bytes of a PDF file of one page: lines, discs and text as such, filled areas as embedded
//! rasters. Text looks as in the PNG and can be selected. The same picture gives the same bytes.
//! \param image  of layers
//! \throws IoError if Cairo cannot write it
std::string encode_pdf(const Image& image);

}  // namespace flbc::draw
