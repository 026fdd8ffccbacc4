// SPDX-License-Identifier: BSD-3-Clause
#include "draw/canvas.h"
#include "draw/isolines.h"
#include "draw/layout.h"
#include "draw/plane_picture.h"
#include "front/colormap.h"
#include "support/png_image.h"
#include "support/test.h"

namespace flbc::draw {
namespace {

constexpr Color kPaper{1, 1, 1};
constexpr Color kBlack{0, 0, 0};
constexpr double kPi = 3.14159265358979323846;

double difference(Color a, Color b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

// The area covered by black on white, in pixels.
double darkness(const Image& image) {
  double sum = 0;
  for (const Color& pixel : image.pixels) sum += 1 - pixel.g;
  return sum;
}

// Pure red is on no scale of weights.
bool is_highlight(Color color) {
  return color.r > 0.85 && color.g < 0.15 && color.b < 0.15;
}

// The box [0, size], whose edges are cut into n pieces each.
template <int Dim>
testing::Sample<Dim> box(const Vector<Dim>& size, Index n) {
  auto sample = testing::make_sample<Dim>(testing::Shape::kBox, n);
  sample.cage.points = size.asDiagonal() * sample.cage.points;
  sample.mesh.points = size.asDiagonal() * sample.mesh.points;
  return sample;
}

template <int Dim>
Eigen::VectorXd evaluate(const DomainMesh<Dim>& mesh,
                         const std::function<double(const Vector<Dim>&)>& function) {
  Eigen::VectorXd values(mesh.num_vertices());
  for (Index v = 0; v < mesh.num_vertices(); ++v) values[v] = function(mesh.points.col(v));
  return values;
}

double length(const std::vector<Segment>& segments) {
  double sum = 0;
  for (const Segment& segment : segments) sum += (segment.b - segment.a).norm();
  return sum;
}

WeightPictureOptions without_lines() {
  WeightPictureOptions options;
  options.width = 400;
  options.isolines = 0;
  options.support_level = 0;
  options.color_bar = false;
  return options;
}

// ---------------------------------------------------------------------------------------- Canvas

TEST(Raster, TrianglesOfAMeshPaintEachSampleOnce) {
  // Corners at sixths lie exactly on samples or on rows of samples: the difficult cases.
  std::mt19937 random(7);
  constexpr int kCells = 8;
  constexpr int kSize = 40;
  PointList<2> points(2, (kCells + 1) * (kCells + 1));
  for (int j = 0, k = 0; j <= kCells; ++j) {
    for (int i = 0; i <= kCells; ++i, ++k) {
      const bool inner = i > 0 && j > 0 && i < kCells && j < kCells;
      const auto shift = [&] { return inner ? static_cast<double>(random() % 7) / 6 - 0.5 : 0.0; };
      points(0, k) = i * kSize / kCells + shift();
      points(1, k) = j * kSize / kCells + shift();
    }
  }
  Raster raster(points, kSize, kSize);
  int visits = 0;
  const auto fill = [&](int a, int b, int c) {
    // The next triangle is nearer: it would paint samples of the one before again.
    raster.fill({points.col(a), points.col(b), points.col(c)}, Vector<3>::Constant(a + 0.1 * b),
                [&](double, double, double) {
                  ++visits;
                  return kBlack;
                });
  };
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const int a = j * (kCells + 1) + i;
      const int c = a + kCells + 2;
      fill(a, a + 1, c);
      fill(a, c - 1, c);
    }
  }
  constexpr int kSamples = kSize * Raster::kSamplesPerPixel;
  EXPECT_EQ(visits, kSamples * kSamples);
  const auto& samples = raster.samples();
  EXPECT_EQ(std::count(samples.begin(), samples.end(), 0xff000000U), kSamples * kSamples);
}

TEST(Raster, TheNearerTriangleHidesTheOther) {
  PointList<2> points(2, 3);
  points << 0, 10, 0, 0, 0, 10;
  const Corners corners{points.col(0), points.col(1), points.col(2)};
  Raster raster(points, 10, 10);
  const auto fill = [&](double nearness, Color color) {
    raster.fill(corners, Vector<3>::Constant(nearness),
                [&](double, double, double) { return color; });
  };
  fill(1, kPaper);
  fill(2, kBlack);
  fill(0, kPaper);
  EXPECT_EQ(raster.samples().front(), 0xff000000U);
  EXPECT_TRUE(raster.hides({2, 2}, 1.9));
  EXPECT_FALSE(raster.hides({2, 2}, 2.1));
  EXPECT_FALSE(raster.hides({9, 9}, 0));
  EXPECT_FALSE(raster.hides({-1, 2}, 0));
}

// The picture that a function draws.
template <class Draw>
Image drawn(int width, int height, Draw&& draw) {
  Canvas canvas(width, height, PictureFormat::kPng);
  draw(canvas);
  return decode_png(canvas.encode());
}

void fill_triangle(Canvas& canvas, const PointList<2>& points) {
  Raster raster = canvas.raster_for(points);
  raster.fill({points.col(0), points.col(1), points.col(2)}, {0, 0, 0},
              [](double, double, double) { return kBlack; });
  canvas.draw_raster(raster);
}

TEST(Canvas, CoversTheRightAreas) {
  PointList<2> points(2, 3);
  points << 3.3, 55.2, 20.9, 4.1, 12.7, 51.4;
  const Image triangle = drawn(60, 60, [&](Canvas& canvas) { fill_triangle(canvas, points); });
  const double exact = 0.5 * ((55.2 - 3.3) * (51.4 - 4.1) - (12.7 - 4.1) * (20.9 - 3.3));
  EXPECT_NEAR(darkness(triangle), exact, 0.005 * exact);

  const Image disc = drawn(60, 60, [](Canvas& canvas) {
    canvas.fill_discs({{30.2, 29.7}}, 20.5, kBlack);
  });
  EXPECT_NEAR(darkness(disc), kPi * 20.5 * 20.5, 0.005 * kPi * 20.5 * 20.5);

  for (const Vector<2>& end : {Vector<2>(50, 10), {50, 50}, {10, 50}, {17, 48}}) {
    const Image line = drawn(60, 60, [&](Canvas& canvas) {
      canvas.draw_segments({{{10, 10}, end}}, 3, kBlack);
    });
    const double capsule = 3 * (end - Vector<2>(10, 10)).norm() + kPi * 1.5 * 1.5;
    EXPECT_NEAR(darkness(line), capsule, 0.01 * capsule) << end.transpose();
  }
}

TEST(Canvas, JoinedAndCrossingSegmentsAreNoDarker) {
  const Image image = drawn(40, 40, [](Canvas& canvas) {
    canvas.draw_segments({{{5, 20}, {20, 20}}, {{20, 20}, {35, 20}}, {{20, 5}, {20, 35}}}, 4,
                         kBlack, 0.5F);
  });
  EXPECT_NEAR(image.at(20, 20).g, 0.5, 0.01);
  EXPECT_NEAR(image.at(10, 20).g, 0.5, 0.01);
}

TEST(Canvas, CutsOffWhatLiesOutside) {
  PointList<2> far(2, 3);
  far << 1e12, 0, 0, 0, 1e12, -5;
  const Image image = drawn(20, 10, [&](Canvas& canvas) {
    canvas.draw_segments({{{-1e5, 5}, {1e5, 5}}}, 2, kBlack);
    canvas.draw_segments({{{-50, -50}, {-40, -50}}, {{1e6, 3}, {2e6, 3}}}, 2, kBlack);
    canvas.fill_discs({{-100, 5}}, 10, kBlack);
  });
  EXPECT_NEAR(darkness(image), 2 * 20, 0.4);
  const Image covered = drawn(20, 10, [&](Canvas& canvas) { fill_triangle(canvas, far); });
  EXPECT_NEAR(darkness(covered), 20 * 10, 0.2);
}

TEST(Canvas, RefusesImpossibleSizesAndTextThatIsNoUnicode) {
  EXPECT_THROW(Canvas(0, 5, PictureFormat::kPng), OptionError);
  EXPECT_THROW(Canvas(90000, 90000, PictureFormat::kPng), OptionError);
  EXPECT_THROW(Canvas(30000, 30000, PictureFormat::kPdf), OptionError);
  Canvas canvas(20, 20, PictureFormat::kPng);
  canvas.draw_text({1, 10}, "a\xff", 8, kBlack);
  EXPECT_THROW(canvas.encode(), IoError);
}

// -------------------------------------------------------------------------------------- Colormap

double lightness(Color color) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

TEST(Colormap, DarkensAllTheWayWithoutSteps) {
  constexpr int kSteps = 500;
  for (int k = 1; k < kSteps; ++k) {
    const Color here = weight_color(1.0 * k / kSteps);
    const Color next = weight_color((k + 1.0) / kSteps);
    EXPECT_GT(lightness(here), lightness(next)) << k;
    EXPECT_LT(difference(here, next), 0.02) << k;
  }
  EXPECT_GT(lightness(weight_color(0)), 0.9);
}

TEST(Colormap, TheSmallestInfluenceIsSeen) {
  EXPECT_EQ(difference(weight_color(0.00009), weight_color(0)), 0);
  EXPECT_GT(difference(weight_color(0.00011), weight_color(0)), 0.1);
  EXPECT_GT(lightness(weight_color(0)), lightness(weight_color(0.00011)));
}

TEST(Colormap, DefectsLookLikeNoWeight) {
  for (const double weight : {-0.00011, -0.01, -0.1, -5.0, 1.00011, 1.01, 1.1, 7.0}) {
    for (int k = 0; k <= 1000; ++k) {
      EXPECT_GT(difference(weight_color(weight), weight_color(k / 1000.0)), 0.1) << weight;
    }
  }
  EXPECT_EQ(difference(weight_color(-0.00009), weight_color(0)), 0);
  EXPECT_EQ(difference(weight_color(1.00009), weight_color(1)), 0);
}

// -------------------------------------------------------------------------------------- Isolines

TEST(Isolines, OfALinearFunctionAreStraightAndComplete) {
  // With 8 columns the level 0.5 runs through vertices, the others do not.
  const auto s = box<2>({1, 1}, 8);
  const auto values = evaluate<2>(s.mesh, [](const Vector<2>& p) { return p.x(); });
  for (const double level : {0.1, 0.5, 0.9}) {
    const auto segments = trace_isolines(s.mesh.points, s.mesh.cells, values, {level});
    EXPECT_NEAR(length(segments), 1, 1e-12) << level;
    for (const Segment& segment : segments) {
      EXPECT_NEAR(segment.a.x(), level, 1e-12);
      EXPECT_NEAR(segment.b.x(), level, 1e-12);
    }
  }
  const auto all = trace_isolines(s.mesh.points, s.mesh.cells, values, isoline_levels(10));
  EXPECT_NEAR(length(all), 9, 1e-11);
}

TEST(Isolines, AreAbsentOnPlateaus) {
  const auto s = box<2>({1, 1}, 6);
  for (const double value : {0.0, 0.5, 1.0}) {
    const Eigen::VectorXd values = Eigen::VectorXd::Constant(s.mesh.num_vertices(), value);
    EXPECT_TRUE(
        trace_isolines(s.mesh.points, s.mesh.cells, values, {0.0, 0.001, 0.5, 1.0}).empty());
  }
  // Rounding errors do not make a plateau a hilly land.
  Eigen::VectorXd noise(s.mesh.num_vertices());
  for (Index v = 0; v < noise.size(); ++v) noise[v] = 0.5 + (v % 3 - 1) * 1e-9;
  EXPECT_TRUE(trace_isolines(s.mesh.points, s.mesh.cells, noise, {0.5}).empty());
  EXPECT_TRUE(isoline_levels(1).empty());
  EXPECT_TRUE(isoline_levels(0).empty());
}

// -------------------------------------------------------------------------------- Plane pictures

// A place in the domain, as a pixel of the picture.
Vector<2> pixel_of(const Cage<2>& cage, const Vector<2>& p, const WeightPictureOptions& options) {
  const Box content = bounding_box(cage.points);
  return PixelMap(content, plan_sheet(content, 1, options).frames[0])(p);
}

TEST(WeightPicture, ShowsTheColorsOfInterpolatedValues) {
  const auto s = box<2>({1.5, 1}, 3);
  const auto f = [](const Vector<2>& p) { return 0.1 + 0.3 * p.x() + 0.4 * p.y(); };
  const auto options = without_lines();
  const Image image = decode_png(draw_weights(s.cage, s.mesh, evaluate<2>(s.mesh, f), 2, options));
  ASSERT_EQ(image.width, 400);
  for (double x = 0.1; x < 1.45; x += 0.1) {
    for (double y = 0.1; y < 0.95; y += 0.1) {
      const Vector<2> at = pixel_of(s.cage, {x, y}, options);
      const Color seen = image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
      EXPECT_LT(difference(seen, weight_color(f({x, y}))), 0.015) << x << ' ' << y;
    }
  }
}

TEST(WeightPicture, IsWhiteOutsideAndRedAtTheControlPoint) {
  // An L: the notch is within the bounding box but outside the cage.
  testing::Sample<2> s;
  s.cage.points.resize(2, 6);
  s.cage.points << 0, 2, 2, 1, 1, 0, 0, 0, 1, 1, 2, 2;
  s.cage.facets.resize(2, 6);
  s.cage.facets << 0, 1, 2, 3, 4, 5, 1, 2, 3, 4, 5, 0;
  s.mesh.points = s.cage.points;
  s.mesh.cells.resize(3, 4);
  s.mesh.cells << 0, 1, 0, 0, 1, 2, 3, 4, 3, 3, 4, 5;
  const auto options = without_lines();
  const Image image =
      decode_png(draw_weights(s.cage, s.mesh, Eigen::VectorXd::Unit(6, 4), 4, options));
  const auto color_at = [&](const Vector<2>& p) {
    const Vector<2> at = pixel_of(s.cage, p, options);
    return image.at(static_cast<int>(at.x()), static_cast<int>(at.y()));
  };
  EXPECT_EQ(difference(color_at({1.6, 1.6}), kPaper), 0);
  EXPECT_GT(difference(color_at({0.6, 1.4}), kPaper), 0.02);
  EXPECT_TRUE(is_highlight(color_at({1, 2})));
  EXPECT_FALSE(is_highlight(color_at({1, 1})));
  for (int x = 0; x < image.width; ++x) {
    EXPECT_EQ(difference(image.at(x, 0), kPaper), 0);
    EXPECT_EQ(difference(image.at(x, image.height - 1), kPaper), 0);
  }
}

TEST(WeightPicture, NamesWhatIsWrong) {
  const auto s = box<2>({1, 1}, 2);
  WeightPictureOptions options;
  options.width = 10;
  EXPECT_THROW(draw_weights(s.cage, s.mesh, Eigen::VectorXd::Zero(9), 0, options), OptionError);
}

// ---------------------------------------------------------------------- before and after, in one

// A rectangle [0, width] x [0, 1] as cage and shape, in two triangles.
struct Scene {
  FacetList<2> facets{2, 4};
  CellList<2> triangles{3, 2};
  DrawnShape shape;
  Eigen::VectorXd values = Eigen::VectorXd::Unit(4, 2);

