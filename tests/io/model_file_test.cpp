// SPDX-License-Identifier: BSD-3-Clause
// Model files whose vertices move, against OpenMesh's readers and writers.
#include "flbc/io/model_file.h"

#include <cmath>
#include <random>
#include <sstream>

#include "flbc/io/cage_io.h"
#include "support/model_kinds.h"

namespace flbc::testing {
namespace {

using io::ModelFile;
using OpenMesh::IO::Options;
using Phrases = std::vector<std::string>;

// All else stays, in files of any format.
TEST_F(ModelFileTest, FilesOfOpenMeshMoveAndBecomeAllOthers) {
  const auto mesh = box_with_attributes();
  for (const ModelKind& kind : kModelKinds) {
    const std::string name = kind.file;
    SCOPED_TRACE(name);
    write_kind(mesh, kind);
    const ModelFile file(path(name));
    const auto points = io::to_points<3>(file.model().soup, name);
    EXPECT_EQ(points, points_of(mesh));
    EXPECT_EQ(file.num_loose_normals(), 0);
    EXPECT_EQ(rewritten<3>(file, points), content(name));

    make(name, rewritten<3>(file, turned(points)));
    const auto model = file.moved<3>(turned(points));
    for (const std::string& output :
         {name, std::string("o.obj"), std::string("o.off"), std::string("o.ply")}) {
      SCOPED_TRACE(output);
      if (output != name) {
        io::write_model(path(output), model);
        EXPECT_EQ(io::losses(ModelFile(path(output)).model(), "any.ply"), Phrases());
      }
      const auto moved = read_by_openmesh(path(output), kind.attributes());
      EXPECT_EQ(points_of(moved), turned(points));
      expect_same_faces(moved, mesh);
      expect_same_paint(moved, mesh, kind.attributes());
      for (const auto v : mesh.vertices()) {
        EXPECT_LT((moved.normal(v) - turned(mesh.normal(v))).norm(), 1e-5) << "vertex " << v.idx();
      }
    }
    io::write_model(path("o.stl"), model);
    const auto triangles = read_by_openmesh(path("o.stl"), Options());
    EXPECT_EQ(triangles.n_vertices(), mesh.n_vertices());
    EXPECT_EQ(triangles.n_faces(), 11U);
  }
}

// A bent pair of polygons with normals of any direction and length, one of a polygon alone.
TEST_F(ModelFileTest, NormalsTurnWithTheirPolygons) {
  const ModelFile file = open("a.obj",
                              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0.5\nv 2 1 0.5\n"
                              "vn 0.1 -2 0.7\nvn 0 0 -3\nvn 1 1 1\n"
                              "f 1//2 2//1 3//1 4//2\nf 2//1 5//3 6//3 3//1\n");
  const auto points = io::to_points<3>(file.model().soup, "");
  const auto normals = file.model().attributes.normals;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2.5, Vector<3>(1, -2, 0.5).normalized()).toRotationMatrix();
  const PointList<3> rigid = (3 * turn * points).colwise() + Vector<3>(5, 6, 7);
  EXPECT_LT((file.moved<3>(rigid).attributes.normals - turn * normals).norm(), 1e-13);

