// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/mesh_io.h"

#include <sstream>

#include "format_test.h"
#include "support/dimensions.h"

namespace flbc::io {
namespace {

using flbc::testing::awkward_mesh;
using flbc::testing::bit_equal;
using flbc::testing::expect_error;
using flbc::testing::expect_reference_tetrahedron;
using flbc::testing::FormatTest;

template <int Dim>
std::vector<std::string> readable_extensions() {
  if constexpr (Dim == 2) return {"obj", "off", "OBJ"};
  return {"mesh", "msh", "MSH"};
}

class MeshFile : public FormatTest {
 protected:
  void expect_malformed(const std::string& name,
                        const std::vector<flbc::testing::Malformed>& cases) const {
    FormatTest::expect_malformed(name, read_domain<3>, cases);
  }
};

template <class Dimension>
class DomainFile : public FormatTest {
 protected:
  static constexpr int kDim = Dimension::value;

  // One cell with these numbers.
  static DomainMesh<kDim> simplex(double size) {
    DomainMesh<kDim> mesh;
    mesh.points.resize(kDim, kDim + 1);
    mesh.points << PointList<kDim>::Zero(kDim, 1), PointList<kDim>::Identity(kDim, kDim) * size;
    mesh.cells = CellList<kDim>(kDim + 1, 1);
    for (Index k = 0; k <= kDim; ++k) mesh.cells(k, 0) = k;
    return mesh;
  }

