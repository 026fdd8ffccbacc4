// SPDX-License-Identifier: BSD-3-Clause
// Materials of .obj files: "newmtl NAME", then Kd R G B, d OPACITY or Tr TRANSPARENCY, Ns 0..1000,
// Pr and Pm (roughness and metal, as Blender writes them), map_Kd [-OPTION NUMBER...]... PICTURE.
// Other keywords are ignored. Values that cannot be read keep their defaults, because materials are
// not essential.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "model/model_scan.h"
#include "text/float_chars.h"

namespace flbc::io {
namespace {

bool to_number(std::string_view word, double& value) {
  return from_chars(word.data(), word.data() + word.size(), value).ec == std::errc() &&
         std::isfinite(value);
}

bool next_number(TextReader& reader, double& value) {
  return reader.has_word() && to_number(reader.word(), value);
}

// In [0, 1]; unchanged if missing.
void read_share(TextReader& reader, double& share) {
  double value = 0;
  if (next_number(reader, value)) share = std::clamp(value, 0.0, 1.0);
}

void read_color(TextReader& reader, Vector<3>& color) {
  Vector<3> value;
  if (!next_number(reader, value[0])) return;
  if (!next_number(reader, value[1]) || !next_number(reader, value[2])) {
    value.setConstant(value[0]);
  }
  color = value.cwiseMax(0).cwiseMin(1);
}

// The name after the options; it may contain blanks.
std::string picture_name(TextReader& reader) {
  std::string name;
  bool is_option = false;
  while (reader.has_word()) {
    const std::string word(reader.word());
    double number = 0;
    if (name.empty() && word.size() > 1 && word[0] == '-' && !to_number(word, number)) {
      is_option = true;
      continue;
    }
    const bool is_value = is_option && (to_number(word, number) || word == "on" || word == "off");
    if (name.empty() && is_value) continue;
    name += (name.empty() ? "" : " ") + word;
  }
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

void read_property(TextReader& reader, std::string_view keyword, const std::string& path,
                   Material& material) {
  double value = 0;
  if (keyword == "Kd") {
    read_color(reader, material.color);
  } else if (keyword == "d") {
    read_share(reader, material.opacity);
  } else if (keyword == "Tr" && next_number(reader, value)) {
    material.opacity = 1 - std::clamp(value, 0.0, 1.0);
  } else if (keyword == "Ns" && next_number(reader, value)) {
    material.roughness = 1 - std::sqrt(std::clamp(value / 1000, 0.0, 1.0));
  } else if (keyword == "Pr") {
    read_share(reader, material.roughness);
  } else if (keyword == "Pm") {
    read_share(reader, material.metallic);
  } else if (keyword == "map_Kd") {
    const auto name = picture_name(reader);
    if (!name.empty()) material.texture = path_next_to(path, name);
  }
}

}  // namespace

std::string path_next_to(const std::string& path, const std::string& name) {
  return (std::filesystem::path(path).parent_path() / name).string();
}

std::string rest_of_line(TextReader& reader) {
  std::string rest;
  while (reader.has_word()) rest += (rest.empty() ? "" : " ") + std::string(reader.word());
  return rest;
}

bool read_mtl(const std::string& path, std::vector<Material>& materials) {
  std::string text;
  try {
    text = read_file(path);
  } catch (const IoError&) {
    return false;
  }
  TextReader reader(path, std::move(text), {'#', false});
  Material* current = nullptr;
  while (reader.next_line()) {
    const std::string keyword(reader.word());
    if (keyword == "newmtl") {
      const auto name = rest_of_line(reader);
      const auto found = std::find_if(materials.begin(), materials.end(),
                                      [&](const auto& known) { return known.name == name; });
      current = found == materials.end() ? nullptr : &*found;
    } else if (current != nullptr) {
      read_property(reader, keyword, path, *current);
    }
  }
  return true;
}

}  // namespace flbc::io