  Eigen::Matrix3d shear;
  shear << 1, 0.5, 2,  //
      0, 3, -1,        //
      0.25, 0, 1.5;
  const auto sheared = file.moved<3>(shear * points).attributes.normals;
  EXPECT_LT((sheared.colwise().norm() - normals.colwise().norm()).norm(), 1e-13);
  const Vector<3> across = shear.inverse().transpose() * normals.col(1);
  EXPECT_LT((sheared.col(1) - 3 * across.normalized()).norm(), 1e-13);
  // A polygon that has lost its area turns nothing.
  PointList<3> flat = points;
  flat.row(0).setZero();
  flat.row(2).setZero();
  EXPECT_EQ(file.moved<3>(flat).attributes.normals, normals);
}

// Normals of any direction: on sharp corners, on a smooth surface, on a plane, and of a polygon.
TEST_F(ModelFileTest, NormalsAreCrossToWhatWasCrossToThem) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  std::string text;
  const auto row = [&](const char* word, const Vector<3>& v) {
    std::ostringstream out;
    out.precision(17);
    out << word << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
    text += out.str();
  };
  constexpr int kAround = 60, kRows = 40;
  for (int i = 0; i < kRows; ++i) {  // a smooth tube, bent a little
    for (int j = 0; j < kAround; ++j) {
      const double angle = 2 * M_PI * j / kAround, x = 5.0 * i / kRows;
      row("v ", {x, std::cos(angle) + 0.1 * x * x, std::sin(angle)});
      row("vn ", Vector<3>(number(random), number(random), number(random)));
    }
  }
  for (const double y : {-3, -4}) {  // a plane
    for (const double x : {0, 5}) {
      row("v ", {x, y, 0.5});
      row("vn ", Vector<3>(number(random), number(random), number(random)));
    }
  }
  const auto face = [&](std::initializer_list<int> corners) {
    text += "f";
    for (const int c : corners) text += " " + std::to_string(c + 1) + "//" + std::to_string(c + 1);
    text += "\n";
  };
  for (int i = 0; i + 1 < kRows; ++i) {
    for (int j = 0; j < kAround; ++j) {
      const int next = (j + 1) % kAround, k = kAround * i;
      face({k + j, k + next, k + kAround + next, k + kAround + j});
    }
  }
  constexpr int kPlane = kAround * kRows;
  face({kPlane, kPlane + 1, kPlane + 3, kPlane + 2});
  const ModelFile file = open("a.obj", text);
  const auto points = io::to_points<3>(file.model().soup, "");
  const auto& normals = file.model().attributes.normals;
  Eigen::Matrix3d stretch = Vector<3>(1, 1, 3).asDiagonal(), shear, mirror;
  shear << 1, 0.5, 2, 0, 3, -1, 0.25, 0, 1.5;
  mirror << 0.5, 1, 0, 0, -1, 0, 0.25, 0, 2;
  for (const Eigen::Matrix3d& map : {stretch, shear, mirror}) {
    const PointList<3> moved = (map * points).colwise() + Vector<3>(7, 8, 9);
    const auto turned = file.moved<3>(moved).attributes.normals;
    const Eigen::Matrix3d cofactors = map.determinant() * map.inverse().transpose();
    for (Eigen::Index k = 0; k < normals.cols(); ++k) {
      const Vector<3> expected = cofactors * normals.col(k);
      EXPECT_LT((turned.col(k).normalized() - expected.normalized()).norm(), 1e-3) << k;
      EXPECT_NEAR(turned.col(k).norm(), normals.col(k).norm(), 1e-12);
    }
  }
}

// Sections in any order; comments, indices after points, and unknown lines stay.
TEST_F(ModelFileTest, Su2MeshesKeepAllButTheirPoints) {
  const std::string elements = "NELEM=3\n5 0 1 2 0\n9 1 3 4 2 1\n10 0 1 2 3 2\n";
  const std::string marker =
      "NMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS = 2\n5 0 2 1\n3 1 0\nSEND_RECV= 0\n";
  const std::string other = "% made by hand\nFFD_CORNER_POINTS= 1\n0.5 0.5\n";
  const auto points_in = [](int dim, bool moves) {
    std::string text = "NPOIN= 5 5\n";
    for (int v = 0; v < 5; ++v) {
      for (int d = 0; d < dim; ++d) {
        text += std::to_string(v * v + 2 * d + (moves && d < 2 ? 8 : 0)) + "\t";
      }
      text += std::to_string(v) + "\n";
    }
    return text;
  };
  for (const int dim : {2, 3}) {
    const auto text = [&](bool comes_first, bool moves) {
      const auto points = points_in(dim, moves);
      return "NDIME= " + std::to_string(dim) + "\n" + (comes_first ? points : "") + elements +
             other + marker + (comes_first ? "" : points);
    };
    for (const bool comes_first : {false, true}) {
      const ModelFile file = open("a.su2", text(comes_first, false));
      const auto& soup = file.model().soup;
      using Polygons = std::vector<std::vector<Index>>;
      const Polygons in_2d{{0, 1, 2}, {1, 3, 4, 2}}, in_3d{{0, 2, 1}};
      EXPECT_EQ(soup.polygons, dim == 2 ? in_2d : in_3d);
      EXPECT_EQ(soup.points[3], Vector<3>(9, 11, dim == 2 ? 0 : 13));
      const PointList<2> points = io::to_points<3>(soup, "").topRows<2>();
      EXPECT_EQ(rewritten<2>(file, points), text(comes_first, false));
      EXPECT_EQ(rewritten<2>(file, points.array() + 8), text(comes_first, true));
    }
  }
  const auto refused = [&](const std::string& content, const std::string& words) {
    make("b.su2", content);
    expect_refused("b.su2:" + words, [&] { ModelFile(path("b.su2")); });
  };
  refused("NPOIN= 1\n0 0\n", "1: the number of dimensions (NDIME) must come first");
  refused("NDIME= 4\n", "1: ");
  refused("NDIME= 2\nNELEM= 1\n5 0 1 9\n" + points_in(2, false), "3: the index 9 is out of range");
  refused("NDIME= 2\nNELEM= 1\n7 0 1 9\n", "3: the type 7 of an element is unknown");
  refused("NDIME= 2\nNELEM= 5\n5 0 1 2\n", "");
  refused("NDIME= 2\n" + elements, "5: not an SU2 mesh: it has no points");
  refused("NDIME= 2\nNZONE= 2\n", "2: a mesh of several zones is not supported");
}