  // The mesh written in every format, and read.
  template <class Check>
  void for_formats(const DomainMesh<kDim>& mesh, const Check& check) const {
    for (const std::string& extension : readable_extensions<kDim>()) {
      SCOPED_TRACE(extension);
      const std::string file = this->path("domain." + extension);
      write_domain(file, mesh);
      check(file, extension);
    }
  }
};

TYPED_TEST_SUITE(DomainFile, flbc::testing::Dimensions);

TYPED_TEST(DomainFile, RoundTripIsBitEqual) {
  constexpr int Dim = TypeParam::value;
  auto meshes = std::vector{awkward_mesh<Dim>()};
  for (const double size : {1e-70, 1.0 / 3.0, 1e70}) {
    meshes.push_back(this->simplex(size));
    meshes.back().points(0, 2) = -4.9406564584124654e-324;
  }
  for (const auto& mesh : meshes) {
    this->for_formats(mesh, [&](const std::string& file, const std::string&) {
      const DomainMesh<Dim> read = read_domain<Dim>(file);
      EXPECT_TRUE(bit_equal(read.points, mesh.points));
      EXPECT_EQ(read.cells, mesh.cells);
    });
  }
}

TYPED_TEST(DomainFile, CellsAreTurnedRound) {
  constexpr int Dim = TypeParam::value;
  const DomainMesh<Dim> mesh = awkward_mesh<Dim>();
  DomainMesh<Dim> inverted = mesh;
  for (Index s = 0; s < mesh.num_cells(); s += 2) {
    std::swap(inverted.cells(0, s), inverted.cells(1, s));
  }
  this->for_formats(inverted, [](const std::string& file, const std::string&) {
    const DomainMesh<Dim> read = read_domain<Dim>(file);
    for (Index s = 0; s < read.num_cells(); ++s) ASSERT_GT(signed_measure(read, s), 0);
  });
}

TYPED_TEST(DomainFile, InvalidMeshesAreReportedWithTheFile) {
  constexpr int Dim = TypeParam::value;
  DomainMesh<Dim> mesh = awkward_mesh<Dim>();
  mesh.points.conservativeResize(Dim, mesh.points.cols() + 1);
  mesh.points.col(mesh.points.cols() - 1).setConstant(9);
  this->for_formats(mesh, [&](const std::string& file, const std::string&) {
    expect_error<InputError>(
        [&] { read_domain<Dim>(file); },
        {file + ": ", "vertex " + std::to_string(mesh.num_vertices() - 1), "belongs to no cell"});
  });
}

TYPED_TEST(DomainFile, OtherExtensionsAreRefused) {
  constexpr int Dim = TypeParam::value;
  const DomainMesh<Dim> mesh = awkward_mesh<Dim>();
  const std::string wrong = this->path(Dim == 2 ? "domain.mesh" : "domain.obj");
  const std::string listed = Dim == 2 ? ".obj" : ".mesh";
  for (const std::string& file : {wrong, this->path("domain.ply"), this->path("domain")}) {
    expect_error<OptionError>([&] { read_domain<Dim>(file); }, {file, listed});
    expect_error<OptionError>([&] { write_domain(file, mesh); }, {file, listed, ".vtu"});
  }
  EXPECT_TRUE(this->names().empty());
}

TYPED_TEST(DomainFile, FilesThatCannotBeOpened) {
  constexpr int Dim = TypeParam::value;
  this->expect_unopenable(readable_extensions<Dim>(), read_domain<Dim>,
                          [](const auto& file) { write_domain(file, awkward_mesh<Dim>()); });
}

TYPED_TEST(DomainFile, CoordinatesThatAreNotFiniteAreNotWritten) {
  constexpr int Dim = TypeParam::value;
  DomainMesh<Dim> mesh = awkward_mesh<Dim>();
  mesh.points(1, 3) = 0.0 / 0.0;
  auto extensions = readable_extensions<Dim>();
  extensions.emplace_back("vtu");
  for (const std::string& extension : extensions) {
    expect_error<InputError>([&] { write_domain(this->path("d." + extension), mesh); },
                             {"not finite"});
  }
  EXPECT_TRUE(this->names().empty());
}

// All numbers between the tags of the data array with this name.
std::vector<double> vtu_array(const std::string& file, const std::string& name) {
  const std::size_t tag = file.find("Name=\"" + name + "\"");
  EXPECT_NE(tag, std::string::npos) << name;
  if (tag == std::string::npos) return {};
  const std::size_t begin = file.find('>', tag) + 1;
  std::istringstream numbers(file.substr(begin, file.find('<', begin) - begin));
  std::vector<double> result;
  for (std::string word; numbers >> word;) result.push_back(std::stod(word));
  return result;
}

TYPED_TEST(DomainFile, VtuHasMeshAndFields) {
  constexpr int Dim = TypeParam::value;
  const DomainMesh<Dim> mesh = awkward_mesh<Dim>();
  const Eigen::VectorXd values = mesh.points.row(1).transpose() / 7.0;
  write_domain(this->path("d.vtu"), mesh, {{"weight 0", values}, {"a<&>\"b", -values}});
  const std::string file = this->content("d.vtu");
  flbc::testing::expect_piece(file,
                              "NumberOfPoints=\"" + std::to_string(mesh.num_vertices()) + "\"");
  flbc::testing::expect_piece(file, "NumberOfCells=\"" + std::to_string(mesh.num_cells()) + "\"");

  Eigen::MatrixXd points = Eigen::MatrixXd::Zero(3, mesh.num_vertices());
  points.topRows(Dim) = mesh.points;
  const auto numbers = [](const auto& matrix) {
    return std::vector<double>(matrix.data(), matrix.data() + matrix.size());
  };
  EXPECT_EQ(vtu_array(file, "Points"), numbers(points));
  EXPECT_EQ(vtu_array(file, "connectivity"), numbers(mesh.cells));
  const std::vector<double> offsets = vtu_array(file, "offsets");
  ASSERT_EQ(offsets.size(), static_cast<std::size_t>(mesh.num_cells()));
  EXPECT_EQ(offsets.front(), Dim + 1);
  EXPECT_EQ(offsets.back(), mesh.cells.size());
  // VTK_TRIANGLE and VTK_TETRA
  EXPECT_EQ(vtu_array(file, "types"), std::vector<double>(mesh.num_cells(), Dim == 2 ? 5 : 10));
  EXPECT_EQ(vtu_array(file, "weight 0"), numbers(values));
  EXPECT_EQ(vtu_array(file, "a&lt;&amp;&gt;&quot;b"), numbers(Eigen::VectorXd(-values)));
}

TYPED_TEST(DomainFile, VtuIsForViewers) {
  constexpr int Dim = TypeParam::value;
  write_domain(this->path("d.vtu"), awkward_mesh<Dim>());
  expect_error<OptionError>([&] { read_domain<Dim>(this->path("d.vtu")); },
                            {this->path("d.vtu"), "only written", ".mesh (in 2D .obj)"});
}

TYPED_TEST(DomainFile, FieldsAreNotLostSilently) {
  constexpr int Dim = TypeParam::value;
  const DomainMesh<Dim> mesh = awkward_mesh<Dim>();
  const VertexField field{"weight", mesh.points.row(0)};
  for (const std::string& extension : readable_extensions<Dim>()) {
    expect_error<OptionError>([&] { write_domain(this->path("d." + extension), mesh, {field}); },
                              {"fields", "d." + extension, ".vtu"});
  }
  const auto refused = [&](const std::string& words, const std::vector<VertexField>& fields) {
    expect_error<InputError>([&] { write_domain(this->path("d.vtu"), mesh, fields); }, {words});
  };
  refused("\"weight\" occurs twice", {field, field});
  for (const char* name : {"", "two\nlines", "tab\t"}) {
    refused("control characters", {{name, field.values}});
  }
  refused("\"short\" has 3 values for " + std::to_string(mesh.num_vertices()),
          {{"short", Eigen::VectorXd::Zero(3)}});
  EXPECT_TRUE(this->names().empty());
}

TEST_F(MeshFile, PlanarMeshesMustBeTrianglesInThePlane) {
  const std::string quad = make("quad.obj", "v 0 0\nv 1 0\nv 1 1\nv 0 1\nf 1 2 3\nf 1 2 3 4\n");
  expect_error<InputError>([&] { read_domain<2>(quad); }, {quad, "face 1 has 4 vertices"});
  const std::string tilted = make("tilted.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0.5\n3 0 1 2\n");
  expect_error<InputError>([&] { read_domain<2>(tilted); },
                           {tilted, "vertex 2 at (0, 1, 0.5)", "z = 0"});
  const std::string flat = make("flat.off", "OFF 3 1 0\n0 0 -0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(read_domain<2>(flat).num_cells(), 1);
}

TEST_F(MeshFile, MeditVariants) {
  const std::string points = "0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 2\n";
  const std::vector<std::string> variants = {
      "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n" + points +
          "Tetrahedra\n1\n1 2 3 4 1\nEnd\n",
      "MeshVersionFormatted\n1\n\nDimension\n3\n# made by hand\nVertices 4\n" + points +
          "\nEdges 1\n1 2 0\nTriangles\n2\n1 2 3 1\n2 3 4 1\nCorners 1\n1\nHexahedra\n0\n"
          "Tetrahedra 1\n1 2 3 4 1\nRidges 0\n\nEnd\n\x01garbage",
      "MeshVersionFormatted 2\r\nDimension 3\r\nVertices\r\n4\r\n0 0 0 1 1 0 0 1\r\n"
      "0 1 0 1 0 0 1 2\r\nTetrahedra\r\n1\r\n1 2 4 3 1",
  };
  for (const std::string& variant : variants) {
    expect_reference_tetrahedron(make("variant.mesh", variant));
  }
}

TEST_F(MeshFile, MalformedMedit) {
  const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
  const std::string points = "Vertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 2\n";  // lines 3 to 8
  expect_malformed(
      "d.mesh",
      {{"", ":1: ", "MeshVersionFormatted"},
       {"MFEM mesh v1.0\n", ":1: ", "MFEM; save it there by PrintVTU()"},
       {std::string("\0\0\x01\xff garbage", 12), ":1: ", "not a MEDIT text file"},
       {"MeshVersionFormatted 2\nDimension 2\n", ":2: ", "the dimension is 2, not 3"},
       {head, ":2: ", "no section Vertices"},
       {head + points, ":8: ", "no section Tetrahedra"},
       {head + "Tetrahedra\n1\n1 2 3 4 1\n" + points, ":3: ", "before Vertices"},
       {head + "Vertices\n2000000000\n0 0 0 1\n", ":4: ", "2000000000 vertices are declared, but"},
       {head + "Vertices\n3\n0 0 0 100000\n1 0 0 100000\n", ":6: ", "after 2 of 3 vertices"},
       {head + points + "Tetrahedra\n1\n1 2 3 5 1\n", ":11: ", "numbered 1 to 4"},
       {head + points + points, ":9: ", "a second section Vertices"},
       {head + points + "Hexahedra\n1\n1 2 3 4 1 2 3 4 0\n", ":10: ", "Hexahedra"},
       {head + points + "Tetrahedra\n1\n1 2 3 4 1\n7 7\n", ":12: ", "expected a keyword"}});
}

const char* const kFormat2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";  // 3 lines
const char* const kNodes2 =
    "$Nodes\n4\n7 0 0 0\n9 1 0 0\n3 0 1 0\n5 0 0 1\n$EndNodes\n";  // 7 lines
const char* const kFormat4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
// Two blocks; the second one has a parameter with its point. 13 lines
const char* const kNodes4 =
    "$Nodes\n2 4 3 9\n3 1 0 3\n7\n9\n3\n0 0 0\n1 0 0\n0 1 0\n0 1 1 1\n5\n0 0 1 0.5\n$EndNodes\n";

TEST_F(MeshFile, GmshVariants) {
  const std::vector<std::string> variants = {
      std::string(kFormat2) + kNodes2 + "$Elements\n1\n1 4 2 1 1 7 9 3 5\n$EndElements\n",
      std::string(kFormat2) + "$PhysicalNames\n1\n3 1 \"inside $Nodes\"\n$EndPhysicalNames\n" +
          kNodes2 +
          "$Elements\n5\n1 15 2 0 1 7\n2 1 2 0 1 7 9\n3 2 2 0 1 7 9 3\n4 4 0 7 3 9 5\n"
          "5 3 2 0 1 7 9 3 5\n$EndElements\n$NodeData\nnan\n$EndNodeData\n",
      std::string(kFormat4) + "$Entities\n0 0 0 0\n$EndEntities\n" + kNodes4 +
          "$Elements\n2 2 1 2\n2 1 2 1\n1 7 9 3\n3 1 4 1\n2 7 9 3 5\n$EndElements\n",
  };
  for (const std::string& variant : variants) {
    expect_reference_tetrahedron(make("variant.msh", variant));
    std::string dos;
    for (const char c : variant) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
    expect_reference_tetrahedron(make("dos.msh", dos));
  }
  // Tags belong to the nodes in their order.
  EXPECT_EQ(read_domain<3>(make("4.msh", variants.back())).cells,
            CellList<3>(Eigen::Vector4i(0, 1, 2, 3)));
}

TEST_F(MeshFile, MalformedGmsh) {
  const std::string format = kFormat2;
  const std::string nodes = kNodes2;
  const std::string elements = format + nodes + "$Elements\n";  // 11 lines
  expect_malformed(
      "d.msh",
      {{"", ":1: ", "not a Gmsh file"},
       {"$NOD\n4\n1 0 0 0\n", ":1: ", "version 1 is not supported; convert it by gmsh"},
       {"4 1 4\n0 0 0 1\n", ":1: ", "FreeFem: save it there by savegmsh()"},
       {std::string("\0\0\x01\xff garbage", 12), ":1: ", "not a Gmsh file"},
       {"$MeshFormat\n4 0 8\n$EndMeshFormat\n", ":2: ", "version \"4\" is not supported"},
       {std::string("$MeshFormat\n2.2 1 8\n\x01\0\0\n", 24), ":2: ", "binary"},
       {format, ":3: ", "no nodes"},
       {"$MeshFormat\n", ":1: ", "the file ends before its version"},
       {format + "Nodes\n", ":4: ", "expected the start of a section, found \"Nodes\""},
       {format + "$Physical\n1\n", ":5: ", "the file ends before \"$EndPhysical\""},
       {format + "$Nodes\n", ":4: ", "the file ends inside a section"},
       {format + "$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n", ":7: ", "expected \"$EndNodes\""},
       {format + nodes + nodes, ":11: ", "a second section $Nodes"},
       {format + nodes, ":10: ", "no tetrahedra"},
       {format + "$Nodes\n2000000000\n1 0 0 0\n", ":5: ", "too short"},
       {format + "$Nodes\n3\n1 0 0 0000000\n2 0 0 0000000\n", ":7: ", "after 2 of 3 nodes"},
       {format + "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", ":7: ", "node 1 occurs twice"},
       {elements + "1\n1 4 2 1 1 7 9 3 6\n$EndElements\n", ":13: ", "node 6, which does not exist"},
       {elements + "1\n1 5 0 7 9 3 5 7 9 3 5\n$EndElements\n", ":13: ", "type 5 are not supported"},
       {elements + "1\n1 2 0 7 9 3\n$EndElements\n", ":14: ", "no tetrahedra"},
       {std::string(kFormat4) + "$Nodes\n1 4 1 4\n3 1 0 900000000\n1\n", ":6: ", "too short"},
       {std::string(kFormat4) + kNodes4 + "$Elements\n1 1 1 1\n3 1 4 1\n2 7 9 3 8\n",
        ":20: ", "node 8, which does not exist"}});
}

}  // namespace
}  // namespace flbc::io
