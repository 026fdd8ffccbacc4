// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The formats of pictures.
#pragma once

#include <string>

#include "draw/primitives.h"

namespace flbc::draw {

enum class PictureFormat { kPng, kSvg, kPdf };

//! For help and messages.
constexpr const char* kPictureExtensions = ".png, .svg, .pdf";

//! By the extension, in upper or lower case.
//! \throws OptionError naming the file and all extensions if it is none of them
PictureFormat picture_format(const std::string& path);

//! Whether pictures of this format are made of layers (WeightPictureOptions::layers).
bool has_layers(PictureFormat format);

//! The bytes of a file. The same picture gives the same bytes.
//! \param image  of layers if the format has them, else of pixels
//! \throws IoError if the picture is empty or cannot be encoded
std::string encode_picture(const Image& image, PictureFormat format);

}  // namespace flbc::draw
