// SPDX-License-Identifier: BSD-3-Clause
#include "model/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "base/messages.h"
#include "flbc/io/files.h"
#include "flbc/version.h"
#include "model/gltf_json.h"
#include "model/model_scan.h"
#include "text/bytes.h"
#include "text/text_reader.h"

namespace flbc::io {
namespace {

using Chunk = std::pair<std::size_t, std::size_t>;  // begin and end in the file

constexpr std::size_t kGlbHeader = 12, kChunkHead = 8, kAlignment = 4;

std::size_t aligned(std::size_t size) {
  return (size + kAlignment - 1) / kAlignment * kAlignment;
}

void require_version(const std::string& path, double version) {
  if (std::floor(version) == 2) return;
  throw InputError(path + ": glTF of version " + format_number(std::floor(version)) +
                   " is not supported; export version 2");
}

// Of a .glb file: the JSON and, if there is one, the binary chunk.
std::array<Chunk, 2> chunks_of(const std::string& path, const std::string& bytes) {
  std::array<Chunk, 2> chunks{};
  if (bytes.size() >= kGlbHeader) require_version(path, number_at<std::uint32_t>(bytes.data() + 4));
  if (bytes.size() >= kGlbHeader) {
    const auto whole = number_at<std::uint32_t>(bytes.data() + 8);
    if (whole > bytes.size()) {
      throw InputError(path + ": the file is cut off: it has " + std::to_string(bytes.size()) +
                       " of " + std::to_string(whole) + " bytes; copy or export it again");
    }
  }
  std::size_t begin = kGlbHeader;
  for (auto& chunk : chunks) {
    if (bytes.size() < begin + kChunkHead) break;
    const auto size = number_at<std::uint32_t>(bytes.data() + begin);
    begin += kChunkHead;
    if (size > bytes.size() - begin) {
      throw InputError(path + ": the chunk at byte " + std::to_string(begin - kChunkHead) +
                       " is longer than the file; export the model again");
    }
    chunk = {begin, begin + size};
    begin += size;
  }
  return chunks;
}

std::string from_base64(std::string_view text) {
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (value < 0) continue;
    bits = bits << 6 | static_cast<unsigned>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

// "My%20Model.bin" is "My Model.bin".
std::string percent_decoded(const std::string& uri) {
  std::string text;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    const auto is_hex = [&](std::size_t j) {
      return j < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[j])) != 0;
    };
    if (uri[k] == '%' && is_hex(k + 1) && is_hex(k + 2)) {
      text += static_cast<char>(std::stoi(uri.substr(k + 1, 2), nullptr, 16));
      k += 2;
    } else {
      text += uri[k];
    }
  }
  return text;
}

// Bytes of a number by its type; 0 = unknown.
std::size_t component_size(std::size_t type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 0, 4, 4};  // 5120 .. 5126
  return type >= 5120 && type <= 5126 ? kSizes[type - 5120] : 0;
}

template <class Visit>
void visit_path(GltfJson& json, std::string_view path, const Visit& visit) {
  if (path.empty()) return visit(json);
  const auto end = std::min(path.find('/'), path.size());
  const std::string key(path.substr(0, end));
  const auto rest = path.substr(std::min(end + 1, path.size()));
  if (key == "*") {
    for (auto& entry : json) visit_path(entry, rest, visit);
  } else if (json.contains(key)) {
    visit_path(json[key], rest, visit);
  }
}

int rows_of(const std::string& type) {
  constexpr std::pair<const char*, int> kRows[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  for (const auto& [name, rows] : kRows) {
    if (type == name) return rows;
  }
  return 0;
}

}  // namespace

bool is_data(const std::string& uri) {
  return lower_case(std::string_view(uri).substr(0, 5)) == "data:";
}

std::string media_type_of(const std::string& picture) {
  constexpr std::pair<std::string_view, const char*> kSignatures[] = {
      {"\x89PNG\r\n\x1a\n", "image/png"},
      {"\xff\xd8\xff", "image/jpeg"},
      {"\xabKTX 20", "image/ktx2"}};
  for (const auto& [signature, type] : kSignatures) {
    if (picture.compare(0, signature.size(), signature) == 0) return type;
  }
  if (picture.size() < 12) return "";
  if (picture.compare(4, 8, "ftypavif") == 0) return "image/avif";
  return picture.compare(0, 4, "RIFF") == 0 && picture.compare(8, 4, "WEBP") == 0 ? "image/webp"
                                                                                  : "";
}

