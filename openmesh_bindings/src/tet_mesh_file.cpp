// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/tet_mesh_file.h"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyCreator.hh>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <sstream>
#include <string_view>

#include "flbc/content_hash.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/openmesh/silenced.h"

namespace flbc::openmesh {
namespace {

// A file is this, the numbers of vertices, cells and properties, points, cells, the properties,
// each with its kind of element, name and type before its numbers, and a hash of all of it.
constexpr char kTetMeshMagic[] = "flbctet1";
constexpr std::size_t kMagicSize = sizeof kTetMeshMagic - 1;
constexpr std::uint32_t kByteOrder = 0x01020304;

enum class Kind : std::uint32_t { kVertex, kEdge, kFace, kCell, kMesh };

// Calls `use` with the kind, the container and the number of every kind of element.
template <class Mesh, class Use>
void for_each_container(Mesh& mesh, const Use& use) {
  use(Kind::kVertex, mesh.template properties<TetMesh::VertexHandle>(), mesh.n_vertices());
  use(Kind::kEdge, mesh.template properties<TetMesh::EdgeHandle>(), mesh.n_edges());
  use(Kind::kFace, mesh.template properties<TetMesh::FaceHandle>(), mesh.n_faces());
  use(Kind::kCell, mesh.template properties<CellHandle>(), mesh.n_cells());
  use(Kind::kMesh, mesh.template properties<OpenMesh::MeshHandle>(), std::size_t{1});
}

template <class Number>
void put(std::string& out, const Number& number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}
void put(std::string& out, const std::string& text) {
  put(out, static_cast<std::uint64_t>(text.size()));
  out += text;
}

std::string numbers_of(const OpenMesh::BaseProperty& property) {
  std::ostringstream out;
  if (property.n_elements() > 0 && property.store(out, false) == 0) {
    throw InputError("property '" + property.name() + "' cannot be written");
  }
  return out.str();
}

bool is_kept(const OpenMesh::BaseProperty* property) {
  return property != nullptr && property->persistent();
}

std::string to_bytes(const TetMesh& mesh) {
  const auto domain = mesh.domain();
  std::uint64_t count = 0;
  for_each_container(mesh, [&](Kind, const auto& container, std::size_t) {
    for (const auto* property : container.properties()) count += is_kept(property) ? 1 : 0;
  });
  std::string bytes(kTetMeshMagic, kMagicSize);
  put(bytes, kByteOrder);
  put(bytes, static_cast<std::uint64_t>(domain.points.cols()));
  put(bytes, static_cast<std::uint64_t>(domain.cells.cols()));
  put(bytes, count);
  bytes.append(reinterpret_cast<const char*>(domain.points.data()),
               static_cast<std::size_t>(domain.points.size()) * sizeof(double));
  bytes.append(reinterpret_cast<const char*>(domain.cells.data()),
               static_cast<std::size_t>(domain.cells.size()) * sizeof(Index));
  for_each_container(mesh, [&](Kind kind, const auto& container, std::size_t) {
    for (const auto* property : container.properties()) {
      if (!is_kept(property)) continue;
      put(bytes, kind);
      put(bytes, property->name());
      put(bytes, property->get_storage_name());
      put(bytes, numbers_of(*property));
    }
  });
  return bytes;
}

std::uint64_t hash_of(const char* bytes, std::size_t size) {
  ContentHash hash;
  hash.add(bytes, size);
  return hash.value();
}

// Takes numbers from the bytes of a file, in order. That all are there the hash has shown; sizes
// are checked nevertheless, for files that somebody made otherwise.
class Reader {
 public:
  Reader(const std::string& path, const std::string& bytes)
      : path_(path), bytes_(bytes), end_(bytes.size()) {}

  [[noreturn]] void refuse(const std::string& why) const { throw InputError(path_ + ": " + why); }

  void check() {
    constexpr std::size_t kHashSize = sizeof(std::uint64_t);
    if (bytes_.compare(0, kMagicSize, kTetMeshMagic) != 0) refuse("is no file of save_tet_mesh()");
    at_ = kMagicSize;
    if (number<std::uint32_t>() != kByteOrder) refuse("comes from a machine with other numbers");
    if (bytes_.size() < at_ + kHashSize) refuse("ends too early");
    end_ = bytes_.size() - kHashSize;
    std::uint64_t hash = 0;
    std::memcpy(&hash, bytes_.data() + end_, kHashSize);
    if (hash != hash_of(bytes_.data(), end_)) refuse("is damaged or ends too early");
  }

  template <class Number>
  Number number() {
    Number number;
    std::memcpy(&number, take(sizeof number), sizeof number);
    return number;
  }
  std::string text() {
    const auto size = number<std::uint64_t>();
    return {take(size), size};
  }
  template <class Matrix>
  Matrix matrix(Eigen::Index rows, std::uint64_t cols) {
    constexpr std::size_t kNumber = sizeof(typename Matrix::Scalar);
    if (cols > (end_ - at_) / (static_cast<std::size_t>(rows) * kNumber)) refuse("ends too early");
    Matrix matrix(rows, static_cast<Eigen::Index>(cols));
    const auto size = static_cast<std::size_t>(matrix.size()) * kNumber;
    const char* from = take(size);
    if (size > 0) std::memcpy(matrix.data(), from, size);
    return matrix;
  }

