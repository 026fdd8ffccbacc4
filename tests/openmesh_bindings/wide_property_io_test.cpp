// SPDX-License-Identifier: BSD-3-Clause
// Wide properties in .om files, written and read by OpenMesh itself.
#include <sys/resource.h>

#include "../../openmesh_bindings/src/number_stream.h"
#include "support/scratch.h"
#include "support/wide_meshes.h"

namespace flbc::openmesh {
namespace {

using testing::add_filled;
using testing::expect_filled;
using testing::fill;
using testing::is_filled;

template <class Mesh>
std::string written(const Mesh& mesh) {
  std::ostringstream out(std::ios::binary);
  EXPECT_TRUE(OpenMesh::IO::write_mesh(mesh, out, ".om", OpenMesh::IO::Options::Binary, 17));
  return out.str();
}

template <class Mesh>
bool read(Mesh& mesh, const std::string& content) {
  std::istringstream in(content, std::ios::binary);
  OpenMesh::IO::Options options = OpenMesh::IO::Options::Binary;
  return OpenMesh::IO::read_mesh(mesh, in, ".om", options);
}

template <class Scalar>
std::string stored(const OpenMesh::PropertyT<Wide<Scalar>>& rows, bool swap) {
  std::ostringstream out(std::ios::binary);
  EXPECT_EQ(rows.store(out, swap), rows.size_of());
  EXPECT_EQ(out.str().size(), rows.size_of());
  return out.str();
}

template <class Scalar>
std::size_t restore(OpenMesh::PropertyT<Wide<Scalar>>& rows, const std::string& content,
                    bool swap) {
  std::istringstream in(content, std::ios::binary);
  return rows.restore(in, swap);
}

// The header: 8 letters, then numbers of 8 bytes.
enum Field { kScalarBytes, kComponents, kWidth, kElements, kDataBytes, kFields };
constexpr std::size_t kHeaderBytes = 8 + 8 * kFields;
void set_field(std::string& content, Field field, std::uint64_t value) {
  std::memcpy(&content[8 + 8 * static_cast<std::size_t>(field)], &value, 8);
}

// Numbers that a detour through text, arithmetic or another precision would not leave alone.
template <class Scalar>
std::vector<Scalar> delicate_numbers() {
  using Limits = std::numeric_limits<Scalar>;
  return {Scalar(-0.0),        Limits::denorm_min(), Limits::max(),
          -Limits::infinity(), Limits::quiet_NaN(),  std::nextafter(Scalar(1), Scalar(2)),
          Scalar(1) / 3};
}

template <class Case>
struct WidePropertyIo : testing::WidePropertyTest<Case> {};
TYPED_TEST_SUITE(WidePropertyIo, testing::WideCases);

template <class Handle, class Mesh>
Handle handle_of(const Mesh& mesh, const std::string& name) {
  Handle handle;
  EXPECT_TRUE(mesh.get_property_handle(handle, name)) << name;
  return handle;
}

TYPED_TEST(WidePropertyIo, ComesBackFromFilesWithAllElementsAndItsShape) {
  using T = TestFixture;
  auto& mesh = this->mesh_;
  mesh.property(add_filled<typename T::Vertices>(mesh, "rows", 1, 9)).set_persistent(true);
  mesh.property(add_filled<typename T::Halfedges>(mesh, "rows", 1, 8)).set_persistent(true);
  mesh.property(add_filled<typename T::Edges>(mesh, "rows", 4, 1)).set_persistent(true);
  mesh.property(add_filled<typename T::Faces>(mesh, "rows", 3, 31)).set_persistent(true);
  mesh.property(add_filled<typename T::Faces>(mesh, "empty", 0, 31)).set_persistent(true);
  add_filled<typename T::Faces>(mesh, "not persistent", 2, 3);
  typename T::OfMesh of_mesh;
  mesh.add_property(of_mesh, "rows");
  mesh.mproperty(of_mesh).set_shape(2, 5);
  mesh.mproperty(of_mesh).set_persistent(true);
  fill(mesh.property(of_mesh), 11);

  typename TypeParam::Mesh loaded;
  ASSERT_TRUE(read(loaded, written(mesh)));
  ASSERT_EQ(loaded.n_faces(), mesh.n_faces());
  expect_filled(loaded, handle_of<typename T::Vertices>(loaded, "rows"), 1, 9);
  expect_filled(loaded, handle_of<typename T::Halfedges>(loaded, "rows"), 1, 8);
  expect_filled(loaded, handle_of<typename T::Edges>(loaded, "rows"), 4, 1);
  expect_filled(loaded, handle_of<typename T::Faces>(loaded, "rows"), 3, 31);
  const auto& empty = loaded.property(handle_of<typename T::Faces>(loaded, "empty"));
  EXPECT_EQ(empty.n_elements(), mesh.n_faces());
  EXPECT_EQ(empty.components(), 0U);
  EXPECT_EQ(empty.width(), 31U);
  const auto found = handle_of<typename T::OfMesh>(loaded, "rows");
  EXPECT_TRUE(is_filled(std::as_const(loaded).property(found), 11, 2, 5));
  typename T::Faces left_out;
  EXPECT_FALSE(loaded.get_property_handle(left_out, "not persistent"));
}

TYPED_TEST(WidePropertyIo, TakesTheShapeOfTheFileInAMeshThatHasTheProperty) {
  using T = TestFixture;
  const auto handle = add_filled<typename T::Vertices>(this->mesh_, "rows", 2, 9);
  this->mesh_.property(handle).set_persistent(true);
  const auto content = written(this->mesh_);
  auto loaded = testing::make_squares<typename TypeParam::Mesh>(3);
  const auto other = add_filled<typename T::Vertices>(loaded, "rows", 1, 40);
  loaded.property(other).set_persistent(true);
  ASSERT_TRUE(read(loaded, content));
  expect_filled(loaded, other, 2, 9);
  // And again, from what was read.
  typename TypeParam::Mesh again;
  ASSERT_TRUE(read(again, written(loaded)));
  expect_filled(again, handle_of<typename T::Vertices>(again, "rows"), 2, 9);
}

TYPED_TEST(WidePropertyIo, KeepsEveryBitInBothByteOrders) {
  using Scalar = typename TypeParam::Scalar;
  using Property = OpenMesh::PropertyT<Wide<Scalar>>;
  const auto numbers = delicate_numbers<Scalar>();
  Property rows("rows");
  rows.resize(3);
  rows.set_shape(2, numbers.size());
  for (int e = 0; e < 3; ++e) {
    for (std::size_t c = 0; c < 2; ++c) std::copy(numbers.begin(), numbers.end(), rows[e].row(c));
  }
  for (const bool swap : {false, true}) {
    Property loaded("rows");
    loaded.resize(3);
    ASSERT_EQ(restore(loaded, stored(rows, swap), swap), rows.size_of());
    ASSERT_EQ(loaded.bytes(), rows.bytes());
    EXPECT_EQ(std::memcmp(loaded.data(), rows.data(), rows.bytes()), 0);
  }
  auto last = stored(rows, true).substr(rows.size_of() - sizeof(Scalar));
  std::reverse(last.begin(), last.end());
  EXPECT_EQ(std::memcmp(last.data(), &numbers.back(), sizeof(Scalar)), 0);
}

TYPED_TEST(WidePropertyIo, RefusesThePropertyOfAnotherPrecisionMeshOrType) {
  using Scalar = typename TypeParam::Scalar;
  using Other = std::conditional_t<std::is_same_v<Scalar, float>, double, float>;
  const auto handle = add_filled<typename TestFixture::Vertices>(this->mesh_, "rows", 2, 9);
  this->mesh_.property(handle).set_persistent(true);
  typename TypeParam::Mesh loaded;
  OpenMesh::VPropHandleT<Wide<Other>> other;
  loaded.add_property(other, "rows");
  EXPECT_THROW(read(loaded, written(this->mesh_)), InputError);

  const auto content = stored(this->mesh_.property(handle), false);
  OpenMesh::PropertyT<Wide<Scalar>> too_small("rows");
  too_small.resize(this->mesh_.n_vertices() - 1);
  EXPECT_THROW(restore(too_small, content, false), InputError);

  typename TypeParam::Mesh with_vectors = testing::make_squares<typename TypeParam::Mesh>();
  OpenMesh::VPropHandleT<std::vector<double>> vectors;
  with_vectors.add_property(vectors, "rows");
  with_vectors.property(vectors).set_persistent(true);
  EXPECT_THROW(read(this->mesh_, written(with_vectors)), InputError);
}

TYPED_TEST(WidePropertyIo, RefusesEveryDamagedShapeAndCutFile) {
  using Scalar = typename TypeParam::Scalar;
  const auto handle = add_filled<typename TestFixture::Vertices>(this->mesh_, "rows", 2, 3);
  auto& rows = this->mesh_.property(handle);
  rows.set_persistent(true);
  const auto block = stored(rows, false);
  for (std::size_t k = 0; k < kHeaderBytes; ++k) {
    for (const int change : {1, 2, 0x80, 0xff}) {
      auto damaged = block;
      damaged[k] = static_cast<char>(damaged[k] ^ change);
      EXPECT_THROW(restore(rows, damaged, false), InputError) << "byte " << k;
    }
  }
  for (std::size_t size = 0; size < block.size(); ++size) {
    EXPECT_THROW(restore(rows, block.substr(0, size), false), InputError) << size;
  }
  expect_filled(this->mesh_, handle, 2, 3);

  // The same in a file, where OpenMesh is the reader.
  const auto content = written(this->mesh_);
  const auto begin = content.find(block);
  ASSERT_NE(begin, std::string::npos);
  typename TypeParam::Mesh loaded;
  for (std::size_t k = begin; k < begin + kHeaderBytes; ++k) {
    auto damaged = content;
    damaged[k] = static_cast<char>(damaged[k] ^ 1);
    EXPECT_THROW(read(loaded, damaged), InputError) << "byte " << k;
  }
  for (std::size_t size = begin; size < begin + block.size(); size += 13) {
    EXPECT_THROW(read(loaded, content.substr(0, size)), InputError) << size;
  }
  EXPECT_TRUE(read(loaded, content));
  expect_filled(loaded, handle_of<typename TestFixture::Vertices>(loaded, "rows"), 2, 3);
  static_assert(sizeof(Scalar) <= 8);
}

// A stream that can only be read from front to back.
struct Pipe : std::streambuf {
  explicit Pipe(std::string text) : content(std::move(text)) {
    setg(content.data(), content.data(), content.data() + content.size());
  }
  std::string content;
};

TEST(WidePropertyLimits, ReadsStreamsOfUnknownLength) {
  OpenMesh::PropertyT<Wide<double>> rows("rows"), loaded("rows");
  rows.resize(1000);
  rows.set_shape(2, 5);
  for (int e = 0; e < 1000; ++e) fill(rows[e], e);
  loaded.resize(1000);
  Pipe pipe(stored(rows, false));
  std::istream in(&pipe);
  ASSERT_EQ(in.tellg(), std::istream::pos_type(-1));
  EXPECT_EQ(loaded.restore(in, false), rows.size_of());
  ASSERT_EQ(loaded.bytes(), rows.bytes());
  EXPECT_EQ(std::memcmp(loaded.data(), rows.data(), rows.bytes()), 0);
}

long peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST(WidePropertyLimits, TakesNoMemoryForNumbersThatAreNotThere) {
  OpenMesh::PropertyT<Wide<double>> rows("rows");
  rows.resize(1);
  rows.set_shape(1, 100);
  const auto sound = stored(rows, false);
  const auto before = peak_kilobytes();
  // Shapes that agree with their size, as large as the format allows.
  const std::uint64_t most = (std::uint64_t(1) << 29) - 8;
  for (const auto& [components, width] :
       std::vector<std::pair<std::uint64_t, std::uint64_t>>{{1, most}, {most, 1}, {8, most / 8}}) {
    auto damaged = sound;
    set_field(damaged, kComponents, components);
    set_field(damaged, kWidth, width);
    set_field(damaged, kDataBytes, components * width * 8);
    // Seen at once, not when the memory or the file is used up.
    testing::expect_refused("property 'rows' cannot be read: the file ends within the property",
                            [&] { restore(rows, damaged, false); });
    Pipe pipe(damaged);
    std::istream in(&pipe);
    EXPECT_THROW(rows.restore(in, false), InputError);
  }
  EXPECT_EQ(rows.width(), 100U);
  // Room for the shadow memory of an address sanitizer.
  EXPECT_LT(peak_kilobytes() - before, 1 << 20);
}

TEST(WidePropertyLimits, RefusesToWriteMoreThanFilesCanHold) {
  EXPECT_NO_THROW(require_storable("huge", kMostStoredBytes));
  EXPECT_THROW(require_storable("huge", kMostStoredBytes + 1), IoError);
}

// FLBC_PLAIN_OPENMESH_READER: tests/support/plain_openmesh_reader.cpp, linked with OpenMesh alone.
TYPED_TEST(WidePropertyIo, LeavesTheRestOfAFileToProgramsThatKnowOnlyOpenMesh) {
  using T = TestFixture;
  auto& mesh = this->mesh_;
  mesh.property(add_filled<typename T::Vertices>(mesh, "a", 1, 9)).set_persistent(true);
  OpenMesh::VProp<double> mass(mesh, "mass");
  for (const auto v : mesh.vertices()) mass[v] = 1.0 / (3 + v.idx());
  mesh.property(mass.getRawProperty()).set_persistent(true);
  mesh.property(add_filled<typename T::Vertices>(mesh, "z", 2, 3)).set_persistent(true);
  mesh.property(add_filled<typename T::Edges>(mesh, "rows", 4, 1)).set_persistent(true);
  mesh.property(add_filled<typename T::Faces>(mesh, "rows", 3, 31)).set_persistent(true);
  typename T::OfMesh of_mesh;
  mesh.add_property(of_mesh, "rows");
  mesh.mproperty(of_mesh).set_persistent(true);
  OpenMesh::MProp<std::string> note(mesh, "note");
  note() = "written by the test";
  mesh.mproperty(note.getRawProperty()).set_persistent(true);

  const auto in = testing::scratch_path("in.om");
  const auto out = testing::scratch_path("out.om");
  ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, in));
  const std::string command =
      std::string(FLBC_PLAIN_OPENMESH_READER) + " " + in + " " + out + " 2>/dev/null >/dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  typename TypeParam::Mesh loaded;
  ASSERT_TRUE(OpenMesh::IO::read_mesh(loaded, out));

  ASSERT_EQ(loaded.n_vertices(), mesh.n_vertices());
  ASSERT_EQ(loaded.n_edges(), mesh.n_edges());
  ASSERT_EQ(loaded.n_faces(), mesh.n_faces());
  OpenMesh::VPropHandleT<double> loaded_mass;
  ASSERT_TRUE(loaded.get_property_handle(loaded_mass, "mass"));
  for (const auto v : mesh.vertices()) {
    EXPECT_EQ(loaded.point(v), mesh.point(v));
    EXPECT_EQ(loaded.property(loaded_mass, v), mass[v]);
  }
  for (const auto h : mesh.halfedges()) {
    EXPECT_EQ(loaded.to_vertex_handle(h), mesh.to_vertex_handle(h));
    EXPECT_EQ(loaded.face_handle(h), mesh.face_handle(h));
  }
  EXPECT_EQ(OpenMesh::MProp<std::string>(loaded, "note")(), "written by the test");
  typename T::Vertices unknown;
  EXPECT_FALSE(loaded.get_property_handle(unknown, "a"));
}

}  // namespace
}  // namespace flbc::openmesh