std::set<std::size_t> numbers_at(GltfJson& json, const GltfPaths& paths) {
  std::set<std::size_t> numbers;
  for (const auto path : paths) {
    visit_path(json, path, [&](const GltfJson& number) { numbers.insert(whole(number)); });
  }
  return numbers;
}

std::size_t drop_unused(GltfJson& json, const char* list, const GltfPaths& paths,
                        const std::set<std::size_t>& before) {
  if (!json.contains(list)) return 0;
  const auto used = numbers_at(json, paths);
  std::vector<std::size_t> number_of;
  auto kept = GltfJson::array();
  for (auto& entry : json[list]) {
    const auto k = number_of.size();
    number_of.push_back(kept.size());
    if (before.count(k) == 0 || used.count(k) > 0) kept.push_back(std::move(entry));
  }
  for (const auto path : paths) {
    visit_path(json, path, [&](GltfJson& number) { number = number_of.at(whole(number)); });
  }
  const auto num_dropped = number_of.size() - kept.size();
  json[list] = std::move(kept);
  if (json[list].empty()) json.erase(list);
  return num_dropped;
}

bool drop_extension(GltfJson& owner, const char* name) {
  if (!owner.contains("extensions")) return false;
  const bool had_it = owner["extensions"].erase(name) > 0;
  if (owner["extensions"].empty()) owner.erase("extensions");
  return had_it;
}

void drop_extension_name(GltfJson& json, const char* name) {
  if (!json.contains("extensionsUsed")) return;
  auto& used = json["extensionsUsed"];
  used.erase(std::remove(used.begin(), used.end(), name), used.end());
  if (used.empty()) json.erase("extensionsUsed");
}

GltfDocument::GltfDocument()
    : json{{"asset", {{"version", "2.0"}, {"generator", "flbc " FLBC_VERSION}}}} {
}

GltfDocument::GltfDocument(std::string path, const std::string& bytes) : path_(std::move(path)) {
  std::string binary;
  if (bytes.compare(0, 4, "glTF") == 0) {
    const auto [text, chunk] = chunks_of(path_, bytes);
    json = GltfJson::parse(bytes.begin() + static_cast<std::ptrdiff_t>(text.first),
                           bytes.begin() + static_cast<std::ptrdiff_t>(text.second));
    binary = bytes.substr(chunk.first, chunk.second - chunk.first);
  } else {
    json = GltfJson::parse(bytes);
  }
  if (!json.is_object()) fail("not a glTF file, or damaged; export the model again");
  const auto asset = json.value("asset", GltfJson::object());
  if (asset.contains("version")) {
    require_version(path_, std::atof(asset["version"].get<std::string>().c_str()));
  }
  const bool had_copies = drop_compressed_views();
  merge_buffers(std::move(binary));
  if (had_copies) pack();
}

bool GltfDocument::drop_compressed_views() {
  bool had_copies = false;
  const auto required = json.value("extensionsRequired", std::vector<std::string>());
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (std::count(required.begin(), required.end(), name) > 0) continue;
    for (const char* list : {"bufferViews", "buffers"}) {
      if (!json.contains(list)) continue;
      for (auto& entry : json[list]) had_copies |= drop_extension(entry, name);
    }
    drop_extension_name(json, name);
  }
  return had_copies;
}

