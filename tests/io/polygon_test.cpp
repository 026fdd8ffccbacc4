// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/model_file.h"

#include "flbc/io/cage_io.h"
#include "format_test.h"

namespace flbc::io {
namespace {

using flbc::testing::expect_error;
using flbc::testing::FormatTest;
using Corners = std::vector<Index>;

class PolygonFile : public FormatTest {
 protected:
  PolygonSoup obj(const std::string& content) { return read_polygons(make("soup.obj", content)); }
  PolygonSoup off(const std::string& content) { return read_polygons(make("soup.off", content)); }
};

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";  // 3 lines

TEST_F(PolygonFile, ObjCorners) {
  const PolygonSoup soup = obj(std::string(kTriangle) +
                               "f 1 2 3\nf 1/1 2/2 3/3\nf 1/1/1 2/2/2 3/3/3\nf 1//4 2//4 3//4\n"
                               "f -3 -2 -1\nv 5 5 5\nf -1/-1/-1 -2//-1 -4/-2\nl 1/1 -1 2\n");
  EXPECT_EQ(soup.polygons, (std::vector<Corners>{
                               {0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {3, 2, 0}}));
  EXPECT_EQ(soup.polylines, (std::vector<Corners>{{0, 3, 1}}));
  // Before their vertices.
  EXPECT_EQ(obj(std::string("f 1 2 3\n") + kTriangle).polygons, (std::vector<Corners>{{0, 1, 2}}));
}

TEST_F(PolygonFile, ObjVertices) {
  const PolygonSoup soup =
      obj("v 1 2\nv 1 2 3\nv 1 2 3 1.0\nv 1 2 3 0.5 0.5 0.5\n\tv  +1\t2. \t3e0 # comment\n"
          "v 1e-400 -1e-99999999999999999999 0.0e999\n");
  ASSERT_EQ(soup.points.size(), 6u);
  EXPECT_EQ(soup.points[0], Vector<3>(1, 2, 0));
  for (std::size_t v = 1; v < 5; ++v) EXPECT_EQ(soup.points[v], Vector<3>(1, 2, 3)) << v;
  EXPECT_EQ(soup.points[5], Vector<3>(0, 0, 0));
}

TEST_F(PolygonFile, ObjIgnoresOtherLines) {
  const PolygonSoup soup =
      obj(std::string("\xEF\xBB\xBF# caf\xC3\xA9\nmtllib a b.mtl\no name\n") + kTriangle +
          "vn nan 0 1\nvt 0 0\nvp 1\ns off\nusemtl x\ng\np 1\n" + "f 1 2 3\ncurv2 1 2\n");
  EXPECT_EQ(soup.points.size(), 3u);
  EXPECT_EQ(soup.polygons.size(), 1u);
}

TEST_F(PolygonFile, ObjLinesMayEndInCrlfOrGoOn) {
  const PolygonSoup soup =
      obj("v 0 0 0\r\nv 1 \\\r\n0 0\r\nv 0 1\\\n 0\r\n\r\n"
          "f 1 \\\r\n 2 \\\n 3\r\nl 1 2\\\n\nl 2 3\\");
  EXPECT_EQ(soup.points, (std::vector<Vector<3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(soup.polygons, (std::vector<Corners>{{0, 1, 2}}));
  EXPECT_EQ(soup.polylines, (std::vector<Corners>{{0, 1}, {1, 2}}));
}

TEST_F(PolygonFile, NothingIsRepaired) {
  const PolygonSoup soup = obj(std::string(kTriangle) + "v 0 0 0\nf 1 1 2\nf 1 2 3\nf 1 2 3\n");
  EXPECT_EQ(soup.points.size(), 4u);
  EXPECT_EQ(soup.polygons, (std::vector<Corners>{{0, 0, 1}, {0, 1, 2}, {0, 1, 2}}));
}

TEST_F(PolygonFile, MalformedObj) {
  const std::string triangle = kTriangle;
  expect_malformed(
      "soup.obj", read_polygons,
      {
          {"", ":1: ", "without a vertex"},
          {std::string("\0\xff\xfe\x01 v\0 garbage\n\x80\n", 18), ":2: ", "without a vertex"},
          {"v 0 0 0\nv abc 0 0\n", ":2: ", "expected a number, found \"abc\""},
          {"v 0 0 nan\n", ":1: ", "expected a finite number, found \"nan\""},
          {"v 0 0 1e999\n", ":1: ", "the number \"1e999\" is too large"},
          {"v 0 0 " + std::string(100000, 'z'), ":1: ", std::string(40, 'z') + "...\""},
          {triangle + "f 1\n", ":4: ", "a face needs at least 2 vertices, found 1"},
          {triangle + "cstype bezier\nsurf 0 1 0 1 1 \\\n2 3\n", ":5: ", "export polygons"},
          {triangle + "l 1\n", ":4: ", "a polyline needs at least 2 vertices, found 1"},
          {triangle + "f 1 2 4\n",
           ":4: ", "the index 4 is out of range; vertices are numbered 1 to 3"},
          {"f 1 2 3\nf 9 1 2\nf 7 1 2\n" + triangle, ":2: ", "the index 9 is out of range"},
          {triangle + "f 1 2 -4\n",
           ":4: ", "the index \"-4\" is out of range; there are 3 vertices"},
          {triangle + "f 0 1 2\n", ":4: ", "the index 0 is out of range"},
          {triangle + "f 1 2 99999999999\n", ":4: ", "\"99999999999\" is out of range"},
          {triangle + "f 1 2 x\n", ":4: ", "expected a vertex index, found \"x\""},
          {triangle + "f 1 2 3/1/1/1\n", ":4: ", "expected a vertex index, found \"3/1/1/1\""},
          {triangle + "f 1 \\\n 2 \\\n x\n", ":6: ", "expected a vertex index, found \"x\""},
      });
}

TEST_F(PolygonFile, OffVariants) {
  const std::vector<Vector<3>> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Corners> polygons = {{0, 1, 2, 3}, {2, 1, 0}};
  const std::string faces = "4 0 1 2 3\n3 2 1 0\n";
  const std::vector<std::string> variants = {
      "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces,
      "OFF 4 2 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3\r\n3 2 1 0",
      "# first\n\nOFF # header\n# counts\n4 2\n\n0 0 0\n1 0 0 # second\n1 1 0\n\n0 1 0\n" + faces,
      "COFF\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 9 9 9 9\n1 1 0 1 1 1 1\n0 1 0 0 0 0 0\n" + faces,
      "NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n" + faces,
      "STOFF\n4 2 0\n0 0 0 .1 .2\n1 0 0 0 0\n1 1 0 0 1\n0 1 0 0 1\n" + faces,
      "STCNOFF\n4 2 0\n0 0 0 0 0 1 .5 .5 .5 1 .1 .2\n1 0 0 0 0 1 .5 .5 .5 1 .1 .2\n"
      "1 1 0 0 0 1 .5 .5 .5 1 .1 .2\n0 1 0 0 0 1 .5 .5 .5 1 .1 .2\n" +
          faces,
      "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 0.5 0.5 0.5\n3 2 1 0 7\n",
      "OFF4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces,
      "4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces,
      "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + faces + "made by a program\n",
      "OFF\r4 2 0\r0 0 0\r1 0 0\r1 1 0\r0 1 0\r4 0 1 2 3\r3 2 1 0\r",
  };
  for (const std::string& variant : variants) {
    const PolygonSoup soup = off(variant);
    EXPECT_EQ(soup.points, points) << variant;
    EXPECT_EQ(soup.polygons, polygons) << variant;
  }
}

TEST_F(PolygonFile, MalformedOff) {
  const std::string head = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";  // 5 lines
  expect_malformed(
      "soup.off", read_polygons,
      {
          {"", ":1: ", "it is empty"},
          {std::string("\0\xff\xfe\x01 garbage\n", 13), ":1: ", "not an OFF file"},
          {"ON\n", ":1: ", "expected OFF, found \"ON\""},
          {"OFFX 3 1 0\n", ":1: ", "expected OFF, found \"OFFX\""},
          {"4OFF\n", ":1: ", "\"4OFF\" is not supported"},
          {"OFF BINARY\n1234", ":1: ", "binary OFF"},
          {"OFF\n", ":1: ", "the file ends before the number of vertices"},
          {"OFF\n2000000000 1 0\n0 0 0\n",
           ":2: ", "2000000000 vertices are declared, but the file"},
          {"OFF\n3 1 0\n0 0 0   \n1 0 0   \n", ":4: ", "the file ends after 2 of 3 vertices"},
          {head, ":5: ", "the file ends after 0 of 1 faces"},
          {head + "3 0 1 3\n", ":6: ", "the index 3 is out of range; vertices are numbered 0 to 2"},
          {head + "1 0\n", ":6: ", "at least 2 vertices, found 1"},
          {head + "1000000000 0 1 2\n", ":6: ", "1000000000 corners are declared, but the file"},
          {head + "3 0 1 2\n\n3 2 1 0\n",
           ":8: ", "expected the end of the file after the last face"},
      });
}

TEST_F(PolygonFile, FilesThatCannotBeOpened) {
  expect_unopenable({"obj", "off", "ply", "stl"}, read_polygons, [](const auto& file) {
    write_model(file, {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}}});
  });
}

TEST_F(PolygonFile, PointsThatAreNotFiniteAreNotWritten) {
  for (const char* name : {"soup.obj", "soup.off"}) {
    const PolygonSoup soup{{Vector<3>(0, 1.0 / 0.0, 0)}, {}, {}};
    expect_error<InputError>([&] { write_model(path(name), {soup}); }, {"not finite"});
  }
  EXPECT_TRUE(names().empty());
}

}  // namespace
}  // namespace flbc::io
