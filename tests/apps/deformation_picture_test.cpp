// SPDX-License-Identifier: BSD-3-Clause
// Before and after in one picture, measured on its pixels.
#include "draw/plane_picture.h"

#include "support/png_image.h"
#include "support/test.h"

namespace flbc::draw {
namespace {

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
      const Color color = image.at(x, y);
      if (!(color.r > 0.85 && color.g < 0.15 && color.b < 0.15)) continue;
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
