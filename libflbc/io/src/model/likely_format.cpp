// SPDX-License-Identifier: BSD-3-Clause
#include "model/likely_format.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

namespace flbc::io {
namespace {

bool begins_with(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

bool is_binary_stl(const std::string& content) {
  constexpr std::size_t kHeader = 84, kTriangle = 50;
  if (content.size() < kHeader) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, content.data() + kHeader - sizeof count, sizeof count);
  return count > 0 && content.size() == kHeader + kTriangle * std::size_t{count};
}

// The first line that is neither empty nor a comment.
std::string_view first_line(std::string_view text) {
  while (!text.empty()) {
    auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const auto begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos || line[begin] == '#') continue;
    return line.substr(begin);
  }
  return {};
}

bool is_off_header(std::string_view line) {
  const auto word = line.substr(0, line.find_first_of(" \t\r"));
  constexpr std::string_view kEnd = "OFF";
  return word.size() >= kEnd.size() && word.size() <= 6 &&
         word.substr(word.size() - kEnd.size()) == kEnd;
}

bool is_obj_line(std::string_view line) {
  for (const char* keyword : {"v ", "vn ", "vt ", "f ", "l ", "o ", "g ", "mtllib ", "usemtl "}) {
    if (begins_with(line, keyword)) return true;
  }
  return false;
}

}  // namespace

std::string likely_format(const std::string& content) {
  using Signature = std::pair<std::string_view, const char*>;
  constexpr Signature kSignatures[] = {{"glTF", "glb"},   {"Kaydara FBX", "fbx"}, {"; FBX", "fbx"},
                                       {"ply\n", "ply"},  {"ply\r\n", "ply"},     {"OM", "om"},
                                       {"\x89PNG", "png"}};
  const std::string_view text = content;
  for (const auto& [signature, format] : kSignatures) {
    if (begins_with(text, signature)) return format;
  }
  if (is_binary_stl(content)) return "stl";
  if (text.find('\0') != std::string_view::npos) return "binary";
  if (text.find("<VTKFile") != std::string_view::npos) return "vtu";
  const auto line = first_line(text);
  if (is_off_header(line)) return "off";
  if (begins_with(line, "solid")) return "stl";
  return is_obj_line(line) ? "obj" : "";
}

}  // namespace flbc::io
