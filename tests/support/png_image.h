// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Pictures as libpng reads them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "front/primitives.h"

namespace flbc::draw {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels{};

  Color at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

inline Image decode_png(const std::string& bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()), 0);
  header.format = PNG_FORMAT_RGB;
  std::vector<png_byte> channels(PNG_IMAGE_SIZE(header));
  EXPECT_NE(png_image_finish_read(&header, nullptr, channels.data(), 0, nullptr), 0);
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  for (std::size_t k = 0; k < channels.size(); k += 3) {
    const auto part = [&](std::size_t i) { return static_cast<float>(channels[k + i]) / 255; };
    image.pixels.push_back({part(0), part(1), part(2)});
  }
  return image;
}

//! Writes a black picture. \param alpha_of  opacity of the pixel (x, y), from 0 to 255, y downwards
//! \return its name
template <class Alpha>
std::string write_png(const std::string& name, int width, int height, const Alpha& alpha_of) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_GA;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(image), 0);
  for (int y = 0, k = 1; y < height; ++y) {
    for (int x = 0; x < width; ++x, k += 2) bytes[k] = static_cast<png_byte>(alpha_of(x, y));
  }
  EXPECT_NE(png_image_write_to_file(&image, name.c_str(), 0, bytes.data(), 0, nullptr), 0);
  return name;
}

}  // namespace flbc::draw
