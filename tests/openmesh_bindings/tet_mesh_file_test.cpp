// SPDX-License-Identifier: BSD-3-Clause
// A TetMesh comes back from its file with all it had.
#include "flbc/openmesh/tet_mesh_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "flbc/io/files.h"
#include "flbc/openmesh/lbc.h"
#include "flbc/openmesh/sparsify.h"
#include "support/sample_meshes.h"
#include "support/scratch.h"

namespace flbc::testing {
namespace {

using openmesh::TetMesh;

std::string file() {
  return scratch_path("mesh.flbctet");
}

template <class Action>
void expect_refused(const std::string& words, const Action& action) {
  try {
    action();
    FAIL() << "accepted, expected: " << words;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).rfind(file() + ": ", 0), 0U) << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TetMesh make_mesh() {
  return TetMesh::from(make_sample<3>(Shape::kCorner, 2, 0.2).mesh);
}

template <class PropHandle, class Values>
void add(TetMesh& mesh, const std::string& name, const Values& value_of) {
  PropHandle handle;
  mesh.add_property(handle, name);
  auto& property = mesh.property(handle);
  for (std::size_t k = 0; k < property.n_elements(); ++k) {
    property[static_cast<int>(k)] = value_of(static_cast<int>(k));
  }
  property.set_persistent(true);
}

TEST(TetMeshFile, KeepsElementsAndProperties) {
  auto mesh = make_mesh();
  add<OpenMesh::VPropHandleT<double>>(mesh, "v", [](int k) { return 0.1 * k; });
  add<OpenMesh::EPropHandleT<int>>(mesh, "e", [](int k) { return 3 * k; });
  add<OpenMesh::FPropHandleT<std::vector<double>>>(mesh, "f", [](int k) {
    return std::vector<double>(static_cast<std::size_t>(k % 4), 0.5 * k);
  });
  add<openmesh::CPropHandleT<std::string>>(mesh, "c", [](int k) { return std::to_string(k); });
  OpenMesh::VPropHandleT<int> passing;
  mesh.add_property(passing, "not kept");
  openmesh::save_tet_mesh(file(), mesh);
  const auto loaded = openmesh::load_tet_mesh(file());
  EXPECT_EQ(loaded.domain().points, mesh.domain().points);
  EXPECT_EQ(loaded.domain().cells, mesh.domain().cells);
  EXPECT_EQ(openmesh::edges_of(loaded), openmesh::edges_of(mesh));
  OpenMesh::VPropHandleT<double> v;
  OpenMesh::EPropHandleT<int> e;
  OpenMesh::FPropHandleT<std::vector<double>> f;
  openmesh::CPropHandleT<std::string> c;
  ASSERT_TRUE(loaded.get_property_handle(v, "v"));
  ASSERT_TRUE(loaded.get_property_handle(e, "e"));
  ASSERT_TRUE(loaded.get_property_handle(f, "f"));
  ASSERT_TRUE(loaded.get_property_handle(c, "c"));
  EXPECT_FALSE(loaded.get_property_handle(passing, "not kept"));
  for (const auto x : mesh.vertices()) EXPECT_EQ(loaded.property(v, x), 0.1 * x.idx());
  for (const auto x : mesh.edges()) EXPECT_EQ(loaded.property(e, x), 3 * x.idx());
  for (const auto x : mesh.faces()) {
    EXPECT_EQ(loaded.property(f, x),
              std::vector<double>(static_cast<std::size_t>(x.idx() % 4), 0.5 * x.idx()));
  }
  for (const auto x : mesh.cells()) EXPECT_EQ(loaded.property(c, x), std::to_string(x.idx()));
  // What came from a file goes into the next one.
  const auto bytes = io::read_file(file());
  openmesh::save_tet_mesh(file(), loaded);
  EXPECT_EQ(io::read_file(file()), bytes);
}

TEST(TetMeshFile, KeepsSparseWeights) {
  const auto sample = make_sample<3>(Shape::kCorner, 2, 0.2);
  auto mesh = TetMesh::from(sample.mesh);
  openmesh::solve(mesh, sample.cage);
  openmesh::ReductionOptions options;
  options.persistent = true;
  openmesh::sparsify(mesh, 6, options);
  openmesh::save_tet_mesh(file(), mesh);
  const auto loaded = openmesh::load_tet_mesh(file());
  EXPECT_EQ(openmesh::get_weights(loaded), openmesh::get_weights(mesh));
  EXPECT_EQ(openmesh::get_rest_cage(loaded), sample.cage.points);
}

TEST(TetMeshFile, DamageIsNamed) {
  auto mesh = make_mesh();
  add<OpenMesh::VPropHandleT<double>>(mesh, "v", [](int k) { return 0.1 * k; });
  openmesh::save_tet_mesh(file(), mesh);
  const auto bytes = io::read_file(file());
  const auto load = [&](const std::string& content) {
    io::write_file(file(), [&](std::ostream& out) { out << content; });
    openmesh::load_tet_mesh(file());
  };
  expect_refused("is no file of save_tet_mesh()", [&] { load("something else"); });
  expect_refused("is no file of save_tet_mesh()", [&] { load(""); });
  for (std::size_t size = 8; size < bytes.size(); size += 97) {
    expect_refused("", [&] { load(bytes.substr(0, size)); });
  }
  for (std::size_t place = 0; place < bytes.size(); place += 61) {
    auto damaged = bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x40);
    expect_refused("", [&] { load(damaged); });
  }
  EXPECT_NO_THROW(load(bytes));
}

}  // namespace
}  // namespace flbc::testing
