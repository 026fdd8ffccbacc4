// SPDX-License-Identifier: BSD-3-Clause
// Readers of the program alone: silhouettes.
#include <png.h>

#include <string>

#include "front/model_facets.h"
#include "fuzz/reader.h"

namespace flbc::fuzz {
namespace {

void read_silhouette(const std::string& path) {
  const auto model = app::load_silhouette(path);
  require(model.points.cols() > 0 && model.facets.cols() > 0, "there is an outline");
  std::vector<int> ends(static_cast<std::size_t>(model.points.cols()), 0);
  for (const auto& edge : model.facets.colwise()) {
    for (const Index vertex : edge) {
      require(vertex >= 0 && vertex < model.points.cols(), "vertices are in range");
      ++ends[static_cast<std::size_t>(vertex)];
    }
  }
  for (const int count : ends) require(count == 2 || count == 4, "outlines are closed");
}

std::string picture(int format, const std::string& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height = 2;
  image.format = static_cast<png_uint_32>(format);
  char bytes[1024];
  png_alloc_size_t size = sizeof bytes;
  png_image_write_to_memory(&image, bytes, &size, 0, pixels.data(), 0, nullptr);
  return {bytes, size};
}

}  // namespace

std::vector<Reader> program_readers() {
  const std::string with_hole{
      "aaa\xff"
      "bbb\0"
      "ccc\xff"
      "ddd\0",
      16};
  const std::string grey{
      "a\xff"
      "b\0"
      "c\x80"
      "d\x01",
      8};
  return {{"silhouette",
           "input.png",
           read_silhouette,
           {picture(PNG_FORMAT_RGBA, with_hole), picture(PNG_FORMAT_GA, grey)}}};
}

}  // namespace flbc::fuzz