TEST_F(ModelFileTest, In2DZAndNormalsStay) {
  const auto mesh = flat_box_with_attributes();
  for (const ModelKind& kind : kModelKinds) {
    const std::string name = kind.file;
    SCOPED_TRACE(name);
    write_kind(mesh, kind);
    const ModelFile file(path(name));
    PointList<2> points = points_of(mesh).topRows<2>();
    EXPECT_EQ(rewritten<2>(file, points), content(name));
    points.row(0).array() += 2;
    make(name, rewritten<2>(file, points));
    const auto moved = read_by_openmesh(path(name), kind.attributes());
    EXPECT_EQ(points_of(moved).topRows<2>(), points);
    for (const auto v : mesh.vertices()) {
      EXPECT_EQ(moved.point(v)[2], 0.75);
      EXPECT_LT((moved.normal(v) - mesh.normal(v)).norm(), 1e-5);
    }
  }
}

TEST_F(ModelFileTest, StlKeepsItsTriangles) {
  for (const bool is_binary : {false, true}) {
    SCOPED_TRACE(is_binary);
    const auto name = write_stl("a.stl", is_binary);
    const ModelFile file(name);
    const auto before = read_by_openmesh(name, Options(Options::FaceNormal));
    const auto points = points_of(before);
    EXPECT_EQ(io::to_points<3>(file.model().soup, name), points);
    EXPECT_EQ(file.model().soup.polygons.size(), before.n_faces());
    EXPECT_EQ(file.model().is_text, !is_binary);
    EXPECT_EQ(rewritten<3>(file, points), content("a.stl"));
    make("a.stl", rewritten<3>(file, turned(points)));
    const auto after = read_by_openmesh(name, Options(Options::FaceNormal));
    EXPECT_EQ(points_of(after), turned(points));
    expect_same_faces(after, before);
    for (const auto f : before.faces()) {
      EXPECT_LT((after.normal(f) - turned(before.normal(f))).norm(), 1e-5);
    }
  }
}

// Vertices are numbered by first occurrence, coordinates are in single precision.
TEST_F(ModelFileTest, CornersOfStlMerge) {
  const auto facet = [](const std::string& a, const std::string& b, const std::string& c) {
    return "  FACET NORMAL 0 0 0\r\n outer loop\n vertex " + a + "\nvertex " + b + "\n\tvertex " +
           c + "\nendloop\nendfacet\n";
  };
  const auto text = "SOLID of someone\n" + facet("0 0 0", "1 0 0", "0 1 0") +
                    facet("-0 0 -0.0", "1.00000000001 0 0", "0 0 1") +
                    facet("0 0 1", "0 0 1e0", "2 2 2") + facet("1 0 0", "0.1 1e-30 0", "+0 1 0") +
                    "endsolid\n";
  const ModelFile file = open("odd.stl", text);
  EXPECT_EQ(file.model().soup.points,
            (std::vector<Vector<3>>{
                {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}, {0.1f, 1e-30f, 0}}));
  EXPECT_EQ(file.model().soup.polygons[2], (std::vector<Index>{3, 3, 4}));
  // Normals that are zero remain so, and one that would turn belongs to no area.
  EXPECT_EQ(file.num_loose_normals(), 1);
  PointList<3> points = io::to_points<3>(file.model().soup, "");
  points(2, 1) = 7;
  std::string expected = text;
  for (const std::string old : {"vertex 1 0 0", "vertex 1.00000000001 0 0", "vertex 1 0 0"}) {
    const auto place = expected.find(old);
    ASSERT_NE(place, std::string::npos);
    expected.replace(place + old.size() - 1, 1, "7");
  }
  EXPECT_EQ(rewritten<3>(file, points), expected);
}

