// SPDX-License-Identifier: BSD-3-Clause
// Pictures as files.
#pragma once

#include <cstddef>
#include <string>

#include "model/bitmap.h"

namespace flbc::app {

//! A .png file of any kind, or a .jpg file as its viewers turn it.
//! \throws IoError; InputError if the file is damaged or too large; OptionError for a .jpg file where
//! the program was built without libjpeg
io::Bitmap read_picture(const std::string& path);

//! Writes a .png file with the depth of the picture. \throws IoError
void write_picture(const std::string& path, const io::Bitmap& picture);

//! Its size and place, for people.
std::string describe(const io::Bitmap& picture);

//! Prints how many visible pixels of a picture stay outside the cage, if there are any.
//! \param file  of the picture
void warn_staying(std::size_t staying, const std::string& file);

}  // namespace flbc::app
