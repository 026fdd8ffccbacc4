// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What the tests of all file formats share.
#pragma once

#include "flbc/io/mesh_io.h"
#include "support/io_files.h"
#include "support/sample_meshes.h"

namespace flbc::testing {

//! Content of a file, and the message about it: the file's name, then `place`; `message` anywhere.
struct Malformed {
  std::string content, place, message;
};

class FormatTest : public FolderTest {
 protected:
  //! \param read  reads the file at a path
  template <class Read>
  void expect_malformed(const std::string& name, const Read& read,
                        const std::vector<Malformed>& cases) const {
    for (const Malformed& malformed : cases) {
      SCOPED_TRACE(malformed.content.substr(0, 200));
      const std::string file = make(name, malformed.content);
      expect_error<InputError>([&] { read(file); }, {file + malformed.place, malformed.message});
    }
  }

  //! Files that are missing or folders, and folders that are missing.
  template <class Read, class Write>
  void expect_unopenable(const std::vector<std::string>& extensions, const Read& read,
                         const Write& write) const {
    for (const std::string& extension : extensions) {
      const std::string missing = path("missing." + extension);
      expect_error<IoError>([&] { read(missing); }, {path("missing."), "No such file"});
      const std::string nowhere = path("missing/file." + extension);
      expect_error<IoError>([&] { write(nowhere); }, {path("missing/file."), "No such file"});
      const std::string folder = path("folder." + extension);
      std::filesystem::create_directory(folder);
      expect_error<IoError>([&] { read(folder); }, {"folder.", "directory"});
      expect_error<IoError>([&] { write(folder); }, {folder, "directory"});
      std::filesystem::remove(folder);
    }
    EXPECT_TRUE(names().empty());
  }
};

//! Coordinates with all their digits.
template <int Dim>
DomainMesh<Dim> awkward_mesh() {
  auto mesh = samples<Dim>().front().mesh;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    mesh.points.col(v) = mesh.points.col(v) / 3.0 + Vector<Dim>::Constant(1e-9 * v);
  }
  mesh.points.col(0)[0] = mesh.points.col(0)[0] * (1 + 1e-15);
  return mesh;
}

//! The file has this tetrahedron, possibly with more text around it.
inline void expect_reference_tetrahedron(const std::string& file) {
  SCOPED_TRACE(file);
  const auto mesh = io::read_domain<3>(file);
  ASSERT_EQ(mesh.num_vertices(), 4);
  ASSERT_EQ(mesh.num_cells(), 1);
  EXPECT_TRUE(bit_equal(mesh.points.col(0), Vector<3>::Zero()));
  EXPECT_TRUE(bit_equal(mesh.points.rightCols<3>(), Eigen::Matrix3d::Identity()));
  EXPECT_EQ(signed_measure(mesh, 0), 1.0 / 6.0);
}

}  // namespace flbc::testing