// A program that divides by an area of zero writes them.
TEST_F(ModelFileTest, AttributesThatAreNotFiniteAreMissing) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.obj",
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan -nan(ind) nan\nvn 0 0 1\nvt inf 0\nvt 1 nan\n"
       "f 1/1/1 2/2/2 3/1/2\n"},
      {"a.off",
       "STCNOFF\n3 1 0\n0 0 0 nan nan nan nan 0 0 1 nan 0\n1 0 0 0 0 1 1 0 0 1 0 0\n"
       "0 1 0 0 0 1 1 0 0 1 0 0\n3 0 1 2\n"},
      {"a.stl",
       "solid\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
       "vertex 0 1 0\nendloop\nendfacet\nendsolid\n"}};
  for (const auto& [name, text] : files) {
    SCOPED_TRACE(name);
    const ModelFile file = open(name, text);
    const auto& model = file.model();
    EXPECT_EQ(model.soup.points.size(), 3U);
    EXPECT_TRUE(model.attributes.normals.allFinite());
    EXPECT_TRUE(model.attributes.texture_coordinates.allFinite());
    EXPECT_TRUE(model.attributes.colors.allFinite());
    const auto& others = model.others;
    EXPECT_EQ(std::count(others.begin(), others.end(), "attributes that are not finite"), 1);
    EXPECT_EQ(rewritten<3>(file, io::to_points<3>(model.soup, "")), text);
  }
}

