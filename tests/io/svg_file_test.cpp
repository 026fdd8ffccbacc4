// SPDX-License-Identifier: BSD-3-Clause
// Outlines of drawings, judged by areas and boxes of the shapes in them.
#include <cmath>
#include <cstdlib>

#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "format_test.h"

namespace flbc::io {
namespace {

using flbc::testing::expect_error;
using flbc::testing::FormatTest;

const double kHalfTurn = std::acos(-1.0);

struct DrawnOutline {
  double area = 0;  // of holes negative
  int loops = 0;
  int holes = 0;
  Vector<2> low, high;
};

class SvgFile : public FormatTest {
 protected:
  void SetUp() override {
    FormatTest::SetUp();
    try {
      outline(R"svg(viewBox="0 0 9 9")svg", R"svg(<circle r="2"/>)svg");
    } catch (const InputError& error) {
      if (std::string(error.what()).find("install it") != std::string::npos) {
        GTEST_SKIP() << error.what();
      }
    }
  }

  // \param attributes  of the drawing
  DrawnOutline outline(const std::string& attributes, const std::string& content) {
    const auto soup =
        read_polygons(make("drawing.svg", R"svg(<svg xmlns="http://www.w3.org/2000/svg" )svg" +
                                              attributes + ">" + content + "</svg>"));
    const auto cage = std::get<Cage<2>>(to_cage(soup, ""));
    DrawnOutline result;
    result.low = cage.points.rowwise().minCoeff();
    result.high = cage.points.rowwise().maxCoeff();
    for (const auto& loop : soup.polylines) {
      EXPECT_EQ(loop.front(), loop.back());
      double area = 0;
      for (std::size_t k = 1; k < loop.size(); ++k) {
        const auto p = cage.points.col(loop[k - 1]), q = cage.points.col(loop[k]);
        area += 0.5 * (p.x() * q.y() - p.y() * q.x());
      }
      result.area += area;
      ++result.loops;
      result.holes += area < 0 ? 1 : 0;
    }
    return result;
  }
};

struct DrawingSample {
  std::string content;
  double area;
  int loops, holes;
};

TEST_F(SvgFile, AreasAreThoseOfTheShapes) {
  const DrawingSample samples[] = {
      {R"svg(<circle cx="50" cy="50" r="40"/>)svg", 1600 * kHalfTurn, 1, 0},
      {R"svg(<rect x="20" y="30" width="60" height="40" rx="10"/>)svg",
       2400 - (4 - kHalfTurn) * 100, 1, 0},
      {R"svg(<ellipse cx="50" cy="50" rx="30" ry="20" fill="white"/>)svg", 600 * kHalfTurn, 1, 0},
      {R"svg(<polygon points="10,10 90,10 50,90"/>)svg", 3200, 1, 0},
      // Relative commands: half a disc, and a square with a square hole.
      {R"svg(<path d="m10 50a40 40 0 0 1 80 0z"/>)svg", 800 * kHalfTurn, 1, 0},
      {R"svg(<path d="m10 10h80v80h-80zm20 20v40h40v-40z"/>)svg", 4800, 2, 1},
      {R"svg(<path fill-rule="evenodd" d="M10 10h80v80h-80zM30 30h40v40h-40z"/>)svg", 4800, 2, 1},
      {R"svg(<path d="M10 10h80v80h-80zM30 30h40v40h-40z"/>)svg", 6400, 1, 0},
      // Transforms of groups.
      {R"svg(<g transform="translate(50 50)"><g transform="rotate(30) scale(2 1)">)svg"
       R"svg(<rect x="-10" y="-10" width="20" height="20"/></g></g>)svg",
       800, 1, 0},
      {R"svg(<svg x="10" y="10" width="80" height="80" viewBox="0 0 8 8"><rect width="8" height="4"/></svg>)svg",
       3200, 1, 0},
      {R"svg(<defs><rect id="a" width="30" height="20"/></defs><use href="#a" x="5" y="5"/>)svg"
       R"svg(<use href="#a" x="60" y="60"/>)svg",
       1200, 2, 0},
      // Strokes and styles.
      {R"svg(<path d="M10 50h80" fill="none" stroke="red" stroke-width="10"/>)svg", 800, 1, 0},
      {R"svg(<circle cx="50" cy="50" r="30" fill="none" stroke="#000" stroke-width="10"/>)svg",
       kHalfTurn * (35 * 35 - 25 * 25), 2, 1},
      {R"svg(<style>.a{fill:none}</style><rect class="a" width="90" height="90"/>)svg"
       R"svg(<rect x="40" y="40" width="20" height="20"/>)svg",
       400, 1, 0},
      // Crossing parts are united; parts in front of others change nothing.
      {R"svg(<rect x="10" y="40" width="80" height="20"/><rect x="40" y="10" width="20" height="80"/>)svg",
       2800, 1, 0},
      {R"svg(<rect x="10" y="10" width="80" height="80"/><circle cx="50" cy="50" r="20" fill="#fff"/>)svg",
       6400, 1, 0},
      // A background is left out; a single shape that fills all is not.
      {R"svg(<path d="M0 0h100v100H0z"/><circle cx="50" cy="50" r="40" fill="#fff"/>)svg",
       1600 * kHalfTurn, 1, 0},
      {R"svg(<g><rect width="100" height="100"/></g><rect width="100%" height="100%"/>)svg"
       R"svg(<g><rect x="20" y="30" width="10" height="10" fill-opacity="0.3"/></g>)svg",
       100, 1, 0},
      {R"svg(<rect width="100" height="100"/>)svg", 10000, 1, 0},
  };
  for (const auto& sample : samples) {
    SCOPED_TRACE(sample.content);
    const auto found = outline(R"svg(viewBox="0 0 100 100")svg", sample.content);
    EXPECT_NEAR(found.area, sample.area, 6e-3 * sample.area);
    EXPECT_EQ(found.loops, sample.loops);
    EXPECT_EQ(found.holes, sample.holes);
  }
}

TEST_F(SvgFile, PlacesAreThoseOfTheDrawingWithTheYAxisUp) {
  const std::string shape = R"svg(<rect x="30" y="10" width="20" height="40"/>)svg";
  const auto expect_box = [&](const std::string& attributes, const Vector<2>& low,
                              const Vector<2>& high) {
    SCOPED_TRACE(attributes);
    const auto found = outline(attributes, shape);
    EXPECT_LT((found.low - low).norm(), 0.05);
    EXPECT_LT((found.high - high).norm(), 0.05);
  };
  expect_box(R"svg(viewBox="0 0 100 80")svg", {30, 30}, {50, 70});
  expect_box(R"svg(viewBox="0 0 100 80" width="10mm" height="8mm")svg", {30, 30}, {50, 70});
  expect_box(R"svg(viewBox="-10 -20 100 80")svg", {40, 10}, {60, 50});
  expect_box(R"svg(width="100" height="60")svg", {30, 10}, {50, 50});
  expect_box("", {30, 0}, {50, 40});  // the page ends where the ink does
  // A viewer cuts off a band at both sides.
  expect_box(
      R"svg(viewBox="0 0 80 80" width="80" height="40" preserveAspectRatio="xMidYMax slice")svg",
      {30, 30}, {50, 40});
}

// Fonts of few units, which librsvg may ask for in the size of their square.
TEST_F(SvgFile, TextHasAnOutline) {
  const auto text = [&](double size) {
    const auto side = std::to_string(size);
    return outline("viewBox=\"0 0 " + side + " " + side + "\"",
                   "<text font-size=\"" + std::to_string(0.8 * size) + "\" y=\"" +
                       std::to_string(0.8 * size) + "\">A</text>");
  };
  const auto large = text(1000);
  EXPECT_EQ(large.loops, 2);
  EXPECT_EQ(large.holes, 1);
  for (const double size : {24.0, 100.0}) {
    const auto other = text(size);
    EXPECT_EQ(other.loops, 2);
    EXPECT_NEAR(other.area / (size * size), large.area / 1e6, 0.01 * large.area / 1e6);
    EXPECT_LT((other.high / size - large.high / 1e3).norm(), 0.01);
  }
}

// Curves have as many corners as the tolerance needs, polygons only their own.
TEST_F(SvgFile, TheToleranceFollowsTheSize) {
  const auto corners_of = [&](double size, const std::string& content) {
    const auto side = std::to_string(size);
    make("drawing.svg", R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 )svg" + side +
                            " " + side + "\">" + content + "</svg>");
    return read_polygons(path("drawing.svg")).points.size();
  };
  const auto few = corners_of(1, R"svg(<circle cx="0.5" cy="0.5" r="0.3"/>)svg");
  EXPECT_EQ(few, corners_of(1000, R"svg(<circle cx="500" cy="500" r="300"/>)svg"));
  EXPECT_GT(few, 20U);
  EXPECT_LT(few, 80U);
  EXPECT_LE(corners_of(100, R"svg(<polygon points="10,10 90,20 50,90"/>)svg"), 6U);
}

// Lines next to each other do not cross when they are simplified.
TEST_F(SvgFile, NarrowGapsStayOpen) {
  std::string arcs;
  for (int k = 0; k < 12; ++k) {
    arcs += "<circle cx=\"50\" cy=\"50\" fill=\"none\" stroke=\"#000\" stroke-width=\"0.2\" r=\"" +
            std::to_string(20 + 0.3 * k) + "\"/>";
  }
  const auto found = outline(R"svg(viewBox="0 0 100 100")svg", arcs);
  EXPECT_EQ(found.loops, 24);
  EXPECT_EQ(found.holes, 12);
}

TEST_F(SvgFile, ErrorsNameTheFile) {
  const auto read = [&](const std::string& text) { read_polygons(make("drawing.svg", text)); };
  const std::string head = R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">)svg";
  expect_error<InputError>([&] { read("<svg"); }, {path("drawing.svg"), "not a drawing"});
  expect_error<InputError>([&] { read("v 0 0 0\n"); }, {path("drawing.svg"), "not a drawing"});
  expect_error<InputError>([&] { read(head + "<defs><path d='M0 0h9v9z'/></defs></svg>"); },
                           {path("drawing.svg"), "nothing is to be seen"});
  expect_error<InputError>([&] { read(head + "<text y='9' font-size='0.01'>a</text></svg>"); },
                           {"convert it to paths"});
  const std::string html = "<foreignObject width='9' height='9'/>";
  expect_error<InputError>([&] { read(head + html + "</svg>"); }, {"foreignObject", "left out"});
  EXPECT_EQ(
      ModelFile(make("a.svg", head + html + "<path d='M0 0h9v9z'/></svg>")).model().notes.size(),
      1U);
  const ModelFile file(make("b.svg", head + "<path d='M0 0h9v9z'/></svg>"));
  expect_error<OptionError>([&] { write_model(path("c.svg"), file.model()); },
                            {"write .glb, .ply, or .obj"});
}

}  // namespace
}  // namespace flbc::io
