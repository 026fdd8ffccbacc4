// SPDX-License-Identifier: BSD-3-Clause
// Drawings that are moved, judged by the curves that they have before and after.
#include "model/svg_document.h"

#include <gtest/gtest.h>

#include <cmath>
#include <pugixml.hpp>
#include <string>

#include "flbc/errors.h"
#include "model/svg_path.h"
#include "support/errors.h"

namespace flbc::io {
namespace {

using flbc::testing::expect_refused;

constexpr double kSize = 200;
constexpr double kTolerance = 5e-4 * kSize;

// With the y axis down, as in the file.
SvgDocument document_of(const std::string& content, const std::string& attributes = "") {
  const auto text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 200 200\"" +
                    attributes + ">" + content + "</svg>";
  return {text, "drawing.svg", {kSize, kSize}, Eigen::Affine2d::Identity()};
}

// The curves of a document as they are in it, without transforms, by the id of their element.
Path path_in(const std::string& text, const std::string& id) {
  pugi::xml_document document;
  document.load_buffer(text.data(), text.size());
  const auto query = "//*[@id='" + id + "']";
  const auto node = document.select_node(query.c_str()).node();
  bool is_whole = false;
  const auto path = parse_path(node.attribute("d").value(), is_whole);
  EXPECT_TRUE(is_whole && !path.empty()) << text;
  return path;
}

template <class Map>
PointList<2> mapped(const PointList<2>& points, const Map& map) {
  PointList<2> moved = points;
  for (auto column : moved.colwise()) column = map(Vector<2>(column));
  return moved;
}

// The upper half turns by 35 degrees, the farther up the more.
Vector<2> bent(const Vector<2>& p) {
  const Vector<2> middle(100, 110), offset = p - middle;
  const double part = std::clamp(-offset.y() / 90, 0.0, 1.0);
  const double angle = 35 * std::acos(-1.0) / 180 * part * part * (3 - 2 * part);
  return middle + Eigen::Rotation2D<double>(angle) * offset;
}

double distance_to(const Path& path, const Vector<2>& point) {
  double nearest = 1e300;
  for (const auto& part : path) {
    for (const auto& cubic : part.cubics) {
      Vector<2> before = cubic.first();
      for (int k = 1; k <= 64; ++k) {
        const Vector<2> next = cubic.at(k / 64.0), along = next - before;
        const double length = along.squaredNorm();
        const double t =
            length > 0 ? std::clamp(along.dot(point - before) / length, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, (before + t * along - point).norm());
        before = next;
      }
    }
  }
  return nearest;
}

std::size_t count_cubics(const Path& path) {
  std::size_t count = 0;
  for (const auto& part : path) count += part.cubics.size();
  return count;
}

constexpr const char* kHead =
    "M100 20C150 20 180 60 180 110S150 190 100 190 20 160 20 110 50 20 100 20Z";
constexpr const char* kMouth = "M60 140q40 40 80 0";

TEST(SvgDocumentTest, GeometryStaysInEveryTransform) {
  const std::string shapes =
      R"svg(<path id="a" d="M100 20C150 20 180 60 180 110S150 190 100 190 20 160 20 110Z"/>
      <g transform="translate(30 40) rotate(20) scale(1.5 .7)"><path id="b" d="m10 10h20v20a5 9 30 1 0 -9 4z"/></g>)svg";
  const Eigen::Affine2d map(Eigen::Translation2d(7, -3));  // with the same box
  for (const auto& one : {Eigen::Affine2d(Eigen::Affine2d::Identity()), map}) {
    const auto document = document_of(shapes);
    const auto rest = document.points();
    const auto text = document.moved(mapped(rest, [&](const Vector<2>& p) { return one * p; }));
    EXPECT_LT((document.points() - rest).cwiseAbs().maxCoeff(), 1e-12);
    const SvgDocument again(text, "", {kSize, kSize}, Eigen::Affine2d::Identity());
    ASSERT_EQ(again.points().cols(), rest.cols()) << text;
    EXPECT_LT((again.points() - one * rest).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(SvgDocumentTest, AffineMapsKeepTheNumberOfCubics) {
  const auto document = document_of("<path id=\"head\" d=\"" + std::string(kHead) + "\"/>");
  Eigen::Matrix2d map;
  map << 1.3, 0.5, -0.2, 0.8;
  const auto text = document.moved(map * document.points());
  bool is_whole = false;
  const auto rest = parse_path(kHead, is_whole), moved = path_in(text, "head");
  ASSERT_EQ(count_cubics(moved), count_cubics(rest));
  for (std::size_t k = 0; k < count_cubics(rest); ++k) {
    const Eigen::Matrix<double, 2, 4> expected = map * rest[0].cubics[k].points;
    EXPECT_LT((moved[0].cubics[k].points - expected).cwiseAbs().maxCoeff(), 1e-3) << text;
  }
}

TEST(SvgDocumentTest, BentCurvesAreWithinTheToleranceAndSmooth) {
  const auto document = document_of("<path id=\"head\" d=\"" + std::string(kHead) +
                                    "\"/><path id=\"mouth\" d=\"" + kMouth + "\"/>");
  const auto text = document.moved(mapped(document.points(), bent));
  bool is_whole = false;
  std::size_t before = 0, after = 0;
  for (const auto& [id, d] : {std::pair("head", kHead), std::pair("mouth", kMouth)}) {
    const auto rest = parse_path(d, is_whole), moved = path_in(text, id);
    for (const auto& cubic : rest[0].cubics) {
      for (int k = 0; k <= 100; ++k) {
        EXPECT_LT(distance_to(moved, bent(cubic.at(k / 100.0))), 1.1 * kTolerance) << id;
      }
    }
    before += count_cubics(rest);
    after += count_cubics(moved);
    const auto& cubics = moved[0].cubics;
    for (std::size_t k = 0; k + 1 < cubics.size(); ++k) {
      const Vector<2> in = cubics[k].points.col(3) - cubics[k].points.col(2);
      const Vector<2> out = cubics[k + 1].points.col(1) - cubics[k + 1].points.col(0);
      EXPECT_GT(in.normalized().dot(out.normalized()), std::cos(std::acos(-1.0) / 180)) << id << k;
    }
  }
  EXPECT_LE(after, 2 * before);
}

TEST(SvgDocumentTest, EveryShapeBecomesAPathOfItsOutline) {
  // Lengths and areas of the shapes, which the curves must have.
  struct Case {
    const char* shape;
    double length;
  };
  const double turn = 2 * std::acos(-1.0);
  const Case cases[] = {
      {R"svg(<rect id="s" x="10" y="20" width="30" height="40"/>)svg", 140},
      {R"svg(<rect id="s" x="10" y="20" width="30" height="40" rx="5"/>)svg", 140 - 40 + 5 * turn},
      {R"svg(<circle id="s" cx="50" cy="60" r="20"/>)svg", 20 * turn},
      {R"svg(<ellipse id="s" cx="5cm" cy="60" rx="20" ry="20"/>)svg", 20 * turn},
      {R"svg(<line id="s" x1="10%" y1="0" x2="40" y2="20"/>)svg", std::sqrt(800.0)},
      {R"svg(<polyline id="s" points="0,0 30,0 30,40"/>)svg", 70},
      {R"svg(<polygon id="s" points="0 0 30 0 30 40"/>)svg", 120}};
  for (const auto& [shape, length] : cases) {
    const auto document = document_of(
        std::string(shape).insert(std::string(shape).find("id="), "class=\"mine\" data-x=\"1\" "));
    const auto text = document.moved(document.points());
    EXPECT_NE(text.find("<path class=\"mine\" data-x=\"1\" id=\"s\" d=\""), std::string::npos)
        << text;
    double found = 0;
    for (const auto& part : path_in(text, "s")) {
      for (const auto& cubic : part.cubics) {
        for (int k = 0; k < 256; ++k) {
          found += (cubic.at((k + 1) / 256.0) - cubic.at(k / 256.0)).norm();
        }
      }
    }
    EXPECT_NEAR(found, length, 1e-3 * length) << text;
  }
}

// SVG 1.1, F.6.2, for a radius of zero; radii at the ends of the range of numbers overflow.
TEST(SvgDocumentTest, ArcsWithoutUsableRadiiAreLines) {
  for (const char* arc :
       {"M10 20a0 5 0 0 0 30 40", "M10 20a5 0 30 1 0 30 40", "M10 20a0 0 0 0 1 30 40",
        "M10 20a1e-320 5 0 0 0 30 40", "M10 20a1e-320 1e-320 0 1 1 30 40",
        "M10 20a5 1e308 0 0 0 30 40", "M10 20a1e308 1e308 0 0 1 30 40"}) {
    bool is_whole = false;
    const auto path = parse_path(arc, is_whole);
    ASSERT_EQ(count_cubics(path), 1U) << arc;
    EXPECT_TRUE(is_whole && path[0].cubics[0].is_line) << arc;
    EXPECT_EQ(path[0].cubics[0].first(), Vector<2>(10, 20)) << arc;
    EXPECT_EQ(path[0].cubics[0].last(), Vector<2>(40, 60)) << arc;
  }
  // Between points whose difference overflows there is no arc.
  bool is_whole = false;
  parse_path("M1e308 0A1 1 0 0 0-1e308 0a1 1 0 0 0 1e308 9", is_whole);
  EXPECT_TRUE(is_whole);
}

TEST(SvgDocumentTest, EverythingElseStays) {
  const std::string content =
      R"svg(<!-- my drawing --><style>.a &gt; .b { fill: red }</style><script>run()</script>
  <defs><linearGradient id="g" gradientUnits="userSpaceOnUse" x2="9"><stop offset="0"/></linearGradient></defs>
  <g id="layer1" inkscape:label="Ink &amp; more" style="opacity:.5"><path id="p" d="M0 0L50 60" fill="url(#g)"/></g>
  <text id="t" x="9" y="9">&#228;</text>)svg";
  const auto document = document_of(content);
  const auto text = document.moved(document.points());
  for (const char* piece :
       {"<!-- my drawing -->", "<style>.a &gt; .b { fill: red }</style>", "<script>run()</script>",
        R"svg(<g id="layer1" inkscape:label="Ink &amp; more" style="opacity:.5">)svg", "&#228;",
        R"svg(d="M0 0L50 60" fill="url(#g)")svg"}) {
    EXPECT_NE(text.find(piece), std::string::npos) << piece << text;
  }
  EXPECT_EQ(document.notes().size(), 1U);
  EXPECT_EQ(document.element_of(0), "path 'p'");
}

TEST(SvgDocumentTest, CopiesAndClipsBendWhereTheyAre) {
  const auto document = document_of(
      R"svg(<defs><circle id="eye" r="9"/><clipPath id="c"><rect width="50" height="50"/></clipPath></defs>
      <use href="#eye" x="60" y="60"/><use href="#eye" x="140" y="60"/>
      <path clip-path="url(#c)" d="M0 0L90 90"/><path transform="translate(9)" clip-path="url(#c)" d="M0 0L90 90"/>)svg");
  const auto text = document.moved(mapped(document.points(), bent));
  EXPECT_EQ(text.find("<use"), std::string::npos);
  EXPECT_NE(text.find("<circle id=\"eye\" r=\"9\"/>"), std::string::npos) << text;
  EXPECT_NE(text.find("url(#c-2)"), std::string::npos) << text;
  EXPECT_NE(text.find("<clipPath id=\"c-2\">"), std::string::npos) << text;
}

// Each copy of such a clip would need the next one.
TEST(SvgDocumentTest, ClipsInsideThemselvesAreNotCopied) {
  const auto document = document_of(
      R"svg(<clipPath id="c"><path transform="translate(9)" clip-path="url(#d)" d="M0 0h9v9z"/></clipPath>
      <clipPath id="d"><path transform="translate(9)" clip-path="url(#c)" d="M0 0h9v9z"/></clipPath>
      <path clip-path="url(#c)" d="M0 0L90 90"/><path transform="translate(9)" clip-path="url(#d)" d="M0 0L90 90"/>)svg");
  const auto text = document.moved(mapped(document.points(), bent));
  EXPECT_LT(text.size(), 3000U) << text;
}

TEST(SvgDocumentTest, TextMovesByTheSimilarityOfItsPlace) {
  const auto document = document_of(R"svg(<text x="50" y="50" font-size="20">a</text>)svg");
  Eigen::Affine2d map = Eigen::Translation2d(5, 6) * Eigen::Rotation2D<double>(0.5);
  const auto text =
      document.moved(mapped(document.points(), [&](const Vector<2>& p) { return map * p; }));
  const SvgDocument again(text, "", {kSize, kSize}, Eigen::Affine2d::Identity());
  EXPECT_LT((again.points() - map * document.points()).cwiseAbs().maxCoeff(), 1e-6) << text;
  ASSERT_EQ(document.notes().size(), 1U);
  EXPECT_NE(document.notes()[0].find("convert it to paths"), std::string::npos);
}

TEST(SvgDocumentTest, BadDrawings) {
  const auto read = [](const std::string& text) {
    return SvgDocument(text, "x.svg", {9, 9}, Eigen::Affine2d::Identity());
  };
  expect_refused("x.svg: not XML", [&] { read("<svg"); });
  expect_refused("the first element is <html>", [&] { read("<html/>"); });
  expect_refused("no shapes", [&] { read("<svg><g/></svg>"); });
  // What is drawn before the error stays (SVG 1.1, appendix F.2).
  const auto cut = document_of(R"svg(<path id="p" d="M0 0 L9 9 L8 q 7"/>)svg");
  EXPECT_EQ(count_cubics(path_in(cut.moved(cut.points()), "p")), 1U);
  EXPECT_EQ(cut.notes().size(), 1U);
  // A drawing that shows itself, and one of 2^40 copies.
  document_of(R"svg(<g id="a"><path d="M0 0h9"/><use href="#a"/></g>)svg");
  std::string many = R"svg(<path id="a0" d="M0 0h9"/>)svg";
  for (int k = 1; k < 41; ++k) {
    const auto use = "<use href=\"#a" + std::to_string(k - 1) + "\"/>";
    many += "<g id=\"a" + std::to_string(k) + "\">" + use + use + "</g>";
  }
  expect_refused("repeats too much", [&] { document_of(many); });
  std::string deep, ends;
  for (int k = 0; k < 10000; ++k) deep += "<g>", ends += "</g>";
  EXPECT_GT(document_of(deep + "<path d=\"M0 0h9\"/>" + ends).points().cols(), 1);
}

}  // namespace
}  // namespace flbc::io