TEST_F(ModelFileTest, OddStl) {
  const auto two_words = open("a.stl",
                              "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                              "vertex 1 0 0\nvertex 0 1 0\nend loop\nend facet\nEnd Solid a\n");
  EXPECT_EQ(two_words.model().soup.points.size(), 3U);
  // Binary, but beginning as a text.
  write_stl("a.stl", true);
  auto bytes = content("a.stl");
  bytes.replace(0, 5, "solid");
  const ModelFile file = open("b.stl", bytes);
  EXPECT_FALSE(file.model().is_text);
  EXPECT_EQ(io::to_points<3>(file.model().soup, ""),
            points_of(read_by_openmesh(path("a.stl"), Options())));
}

TEST_F(ModelFileTest, PlyMayHavePlusSignsAndBools) {
  const ModelFile file = open("a.ply",
                              "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                              "property bool b\nproperty float y\nproperty float z\nend_header\n"
                              "+1 1 -2 +3E+0\n");
  EXPECT_EQ(file.model().soup.points[0], Vector<3>(1, -2, 3));
}

TEST_F(ModelFileTest, PlyWithPropertiesInAnyOrder) {
  const std::string header =
      "ply\r\nformat ascii 1.0\ncomment by hand\nelement edge 1\nproperty int a\n"
      "element vertex 3\nproperty uchar blue\nproperty double z\nproperty list uchar float marks\n"
      "property float nz\nproperty uchar red\nproperty float x\nproperty float ny\n"
      "property float y\nproperty uchar green\nproperty float nx\nproperty uchar alpha\n"
      "property float quality\n"
      "element face 1\nproperty float area\nproperty list int int vertex_index\nend_header\n7\n";
  const ModelFile file = open("a.ply", header +
                                           "255 5.50 2 1 2 1 0 0 0 0 51 0 255 0.25\n"
                                           "0 5.50 0 1 255 1 0 0 0 0 254 1\n"
                                           "255 5.50 0 1 0 0 0 1 102 0 255 .125\n0.5 3 0 1 2\n");
  const auto& model = file.model();
  EXPECT_EQ(model.soup.points[1], Vector<3>(1, 0, 5.5));
  EXPECT_EQ(model.soup.polygons, (std::vector<std::vector<Index>>{{0, 1, 2}}));
  EXPECT_EQ(model.attributes.colors.col(0), Vector<3>(0, 0.2, 1));
  EXPECT_EQ(model.attributes.normals.col(2), Vector<3>(0, 0, 1));
  EXPECT_EQ(io::losses(model, "a.off"),
            (Phrases{"elements \"edge\"", "property \"marks\" of vertices",
                     "property \"quality\" of vertices", "transparency",
                     "property \"area\" of polygons", "comments"}));
  PointList<3> points(3, 3);  // turned about the x axis
  points << 0, 1, 0,          //
      -5.5, -5.5, -5.5,       //
      0, 0, 1;
  EXPECT_EQ(rewritten<2>(file, points.topRows<2>()),
            header +
                "255 5.50 2 1 2 1 0 0 0 -5.5 51 0 255 0.25\n"
                "0 5.50 0 1 255 1 0 -5.5 0 0 254 1\n"
                "255 5.50 0 1 0 0 0 -5.5 102 0 255 .125\n0.5 3 0 1 2\n");
  const auto turned = open("b.ply", rewritten<3>(file, points)).model();
  EXPECT_EQ(io::to_points<3>(turned.soup, ""), points);
  for (const auto& normal : turned.attributes.normals.colwise()) {
    EXPECT_LT((normal - Vector<3>(0, -1, 0)).norm(), 1e-14);
  }
  EXPECT_EQ(turned.attributes.colors, model.attributes.colors);
  EXPECT_EQ(turned.others, model.others);
}

TEST_F(ModelFileTest, CoordinatesThatHaveNoRoomAreNamed) {
  const auto ply = [&](const std::string& properties) {
    return open("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 1\n" + properties + "end_header\n1 2 3\n");
  };
  const PointList<3> point = PointList<3>::Constant(3, 1, 0.5);
  const auto refuse = [&](const ModelFile& file, const PointList<3>& to, const std::string& text) {
    expect_error<InputError>([&] { rewritten<3>(file, to); }, {text});
  };
  const auto whole = ply("property float x\nproperty int y\nproperty float z\n");
  refuse(whole, point, "coordinate y of vertex 0 cannot change: in the file it is an integer");
  const auto flat = ply("property float x\nproperty float y\nproperty float w\n");
  refuse(flat, point,
         "coordinate z of vertex 0 cannot change: in the file it is an integer or miss");
  expect_piece(rewritten<2>(flat, point.topRows<2>()), "\n0.5 0.5 3\n");
  refuse(flat, PointList<3>::Zero(3, 2), "the file has 1 vertices, but there are 2 points");

  write_by_openmesh(box_with_attributes(), path("b.ply"), Options(Options::Binary));
  const ModelFile binary(path("b.ply"));
  PointList<3> points = io::to_points<3>(binary.model().soup, "");
  points(1, 3) = 1e39;
  refuse(binary, points, "coordinate y of vertex 3 would be too large for the single precision");
  points(1, 3) = std::nan("");
  refuse(binary, points, "coordinate y of vertex 3 would not be finite");
}

// What other programs write and read.
TEST_F(ModelFileTest, FacesOfTwoVerticesAreEdges) {
  const std::vector<std::vector<Index>> edges{{0, 1}, {1, 2}, {2, 0}};
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 2 3\nf 3 1\n"},
      {"a.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n2 1 2\n2 2 0\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
       "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
       "0 0\n1 0\n0 1\n2 0 1\n2 1 2\n2 2 0\n"}};
  for (const auto& [name, bytes] : files) {
    SCOPED_TRACE(name);
    const auto soup = open(name, bytes).model().soup;
    EXPECT_EQ(soup.polylines, edges);
    EXPECT_TRUE(soup.polygons.empty());
  }
}