 private:
  const char* take(std::uint64_t size) {
    if (size > end_ - at_) refuse("ends too early");
    const char* from = bytes_.data() + at_;
    at_ += size;
    return from;
  }

  const std::string& path_;
  const std::string& bytes_;
  std::size_t at_ = 0, end_;
};

// OpenMesh's own kernels alone may add a property whose type they do not know.
struct OpenContainer : OpenMesh::PropertyContainer {
  static constexpr auto kAdd = &OpenContainer::_add;
};

// A property without elements, made by OpenMesh's register of types. \return null if the type is
// not registered
std::unique_ptr<OpenMesh::BaseProperty> make_property(const std::string& type,
                                                      const std::string& name) {
  const SilencedOpenMesh silence;
  OpenMesh::PolyMesh_ArrayKernelT<> scratch;
  OpenMesh::create_property_from_string<OpenMesh::VertexHandle>(scratch, type, name);
  const OpenMesh::BaseProperty* const made = scratch._get_vprop(name);
  return std::unique_ptr<OpenMesh::BaseProperty>(made ? made->clone() : nullptr);
}

// Walks over the numbers of a property before OpenMesh reads them: it makes lists as long as they
// say they are, even if that is all memory and the numbers end before.
class StoredElements {
 public:
  explicit StoredElements(std::string_view numbers) : rest_(numbers) {}

  // Passes over an element. \return false if it says that it is longer than what is left
  bool pass(const std::string& type) {
    constexpr std::string_view kList = "std::vector<";
    if (type == "std::string") return pass_bytes(take<std::uint16_t>());
    if (type.compare(0, kList.size(), kList) != 0) return pass_bytes(size_of(type));
    const auto count = take<std::uint32_t>();
    const auto inner = type.substr(kList.size(), type.size() - kList.size() - 1);
    if (inner == "bool") return pass_bytes((count + 7) / 8);
    if (const auto size = size_of(inner); size > 0) return pass_bytes(count * size);
    for (std::uint64_t k = 0; k < count; ++k) {
      if (rest_.empty() || !pass(inner)) return false;
    }
    return true;
  }

 private:
  // More than there is if there is none.
  template <class Number>
  std::uint64_t take() {
    Number number = 0;
    if (rest_.size() < sizeof number) return rest_.size() + 1;
    std::memcpy(&number, rest_.data(), sizeof number);
    rest_.remove_prefix(sizeof number);
    return number;
  }

  bool pass_bytes(std::uint64_t count) {
    if (count > rest_.size()) return false;
    rest_.remove_prefix(count);
    return true;
  }

  // 0 for types whose elements differ in size, and for those that are not registered.
  std::uint64_t size_of(const std::string& type) {
    const auto [entry, is_new] = sizes_.emplace(type, 0);
    if (!is_new) return entry->second;
    const auto property = make_property(type, "");
    const auto size = property ? property->element_size() : 0;
    if (size != OpenMesh::BaseProperty::UnknownSize) entry->second = size;
    return entry->second;
  }

  std::map<std::string, std::uint64_t> sizes_;
  std::string_view rest_;
};

void read_property(Reader& reader, TetMesh& mesh) {
  const auto wanted = reader.number<Kind>();
  const auto name = reader.text();
  const auto type = reader.text();
  const auto numbers = reader.text();
  auto property = make_property(type, name);
  if (!property) {
    reader.refuse("has property '" + name + "' of type '" + type +
                  "', which is not registered in this program");
  }
  bool found = false;
  for_each_container(mesh, [&](Kind kind, auto& container, std::size_t elements) {
    if (kind != wanted) return;
    found = true;
    auto* const kept = property.get();
    (container.*OpenContainer::kAdd)(property.release());
    container.resize(elements);
    StoredElements stored(numbers);
    for (std::size_t k = 0; k < kept->n_elements(); ++k) {
      if (!stored.pass(type)) reader.refuse("has property '" + name + "', which ends too early");
    }
    std::istringstream in(numbers);
    if (kept->n_elements() > 0) kept->restore(in, false);
    kept->set_persistent(true);
  });
  if (!found) reader.refuse("has property '" + name + "' of an unknown kind of elements");
}

}  // namespace

void save_tet_mesh(const std::string& path, const TetMesh& mesh) {
  auto bytes = to_bytes(mesh);
  put(bytes, hash_of(bytes.data(), bytes.size()));
  io::write_file(path, [&](std::ostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

TetMesh load_tet_mesh(const std::string& path) {
  const auto bytes = io::read_file(path);
  Reader reader(path, bytes);
  reader.check();
  const auto vertices = reader.number<std::uint64_t>();
  const auto cells = reader.number<std::uint64_t>();
  const auto properties = reader.number<std::uint64_t>();
  DomainMesh<3> domain;
  domain.points = reader.matrix<PointList<3>>(3, vertices);
  if (!domain.points.allFinite()) reader.refuse("has a vertex that is not finite");
  domain.cells = reader.matrix<CellList<3>>(4, cells);
  TetMesh mesh;
  try {
    mesh.assign_valid(domain);
    for (std::uint64_t k = 0; k < properties; ++k) read_property(reader, mesh);
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (text.rfind(path, 0) == 0) throw;
    throw InputError(path + ": " + text);
  }
  return mesh;
}

}  // namespace flbc::openmesh