void GltfDocument::merge_buffers(std::string binary_chunk) {
  if (!json.contains("buffers")) return;
  std::vector<std::size_t> begins;
  for (const auto& buffer : json["buffers"]) {
    const bool is_first = begins.empty();
    auto content = buffer.contains("uri") ? content_of(buffer.at("uri"))
                   : is_first             ? std::move(binary_chunk)
                                          : std::string();
    const auto length = whole(buffer, "byteLength", content.size());
    if (is_first && content.empty() && length > 0) {
      damaged("buffer 0 has no data; the binary chunk is missing");
    }
    content.resize(std::min(length, content.size()));  // without what fills up a chunk
    binary_.resize(aligned(binary_.size()));
    begins.push_back(binary_.size());
    is_first ? binary_ = std::move(content) : binary_ += content;
  }
  if (!json.contains("bufferViews")) return;
  for (auto& view : json["bufferViews"]) {
    const auto begin = begins.at(whole(view.at("buffer")));
    view["buffer"] = 0;
    if (begin > 0) view["byteOffset"] = whole(view, "byteOffset", 0) + begin;
  }
  while (json["buffers"].size() > 1) json["buffers"].erase(1);
  json["buffers"].at(0).erase("uri");
}

std::string GltfDocument::file_of(const std::string& uri) const {
  return path_next_to(path_, percent_decoded(uri));
}

std::string GltfDocument::content_of(const std::string& uri) const {
  if (is_data(uri)) {
    const auto comma = std::min(uri.find(','), uri.size());
    const auto content = percent_decoded(uri.substr(std::min(comma + 1, uri.size())));
    const auto head = lower_case(std::string_view(uri).substr(0, comma));
    const bool is_base64 = head.size() >= 7 && head.compare(head.size() - 7, 7, ";base64") == 0;
    return is_base64 ? from_base64(content) : content;
  }
  constexpr std::size_t kLongest = 1024;
  if (uri.size() > kLongest) damaged("the address " + in_quotes(uri) + " is no file");
  try {
    return read_file(file_of(uri));
  } catch (const IoError& error) {
    throw IoError(path_ + ": " + error.what());
  }
}

std::string_view GltfDocument::view(std::size_t number) const {
  const auto& view = json.at("bufferViews").at(number);
  const auto begin = whole(view, "byteOffset", 0), length = whole(view.at("byteLength"));
  if (begin > binary_.size() || length > binary_.size() - begin) {
    damaged("buffer view " + std::to_string(number) + " ends outside its buffer");
  }
  return std::string_view(binary_).substr(begin, length);
}

// \param description  with a buffer view and an offset in it \param element  bytes
GltfDocument::Place GltfDocument::place(const GltfJson& description, std::size_t element,
                                        std::size_t count, const std::string& owner) const {
  const auto number = whole(description.at("bufferView"));
  const auto bytes = view(number);
  const auto offset = whole(description, "byteOffset", 0);
  const auto given = whole(json["bufferViews"][number], "byteStride", 0);
  const auto stride = given == 0 ? element : given;
  const auto left = offset <= bytes.size() ? bytes.size() - offset : 0;
  if (offset > bytes.size() || (count > 0 && (stride < element || left < element ||
                                              (count - 1) > (left - element) / stride))) {
    damaged(owner + " ends outside its buffer view");
  }
  return {bytes.data() + offset, stride};
}

Eigen::MatrixXd GltfDocument::numbers(std::size_t accessor, int rows) const {
  const auto& description = json.at("accessors").at(accessor);
  const auto name = "accessor " + std::to_string(accessor);
  const auto count = whole(description.at("count"));
  const auto type = whole(description.at("componentType"));
  const auto size = component_size(type);
  const int all_rows = rows_of(description.at("type"));
  const bool is_signed = type % 2 == 0, is_float = type == kGltfFloat;
  if (size == 0 || all_rows < rows)
    damaged(name + " does not have numbers of the type that is needed");
  const bool is_scaled = description.value("normalized", false) && !is_float;
  const double unit =
      is_scaled ? std::ldexp(1.0, static_cast<int>(8 * size - (is_signed ? 1 : 0))) - 1 : 1;
  const auto element = size * static_cast<std::size_t>(all_rows);
  const auto read = [&](const char* data, auto column) {
    for (int row = 0; row < rows; ++row) {
      column[row] = decode_number(data + row * size, size, is_float, is_signed);
      if (is_scaled) column[row] = std::max(-1.0, column[row] / unit);
    }
  };
  Eigen::MatrixXd columns;
  if (description.contains("bufferView")) {
    const auto [data, stride] = place(description, element, count, name);
    columns.resize(rows, static_cast<Eigen::Index>(count));
    for (std::size_t k = 0; k < count; ++k) read(data + k * stride, columns.col(k));
  } else {
    constexpr std::size_t kMostZeros = 1 << 22;  // a damaged file may ask for any number
    if (count > kMostZeros) damaged(name + " has no data for its elements");
    columns.setZero(rows, static_cast<Eigen::Index>(count));
  }
  if (!description.contains("sparse")) return columns;
  const auto& sparse = description["sparse"];
  const auto changes = whole(sparse.at("count"));
  const auto& indices = sparse.at("indices");
  const auto index_size = component_size(whole(indices.at("componentType")));
  if (index_size == 0) damaged(name + " has sparse indices of an unknown type");
  const auto where = place(indices, index_size, changes, name);
  const auto values = place(sparse.at("values"), element, changes, name);
  for (std::size_t k = 0; k < changes; ++k) {
    const auto index =
        to_whole(decode_number(where.data + k * where.stride, index_size, false, false));
    if (index >= count) damaged(name + " has a sparse index that is out of range");
    read(values.data + k * values.stride, columns.col(static_cast<Eigen::Index>(index)));
  }
  return columns;
}