  explicit Scene(double width) {
    facets << 0, 1, 2, 3, 1, 2, 3, 0;
    triangles << 0, 0, 1, 2, 2, 3;
    shape.control_points.resize(2, 4);
    shape.control_points << 0, width, width, 0, 0, 0, 1, 1;
    shape.points = shape.control_points;
  }
  DrawnShape moved(const Vector<2>& step) const {
    return {shape.control_points.colwise() + step, shape.points.colwise() + step};
  }
  Image draw(const DrawnShape& after) const {
    const std::vector<PlanePanel> panels{
        {"before", std::make_shared<const DrawnShape>(shape), values, 2},
        {"after", std::make_shared<const DrawnShape>(after), values, 2}};
    return decode_png(draw_panels(facets, triangles, panels, shape.points));
  }
};

// The centers of the red dots, from the left to the right or from the top to the bottom: pixels of
// one are nearer to each other than 100 pixels.
std::vector<Vector<2>> red_dots(const Image& image) {
  std::vector<Vector<2>> sums;
  std::vector<double> counts;
  for (int x = 0; x < image.width; ++x) {
    for (int y = 0; y < image.height; ++y) {
      if (!is_highlight(image.at(x, y))) continue;
      const Vector<2> pixel(x, y);
      std::size_t dot = 0;
      while (dot < sums.size() && (sums[dot] / counts[dot] - pixel).norm() > 100) ++dot;
      if (dot == sums.size()) {
        sums.emplace_back(0, 0);
        counts.push_back(0);
      }
      sums[dot] += pixel;
      ++counts[dot];
    }
  }
  for (std::size_t dot = 0; dot < sums.size(); ++dot) sums[dot] /= counts[dot];
  return sums;
}

TEST(DeformationPicture, StandsBesideOrBelowByTheRoomThereIs) {
  const Scene square(1);
  const auto beside = red_dots(square.draw(square.shape));
  ASSERT_EQ(beside.size(), 2U);
  EXPECT_NEAR(beside[0].y(), beside[1].y(), 0.6);
  EXPECT_GT(beside[1].x() - beside[0].x(), 300);

  const Scene bar(3);
  const auto below = red_dots(bar.draw(bar.shape));
  ASSERT_EQ(below.size(), 2U);
  EXPECT_NEAR(below[0].x(), below[1].x(), 0.6);
  EXPECT_GT(std::abs(below[1].y() - below[0].y()), 200);
}

TEST(DeformationPicture, BothHaveTheSameScaleAndFrame) {
  const Scene square(1);
  const auto still = red_dots(square.draw(square.moved({0, 0})));
  const auto up = red_dots(square.draw(square.moved({0, 1})));
  ASSERT_EQ(still.size(), 2U);
  ASSERT_EQ(up.size(), 2U);
  // The common frame is as high as two squares; the second, at the right, is one square higher.
  EXPECT_GT(up[0].y() - up[1].y(), 100);
  EXPECT_NEAR(still[1].y(), still[0].y(), 0.6);
}

TEST(DeformationPicture, ShowsSquaresWithoutValues) {
  Scene square(1);
  const auto colored = square.draw(square.shape);
  square.values.resize(0);
  const auto plain = square.draw(square.shape);
  EXPECT_TRUE(red_dots(plain).empty());
  const auto reddish = [](const Image& image) {
    return std::count_if(image.pixels.begin(), image.pixels.end(),
                         [](Color color) { return color.r > color.b + 0.1; });
  };
  EXPECT_GT(reddish(plain), 0.3 * static_cast<double>(plain.pixels.size()));
  EXPECT_LT(reddish(colored), 0.1 * static_cast<double>(colored.pixels.size()));
}

}  // namespace
}  // namespace flbc::draw
