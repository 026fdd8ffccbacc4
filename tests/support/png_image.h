// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Pictures as libpng reads them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "draw/primitives.h"

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

}  // namespace flbc::draw
