// SPDX-License-Identifier: BSD-3-Clause
// Pictures of models in space: what is nearer covers what is farther, what is hidden is pale.
#include "draw/model_picture.h"
#include "draw/view.h"
#include "front/colormap.h"
#include "support/png_image.h"
#include "support/test.h"

namespace flbc::draw {
namespace {

constexpr int kWidth = 300;

WeightPictureOptions small_picture() {
  WeightPictureOptions options;
  options.width = kWidth;
  options.color_bar = false;
  return options;
}

// Two squares in front of each other, the one with z = 1 of value 1, the other of value 0, in a
// cage of two triangles: one before both, one behind.
struct Squares {
  DrawnModel model;
  ModelPlace place;
  Eigen::VectorXd values;
  Index control_point = 0;

  Squares() {
    model.triangles.resize(3, 4);
    model.triangles << 0, 0, 4, 4, 1, 2, 5, 6, 2, 3, 6, 7;
    place.points.resize(3, 8);
    place.points << -1, 1, 1, -1, -1, 1, 1, -1, -1, -1, 1, 1, -1, -1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1;
    values = (Eigen::VectorXd(8) << 0, 0, 0, 0, 1, 1, 1, 1).finished();
    place.control_points.resize(3, 6);
    place.control_points << -2, 2, -2, -2, 2, -2, -2, -2, 2, -2, -2, 2, 2, 2, 2, -1, -1, -1;
    model.cage_edges = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}};
  }
  Image draw(const ObliqueView& view) const {
    return decode_png(draw_weights(model, place, values, control_point, view, small_picture()));
  }
};

// How far a color is from being the other one in some light.
double difference_in_hue(Color a, Color b) {
  const Eigen::Vector3d u(a.r, a.g, a.b), v(b.r, b.g, b.b);
  return std::acos(std::min(1.0, u.normalized().dot(v.normalized())));
}

double darkness(Color color) {
  return 1 - (color.r + color.g + color.b) / 3;
}

TEST(ModelPicture, TheNearerSurfaceCoversTheFarther) {
  const Squares squares;
  for (const auto& [azimuth, value] : {std::pair(0.0, 1.0), {180.0, 0.0}, {20.0, 1.0}}) {
    const auto image = squares.draw(view_by_angles(azimuth, 0));
    const auto center = image.at(image.width / 2 + 25, image.height / 2 + 5);
    EXPECT_LT(difference_in_hue(center, weight_color(value)), 0.02) << azimuth;
    EXPECT_GT(difference_in_hue(center, weight_color(1 - value)), 0.1) << azimuth;
  }
}

TEST(ModelPicture, HiddenWireIsPale) {
  // The same cage in front of a plain surface and behind it; the surface has one color.
  Squares squares;
  squares.values.resize(0);
  squares.control_point = -1;
  const auto darkest_change = [&](const ObliqueView& view, double front) {
    auto with = squares, without = squares;
    with.model.cage_edges = front > 0 ? decltype(with.model.cage_edges){{0, 1}, {1, 2}, {2, 0}}
                                      : decltype(with.model.cage_edges){{3, 4}, {4, 5}, {5, 3}};
    without.model.cage_edges.clear();
    const auto a = with.draw(view), b = without.draw(view);
    double most = 0;
    for (int y = a.height / 2 - 30; y < a.height / 2 + 30; ++y) {
      for (int x = a.width / 2 - 30; x < a.width / 2 + 30; ++x) {
        most = std::max(most, darkness(a.at(x, y)) - darkness(b.at(x, y)));
      }
    }
    return most;
  };
  const auto view = view_by_angles(0, 0);
  const double visible = darkest_change(view, 1), hidden = darkest_change(view, -1);
  EXPECT_GT(hidden, 0.02);
  EXPECT_GT(visible, 2 * hidden);
}

TEST(ModelPicture, WireOnTheSurfaceIsNotHidden) {
  Squares squares;
  squares.model.cage_edges = {{0, 1}, {1, 2}};
  const auto with_wire_at = [&](double z) {
    squares.place.control_points.row(2).setConstant(z);
    return squares.draw(view_by_angles(0, 0)).pixels;
  };
  const auto same = [](Color a, Color b) { return a.r == b.r && a.g == b.g && a.b == b.b; };
  const auto on_it = with_wire_at(1), before_it = with_wire_at(1.5), behind_it = with_wire_at(0.5);
  EXPECT_TRUE(std::equal(on_it.begin(), on_it.end(), before_it.begin(), same));
  EXPECT_FALSE(std::equal(on_it.begin(), on_it.end(), behind_it.begin(), same));
}

TEST(ModelPicture, SharpEdgesSeparateShades) {
  // A roof: both sides have one shade each up to the ridge.
  Squares squares;
  squares.values.resize(0);
  squares.control_point = -1;
  squares.model.cage_edges.clear();
  squares.model.triangles.resize(3, 2);
  squares.model.triangles << 0, 0, 1, 2, 2, 3;
  squares.place.points.leftCols(4) << 0, 1, 0, -1, -1, 0, 1, 0, 1, 0, 1, 0;
  const auto image = squares.draw(view_by_angles(0, 0));
  const int y = image.height / 2, middle = image.width / 2;
  for (const int side : {-1, 1}) {
    EXPECT_EQ(image.at(middle + 5 * side, y).g, image.at(middle + 20 * side, y).g) << side;
  }
  EXPECT_GT(std::abs(image.at(middle - 5, y).g - image.at(middle + 5, y).g), 0.1);
}

TEST(ModelPicture, ViewsAreRightHanded) {
  for (const auto& [azimuth, elevation] :
       {std::pair(0.0, 0.0), {90.0, 0.0}, {0.0, 90.0}, {35.0, 18.0}}) {
    const auto view = view_by_angles(azimuth, elevation);
    EXPECT_LT((view.right.cross(view.up) - view.toward).norm(), 1e-15);
  }
  EXPECT_LT((view_by_angles(0, 0).toward - Vector<3>::UnitZ()).norm(), 1e-15);
  EXPECT_LT((view_by_angles(90, 0).toward - Vector<3>::UnitX()).norm(), 1e-15);
  EXPECT_LT((view_by_angles(0, 90).toward - Vector<3>::UnitY()).norm(), 1e-15);
}

}  // namespace
}  // namespace flbc::draw
