// SPDX-License-Identifier: BSD-3-Clause
// Files of tetrahedral meshes with fields per vertex, and .vtu.
#include "format_test.h"

namespace flbc::testing {
namespace {

class TetMeshFile : public FormatTest {
 protected:
  static void expect_equal(const DomainMesh<3>& a, const DomainMesh<3>& b) {
    EXPECT_TRUE(bit_equal(a.points, b.points));
    EXPECT_EQ(a.cells, b.cells);
  }
  static void expect_equal(const std::vector<io::VertexField>& a,
                           const std::vector<io::VertexField>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_EQ(a[k].name, b[k].name);
      EXPECT_TRUE(bit_equal(a[k].values, b[k].values)) << a[k].name;
    }
  }
  std::string make_tetrahedron() const {
    io::write_domain<3>(path("d.mesh"), {Eigen::Matrix<double, 3, 4>::Identity().eval(),
                                         CellList<3>(Eigen::Vector4i(0, 1, 2, 3))});
    return path("d.mesh");
  }
};

TEST_F(TetMeshFile, BothVersionsOfGmsh) {
  const DomainMesh<3> mesh = awkward_mesh<3>();
  io::write_domain<3>(path("2.msh"), mesh);
  EXPECT_EQ(content("2.msh").substr(0, 16), "$MeshFormat\n2.2 ");
  expect_equal(io::read_domain<3>(path("2.msh")), mesh);

  // Two blocks of nodes, the tags of which are not in order.
  make("4.msh",
       "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities\n"
       "$Nodes\n2 4 1 4\n3 1 0 3\n1\n2\n4\n0 0 0\n1 0 0\n0 0 1\n3 1 0 1\n3\n0 1 0\n$EndNodes\n"
       "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n");
  Eigen::Matrix<double, 3, 4> points;
  points << 0, 1, 0, 0,  //
      0, 0, 0, 1,        //
      0, 0, 1, 0;
  expect_equal(io::read_domain<3>(path("4.msh")),
               {points, CellList<3>(Eigen::Vector4i(0, 1, 3, 2))});
}

TEST_F(TetMeshFile, SolutionsOfOthers) {
  make("d.sol",
       "MeshVersionFormatted\n2\n\nDimension\n3\n# by hand\nSolAtTetrahedra 1 1 1 5\n"
       "SolAtVertices\n4\n2 1 1\n1 2 3\n4 5 6 7 8\n\nEnd\n");
  std::vector<io::VertexField> fields;
  io::read_domain<3>(make_tetrahedron(), fields);
  expect_equal(fields, {{"solution 0", Eigen::Vector4d(1, 3, 5, 7)},
                        {"solution 1", Eigen::Vector4d(2, 4, 6, 8)}});
}

TEST_F(TetMeshFile, MalformedSolutions) {
  const auto mesh = make_tetrahedron();
  std::vector<io::VertexField> fields = {{"old", {}}};
  const std::string head = "MeshVersionFormatted 2\nDimension 3\n";
  expect_malformed(
      "d.sol", [&](const std::string&) { io::read_domain<3>(mesh, fields); },
      {{"", ":1: ", "MeshVersionFormatted"},
       {head, ":2: ", "no section SolAtVertices"},
       {"MeshVersionFormatted 2\nDimension 2\n", ":2: ", "the dimension is 2"},
       {head + "SolAtVertices\n5\n1 1\n1 2 3 4 5\n", ":4: ", "values for 5 vertices"},
       {head + "SolAtVertices\n4\n1 2\n1 2 3 4 5 6 7 8 9 10 11 12\n", ":5: ", "only scalars"},
       {head + "SolAtVertices\n4\n1 1\n1 2 3       \n", ":6: ", "after 3 of 4"},
       {head + "SolAtVertices\n4\n2000000000 1 1 1 1 1 1 1\n", ":5: ", "too short"},
       {head + "SolAtVertices\n-1\n", ":4: ", ""},
       {head + "7\n", ":3: ", "expected a keyword"}});
  EXPECT_EQ(fields.size(), 1u);
  EXPECT_EQ(io::read_domain<3>(mesh).num_cells(), 1);  // not an error without requested fields
}

TEST_F(TetMeshFile, MeditWritesBothFilesOrNone) {
  const auto mesh = awkward_mesh<3>();
  std::filesystem::create_directory(path("d.sol"));
  expect_error<IoError>(
      [&] {
        io::write_domain<3>(path("d.mesh"), mesh, {{"x", mesh.points.row(0)}});
      },
      {path("d.sol"), "Is a directory"});
  EXPECT_EQ(names(), std::vector<std::string>{"d.sol"});
}

// The parts of a .vtu file with the reference tetrahedron.
std::string vtu(const std::string& points, const std::string& cells, const std::string& rest = {}) {
  return "<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n"
         "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Points>\n" +
         points + "</Points>\n<Cells>\n" + cells + "</Cells>\n" + rest +
         "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}
const std::string kPoints =
    "<DataArray Name=\"P\" format=\"ascii\">0 0 0 1 0 0\n0 1 0 0 0 1</DataArray>\n";
const std::string kCells =
    "<DataArray Name=\"connectivity\">0 1 2 3</DataArray>\n"
    "<DataArray Name=\"offsets\">4</DataArray>\n<DataArray Name=\"types\">10</DataArray>\n";

TEST_F(TetMeshFile, VtuVariants) {
  expect_reference_tetrahedron(make("plain.vtu", vtu(kPoints, kCells)));
  // Another order, other quotes, comments, cells of the boundary, arrays that are no business here.
  expect_reference_tetrahedron(
      make("other.vtu",
           "<?xml version='1.0'?>\n<!DOCTYPE x>\n<!-- <VTKFile> -->\n"
           "<VTKFile type = 'UnstructuredGrid' note='a > b'>\n<UnstructuredGrid>\n"
           "<FieldData><DataArray format='binary'>AAAA</DataArray></FieldData>\r\n"
           "<Piece NumberOfCells=' 3 ' NumberOfPoints='4'>\r\n"
           "<CellData><DataArray Name='c' format='binary'>AAAA</DataArray></CellData>\n"
           "<PointData/>\n<Cells><DataArray Name='types'>5 10 1</DataArray>\n"
           "<DataArray Name='offsets'>3 7\n8</DataArray>\n<DataArray Name='faces'>1</DataArray>\n"
           "<DataArray Name='connectivity'>0 1 2\n0 1\n2 3 0</DataArray></Cells>\n"
           "<Points>" +
               kPoints + "</Points></Piece></UnstructuredGrid>\n<AppendedData>_\x01\x02<"));
}

TEST_F(TetMeshFile, VtuFieldsOfOthers) {
  const std::string file = make(
      "d.vtu",
      vtu(kPoints, kCells,
          "<PointData>\n<DataArray Name=\"&lt;&#65;&#x42;&apos;&gt;\">1 2 3\n4</DataArray>\n"
          "<DataArray Name=\"v\" NumberOfComponents=\"3\" format=\"appended\"/>\n</PointData>\n"));
  std::vector<io::VertexField> fields;
  io::read_domain<3>(file, fields);
  expect_equal(fields, {{"<AB'>", Eigen::Vector4d(1, 2, 3, 4)}});
}

TEST_F(TetMeshFile, MalformedVtu) {
  const auto replaced = [](std::string text, const std::string& what, const std::string& by) {
    const auto place = text.find(what);
    EXPECT_NE(place, std::string::npos) << what;
    return text.replace(place, what.size(), by);
  };
  const std::string good = vtu(kPoints, kCells);
  const std::string in_cells = ": cell 0: ";
  expect_malformed(
      "d.vtu", [](const std::string& file) { io::read_domain<3>(file); },
      {{"", ":1: ", "not a VTK file"},
       {std::string("\0\0\x01\xff garbage", 12), ":1: ", "not a VTK file"},
       {"<html/><VTKFile type=\"UnstructuredGrid\"/>", ":1: ", "not a VTK file"},
       {"<VTKFile type=\"PolyData\"/>", ":1: ", "\"PolyData\""},
       {"<VTKFile type=UnstructuredGrid>", ":1: ", "the XML is malformed"},
       {"<VTKFile\ntype=\"Unstr", ":2: ", "the XML is malformed"},
       {"<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid/></VTKFile>", ":1: ", "has no grid"},
       {replaced(good, "</Cells>", ""), ":13: ", "the XML is malformed"},
       {replaced(good, "NumberOfPoints", "Points"), ":3: ", "no attribute NumberOfPoints"},
       {replaced(good, "\"4\"", "\"four\""), ":3: ", "\"four\""},
       {replaced(good, "\"4\"", "\"2000000000\""), ":5: ", "has 12 numbers, not 6000000000"},
       {replaced(good, "ascii", "appended"), ":5: ", "ASCII"},
       {replaced(good, "\n0 1 0 0", "\n0 x 0 0"), ":6: ", "expected a number, found \"x\""},
       {replaced(good, "\n0 1 0 0", "\n0 1 0"), ":5: ", "has 11 numbers, not 12"},
       {replaced(good, ">0 1 2 3", ">0 1 2 4"), in_cells, "points are numbered 0 to 3"},
       {replaced(good, ">0 1 2 3", ">0 1 2 2"), ": ", "cell 0 of the domain mesh"},
       {replaced(good, ">4<", ">5<"), in_cells, "offset 5"},
       {replaced(good, ">4<", ">3<"), in_cells, "3 points, not 4"},
       {replaced(good, ">10<", ">12<"), in_cells, "type 12 are not supported"},
       {replaced(good, ">10<", ">5<"), ": ", "no cells"},
       {replaced(good, "\"types\"", "\"kinds\""), ":3: ", "\"types\""},
       {replaced(good, "</Piece>", "</Piece><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>"),
        ":13: ", "more than one piece"}});
  EXPECT_EQ(io::read_domain<3>(make("d.vtu", good)).num_cells(), 1);
}

}  // namespace
}  // namespace flbc::testing
