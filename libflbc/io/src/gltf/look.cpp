// SPDX-License-Identifier: BSD-3-Clause
#include "gltf/look.h"

#include <map>

#include "flbc/errors.h"
#include "flbc/io/files.h"

namespace flbc::gltf {
namespace {

// The MIME type from the first bytes of the file; empty for a format that glTF does not support.
std::string media_type_of(const std::string& bytes) {
  if (bytes.compare(0, 8, "\x89PNG\r\n\x1a\n") == 0) return "image/png";
  if (bytes.compare(0, 3, "\xff\xd8\xff") == 0) return "image/jpeg";
  return "";
}

// \return the index of the image; -1 if it is left out
int add_picture(const io::Material& material, Look& look) {
  const auto& path = material.texture;
  auto bytes = material.picture;
  try {
    if (bytes.empty()) bytes = io::read_file(path);
  } catch (const IoError& error) {
    look.left_out.push_back(std::string("a picture: ") + error.what());
    return -1;
  }
  auto type = media_type_of(bytes);
  if (type.empty()) {
    look.left_out.push_back("the picture " + path + ": glTF has .png and .jpg only");
    return -1;
  }
  look.pictures.push_back({std::move(type), std::move(bytes)});
  return static_cast<int>(look.pictures.size()) - 1;
}

}  // namespace

Look look_of(const Surface& surface) {
  Look look;
  for (const auto& file : surface.missing_files) {
    look.left_out.push_back("materials: " + file + " cannot be read");
  }
  std::map<Index, Index> number_of;  // of a material that is used
  std::map<std::string, int> picture_of;
  for (const Index material : surface.triangle_materials) {
    const auto [entry, is_new] =
        number_of.emplace(material, static_cast<Index>(look.materials.size()));
    if (material < 0) entry->second = -1;
    look.triangle_materials.push_back(entry->second);
    if (!is_new || material < 0) continue;
    LookMaterial next{surface.materials[material]};
    const auto& texture = next.material.texture;
    if (!texture.empty() && surface.texture_coordinates.cols() > 0) {
      const auto known = picture_of.find(texture);
      next.picture = known != picture_of.end()
                         ? known->second
                         : picture_of[texture] = add_picture(next.material, look);
    }
    look.materials.push_back(std::move(next));
  }
  return look;
}

}  // namespace flbc::gltf