Eigen::Matrix<std::size_t, 3, Eigen::Dynamic> GltfDocument::triangles(
    const GltfJson& primitive, std::size_t num_vertices) const {
  const auto mode = whole(primitive, "mode", kGltfTriangles);
  Eigen::MatrixXd indices;
  if (primitive.contains("indices")) indices = numbers(whole(primitive["indices"]), 1);
  const auto count =
      primitive.contains("indices") ? static_cast<std::size_t>(indices.cols()) : num_vertices;
  const auto corner = [&](std::size_t k) {
    return indices.size() > 0 ? to_whole(indices(0, static_cast<Eigen::Index>(k))) : k;
  };
  const std::size_t step = mode == kGltfTriangles ? 3 : 1;
  Eigen::Matrix<std::size_t, 3, Eigen::Dynamic> result(3, count < 3 ? 0 : (count - 3) / step + 1);
  for (Eigen::Index t = 0; t < result.cols(); ++t) {
    const auto first = static_cast<std::size_t>(t) * step;
    const bool is_odd = mode == kGltfStrip && first % 2 == 1;
    const std::size_t a = is_odd ? first + 1 : mode == kGltfFan ? 0 : first;
    const std::size_t b = is_odd ? first : first + 1;
    // Not by <<, which an exception would leave unfinished.
    result.col(t) = Eigen::Matrix<std::size_t, 3, 1>(corner(a), corner(b), corner(first + 2));
  }
  return result;
}

std::vector<double> GltfDocument::morph_weights(const GltfJson& node) const {
  const auto& mesh = json.at("meshes").at(whole(node.at("mesh")));
  return (node.contains("weights") ? node : mesh).value("weights", std::vector<double>());
}

Eigen::MatrixXd GltfDocument::morphed(const GltfJson& node, const GltfJson& primitive,
                                      const char* attribute, int rows) const {
  const auto& attributes = primitive.at("attributes");
  if (!attributes.contains(attribute)) return {};
  auto columns = numbers(whole(attributes[attribute]), rows);
  if (!primitive.contains("targets")) return columns;
  const auto weights = morph_weights(node);
  const auto& targets = primitive["targets"];
  for (std::size_t t = 0; t < std::min(weights.size(), targets.size()); ++t) {
    if (weights[t] == 0 || !targets[t].contains(attribute)) continue;
    const auto target = numbers(whole(targets[t][attribute]), 3);
    if (target.cols() != columns.cols()) damaged("a morph target has another number of vertices");
    columns.topRows(3) += weights[t] * target;
  }
  return columns;
}

std::size_t GltfDocument::append(const char* list, GltfJson value) {
  json[list].push_back(std::move(value));
  return json[list].size() - 1;
}

std::size_t GltfDocument::add_view(std::string_view bytes, int target) {
  binary_.resize(aligned(binary_.size()));
  GltfJson view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  if (target != 0) view["target"] = target;
  binary_.append(bytes);
  if (json["buffers"].empty()) json["buffers"].push_back(GltfJson::object());
  return append("bufferViews", std::move(view));
}