TEST_F(ModelFileTest, LinesMayEndWithACarriageReturn) {
  const std::string text =
      "ply\rformat ascii 1.0\relement vertex 3\rproperty float x\rproperty float y\r"
      "element face 1\rproperty list uchar int vertex_indices\rend_header\r"
      "0 0\r1 0\r0 1\r3 0 1 2\r";
  EXPECT_EQ(open("a.ply", text).model().soup.polygons.size(), 1u);
  const auto file = open("a.obj", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r");
  std::ostringstream out;
  PointList<3> moved(3, 3);
  moved << 5, 1, 0, 0, 0, 1, 0, 0, 0;
  file.write<3>(out, moved);
  EXPECT_EQ(out.str(), "v 5 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r");
}

TEST_F(ModelFileTest, AttributesThatAreNotInTheFileAreLeftOut) {
  const auto file = open("a.obj",
                         "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
                         "f 1/1/1 2/9/-4 3//7\n");
  const auto& model = file.model();
  ASSERT_EQ(model.attributes.corners.size(), 1u);
  const auto& corners = model.attributes.corners[0];
  EXPECT_EQ(corners[0].texture_coordinate, 0);
  EXPECT_EQ(corners[0].normal, 0);
  for (const int k : {1, 2}) {
    EXPECT_EQ(corners[k].texture_coordinate, -1);
    EXPECT_EQ(corners[k].normal, -1);
  }
  EXPECT_EQ(model.others,
            Phrases{"references to texture coordinates or normals that are not in the file"});
}

TEST_F(ModelFileTest, CornersOfObjReferToTextureCoordinatesAndNormals) {
  // Lists may follow their use, numbers count from 1 or backwards, and any of them may be missing.
  const auto found = open("a.obj", std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\n") +
                                       "vt 0.25 0.5\n vt 0.75\n"
                                       "f 1/1/2 2/2/2 3//1\n"  // the normals are still to come
                                       "vn 0 0 2\n"
                                       "f 1/-2 2 3/\n"
                                       "vt 1 1 1 # with a third coordinate\nvn 1 0 0\n")
                         .model()
                         .attributes;
  ASSERT_EQ(found.texture_coordinates.cols(), 3);
  EXPECT_EQ(found.texture_coordinates.col(0), Vector<2>(0.25, 0.5));
  EXPECT_EQ(found.texture_coordinates.col(1), Vector<2>(0.75, 0));
  EXPECT_EQ(found.texture_coordinates.col(2), Vector<2>(1, 1));
  ASSERT_EQ(found.normals.cols(), 2);
  EXPECT_EQ(found.normals.col(0), Vector<3>(0, 0, 2));
  ASSERT_EQ(found.corners.size(), 2);
  const auto expect_corner = [&](int polygon, int corner, Index texture, Index normal) {
    SCOPED_TRACE(corner);
    EXPECT_EQ(found.corners[polygon][corner].texture_coordinate, texture);
    EXPECT_EQ(found.corners[polygon][corner].normal, normal);
  };
  expect_corner(0, 0, 0, 1);
  expect_corner(0, 2, -1, 0);
  expect_corner(1, 0, 0, -1);
  expect_corner(1, 1, -1, -1);
  expect_corner(1, 2, -1, -1);
}

TEST_F(ModelFileTest, ColorsOfObjOnlyIfAllVerticesHaveThem) {
  const auto colors = [&](const std::string& text) {
    return open("a.obj", text).model().attributes.colors;
  };
  EXPECT_EQ(colors("v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 0 1 0 0 0 1 0.5\n"),
            (Eigen::Matrix3d{{1, 0, 0}, {0, 0.5, 0}, {0, 0, 1}}));
  for (const char* text :
       {"v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 0 1\n",
        "v 0 0 0 255 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 1\n", "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\n",
        "v 0 0 0 nan nan nan\nv 1 0 0 1 0 0\nv 0 1 0 0 inf 0\n"}) {
    EXPECT_EQ(colors(text).cols(), 0) << text;
  }
}

TEST_F(ModelFileTest, CoordinatesSurviveAllFormatsButStl) {
  io::Model model;
  auto& [points, polygons, polylines] = model.soup;
  for (const double number : awkward_numbers()) {
    points.emplace_back(number, 1, -7);
    points.emplace_back(0.25, number, 1e-5);
    points.emplace_back(-1, 3, number);
  }
  polygons = {{0, 1, 2}, {5, 4, 3, 0}, {6, 7, 8, 9, 10}};
  for (const bool is_text : {true, false}) {
    model.is_text = is_text;
    for (const std::string output : {"o.obj", "o.off", "o.ply"}) {
      SCOPED_TRACE(output);
      polylines.clear();
      if (output == "o.obj") polylines = {{0, 1}, {3, 2, 1, 3}};
      io::write_model(path(output), model);
      const auto written = ModelFile(path(output)).model();
      EXPECT_TRUE(bit_equal(io::to_points<3>(written.soup, ""), io::to_points<3>(model.soup, "")));
      EXPECT_EQ(written.soup.polygons, polygons);
      EXPECT_EQ(written.soup.polylines, polylines);
      EXPECT_TRUE(output != "o.ply" || written.is_text == is_text);
    }
  }
}

TEST_F(ModelFileTest, WhatIsLostIsTold) {
  const auto losses = [&](const std::string& text, const std::string& output) {
    return io::losses(open("a.obj", text).model(), output);
  };
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  EXPECT_EQ(losses(square + "f 1 2 3 4\n", "o.ply"), Phrases());
  EXPECT_EQ(losses(square + "f 1 2 3 4\n", "o.stl"),
            (Phrases{"the order of the vertices", "polygons (they are cut into triangles)"}));
  EXPECT_EQ(
      losses("# a\nmtllib m\n" + square + "usemtl x\ng y\nf 1 2 3\nf 1 3 4\nl 1 3\n", "o.off"),
      (Phrases{"lines with \"mtllib\"", "lines with \"usemtl\"", "lines with \"g\"", "comments",
               "polylines"}));
  // A seam: vertex 1 has two texture coordinates. Where two are the same there is none.
  const std::string paint = square + "vt 0 0\nvt 1 0\nvt 0 0\nvn 0 0 1\n";
  EXPECT_EQ(losses(paint + "f 1/1/1 2/2/1 3/2/1\nf 1/2/1 3/2/1 4/2/1\n", "o.ply"),
            (Phrases{"texture coordinates (they differ between corners of a vertex)"}));
  EXPECT_EQ(losses(paint + "f 1/1/1 2/2/1 3/2/1\nf 1/3/1 3/2/1 4/2/1\n", "o.ply"), Phrases());
  EXPECT_EQ(losses(paint + "f 1/1/1 2/2/1 3/2/1\nf 1/2/1 3/2/1 4/2/1\n", "o.obj"), Phrases());
  EXPECT_EQ(losses(paint + "f 1/1/1 2/2/1 3/2/1\nf 1/1 3/2 4/2\n", "o.off"),
            (Phrases{"normals (they differ between corners of a vertex)"}));
  const std::string coloured = "v 0.1 0 0 0.5 0 1\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n";
  EXPECT_EQ(losses(coloured, "o.ply"), (Phrases{"colors beyond 256 levels"}));
  EXPECT_EQ(losses(coloured, "o.obj"), Phrases());
  EXPECT_EQ(losses(coloured, "o.stl"), (Phrases{"the order of the vertices",
                                                "coordinates beyond single precision", "colors"}));
  const auto seen = open("a.off",
                         "COFF\n3 1 0\n0 0 0 255 0 0 128\n1 0 0 0 255 0 255\n"
                         "0 1 0 1 1 1 255\n3 0 1 2 255 0 0\n");
  EXPECT_EQ(io::losses(seen.model(), "o.ply"), (Phrases{"transparency", "colors of polygons"}));
  EXPECT_EQ(seen.model().attributes.colors.col(1), Vector<3>(0, 1, 0));
}

TEST_F(ModelFileTest, DefectsAreNamed) {
  const auto refuse = [&](const std::string& name, const std::string& bytes,
                          const std::string& text) {
    expect_error<InputError>([&] { open(name, bytes); }, {path(name), text});
  };
  refuse("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\n",
         ":6: a facet has fewer than 3 vertices");
  refuse("b.stl", std::string(80, ' ') + std::string("\2\0\0\0", 4) + std::string(50, '\0'),
         "the file ends after 1 of 2 triangles");
  refuse("a.ply",
         "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
         "end_header\n0 0\n1 a\n",
         ":8: expected a number, found \"a\"");
  refuse("b.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
         "the vertices have no x and y");
  const std::string point = "property float x\nproperty float y\nproperty float z\n";
  const std::string splats = "ply\nformat ascii 1.0\nelement vertex 1\n" + point;
  refuse("c.ply", splats + "property float scale_0\nproperty float f_dc_0\nend_header\n0 0 0 1 1\n",
         "the vertices have \"f_dc_0\" but no \"f_dc_1\"");
  refuse("d.ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty uint packed_position\n"
         "property uint packed_rotation\nend_header\n1 2\n",
         "export them uncompressed");
  for (const std::string bad : {"vt zero 0\n", "vn 0 1\n"}) {
    refuse("a.obj", "v 0 0 0\n" + bad, ":2: expected a number");
  }
  EXPECT_THROW(ModelFile(path("a.vtk")), OptionError);
  EXPECT_THROW(io::write_model(path("a.vtk"), io::Model{}), OptionError);
}

}  // namespace
}  // namespace flbc::testing