void GltfDocument::replace(std::size_t accessor, const Eigen::MatrixXd& columns) {
  auto& description = json["accessors"].at(accessor);
  const auto count = static_cast<std::size_t>(columns.cols());
  const auto element = sizeof(float) * static_cast<std::size_t>(columns.rows());
  const auto [data, stride] = place(description, element, count, "an accessor");
  char* const begin = binary_.data() + (data - binary_.data());
  for (Eigen::Index k = 0; k < columns.size(); ++k) {
    const auto row = static_cast<std::size_t>(k % columns.rows());
    put_number(static_cast<float>(columns.reshaped()[k]),
               begin + static_cast<std::size_t>(k / columns.rows()) * stride + row * sizeof(float));
  }
  if (description.contains("min")) {
    set_bounds(description, columns.cast<float>().cast<double>());
  }
}

const char* GltfDocument::type_of(Eigen::Index rows) {
  constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return rows <= 4 ? kTypes[rows - 1] : "MAT4";
}

void GltfDocument::set_bounds(GltfJson& accessor, const Eigen::MatrixXd& columns) {
  accessor["min"] = accessor["max"] = GltfJson::array();
  for (Eigen::Index row = 0; row < columns.rows(); ++row) {
    accessor["min"].push_back(columns.row(row).minCoeff());
    accessor["max"].push_back(columns.row(row).maxCoeff());
  }
}

std::vector<std::string> GltfDocument::embed_pictures() {
  std::vector<std::string> missing;
  if (!json.contains("images")) return missing;
  for (auto& image : json["images"]) {
    const auto uri = image.value("uri", "data:");
    if (is_data(uri)) continue;
    try {
      const auto bytes = content_of(uri);
      const auto type = media_type_of(bytes);
      if (type.empty()) {
        missing.push_back("the picture " + file_of(uri) + ": glTF has .png and .jpg only");
        continue;
      }
      image.erase("uri");
      image["mimeType"] = type;
      image["bufferView"] = add_view(bytes);
    } catch (const IoError& error) {
      missing.push_back(std::string("a picture: ") + error.what());
    }
  }
  return missing;
}

void GltfDocument::pack() {
  std::vector<std::pair<std::size_t, std::size_t>> begins;  // of views, and their numbers
  auto& views = json.at("bufferViews");
  for (const auto& view : views) begins.emplace_back(whole(view, "byteOffset", 0), begins.size());
  std::sort(begins.begin(), begins.end());
  std::string packed;
  std::size_t end = 0;  // of what is copied
  for (const auto& [begin, number] : begins) {
    if (begin > end) {
      packed.resize(packed.size() + (begin - packed.size()) % kAlignment);
      end = begin;
    }
    const auto size = view(number).size();
    if (begin + size > end) {
      packed.append(binary_, end, begin + size - end);
      end = begin + size;
    }
    const auto place = packed.size() - (end - begin);
    if (place != begin) views[number]["byteOffset"] = place;
  }
  binary_ = std::move(packed);
}

std::string GltfDocument::glb() const {
  auto copy = json;
  if (!binary_.empty()) copy["buffers"].at(0)["byteLength"] = binary_.size();
  auto text = copy.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
  text.resize(aligned(text.size()), ' ');
  const auto binary_size = binary_.empty() ? 0 : kChunkHead + aligned(binary_.size());
  const auto size = kGlbHeader + kChunkHead + text.size() + binary_size;
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("the model is too large: a .glb file cannot be larger than 4 GB");
  }
  std::string bytes;
  bytes.reserve(size);
  const auto add_word = [&](std::size_t number) {
    char word[4];
    put_number(static_cast<std::uint32_t>(number), word);
    bytes.append(word, sizeof word);
  };
  bytes += "glTF";
  add_word(2);
  add_word(size);
  add_word(text.size());
  bytes += "JSON" + text;
  if (binary_size == 0) return bytes;
  add_word(aligned(binary_.size()));
  bytes.append("BIN\0", 4);
  bytes += binary_;
  bytes.resize(size);
  return bytes;
}

}  // namespace flbc::io
