// SPDX-License-Identifier: BSD-3-Clause
// Masks of a model: exact zeros at its points after each step of a bind.
#include "flbc/masks.h"
#include "flbc/place_masks.h"
#include "flbc/rig.h"
#include "support/refined_sample.h"

namespace flbc::testing {
namespace {

template <int Dim>
Sample<Dim> box_in_grid() {
  return with_fine_cage<Dim>(Shape::kBox, Dim == 2 ? 8 : 4, 8);
}

// A grid, from `low` to 1 - low along each axis, with edges along the first.
template <int Dim>
struct Grid {
  PointList<Dim> points;
  EdgeList edges;

  explicit Grid(double low) {
    constexpr int kSize = 9;
    const int count = Dim == 2 ? kSize * kSize : kSize * kSize * kSize;
    points.resize(Dim, count);
    for (int p = 0; p < count; ++p) {
      for (int d = 0, rest = p; d < Dim; ++d, rest /= kSize) {
        points(d, p) = low + (1 - 2 * low) * (rest % kSize) / (kSize - 1);
      }
      if (p % kSize > 0) edges.ends.push_back({p - 1, p});
    }
  }

  Mask mask(const PointList<Dim>& control_points, double from, double to) const {
    Mask mask;
    for (Index i = 0; i < control_points.cols(); ++i) {
      if (control_points(0, i) > from) mask.control_points.push_back(i);
    }
    for (Index p = 0; p < points.cols(); ++p) {
      if (points(0, p) < to) mask.points.push_back(p);
    }
    return mask;
  }
};

template <int Dim>
void expect_obeyed(const Binding<Dim>& binding, const PointList<Dim>& control_points,
                   const PointList<Dim>& points, const Mask& mask) {
  for (const Index p : mask.points) {
    const Eigen::VectorXd weights = binding.weights.at(p);
    for (const Index i : mask.control_points) ASSERT_EQ(weights[i], 0) << p << ' ' << i;
  }
  EXPECT_LT((binding.deform(control_points) - points).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_IN_2D_AND_3D(ModelMasksTest, PointsOutsideObey) {
  const auto [cage, mesh, name] = box_in_grid<Dim>();
  const Grid<Dim> grid(-0.1);
  BindOptions options;
  options.masks = {grid.mask(cage.points, 0.6, 0.4)};
  for (const auto policy :
       {OutsidePoints::kExtend, OutsidePoints::kNearest, OutsidePoints::kKeep}) {
    options.outside = policy;
    const auto binding = Rig<Dim>(cage, mesh, grid.points, grid.edges, options).bind();
    expect_obeyed(binding, cage.points, grid.points, options.masks[0]);
  }
}

// Extended weights reproduce a point, which control points in one plane cannot.
TEST_IN_2D_AND_3D(ModelMasksTest, PointsOutsideThatCannotObeyAreRefused) {
  const auto [cage, mesh, name] = box_in_grid<Dim>();
  const Grid<Dim> grid(-0.1);
  BindOptions options;
  options.outside = OutsidePoints::kExtend;
  for (const double from : {-1.0, 0.0}) {
    options.masks = {grid.mask(cage.points, from, -1)};
    options.masks[0].points = {0};
    expect_refused("vertex 0 at",
                   [&] { Rig<Dim>(cage, mesh, grid.points, grid.edges, options).bind(); });
  }
  options.outside = OutsidePoints::kNearest;
  EXPECT_NO_THROW(Rig<Dim>(cage, mesh, grid.points, grid.edges, options).bind());
}

// Vertices on a facet, as files store them, are on it from either side.
TEST_IN_2D_AND_3D(ModelMasksTest, MasksEndAtFacetsWithinThePrecisionOfFiles) {
  const auto [cage, mesh, name] = box_in_grid<Dim>();
  const double rounding = 1e-7 * bounding_box_diagonal(cage.points);
  PointList<Dim> points = PointList<Dim>::Constant(Dim, 6, 0.3);
  points.row(Dim - 1) << -rounding, 0, rounding, -rounding, 0, rounding;
  // The last three are also on an edge of a facet (3D), or at a control point (2D).
  for (const Index p : {3, 4, 5}) points(0, p) = 0.25 + (p - 4) * 0.1 * rounding;
  BindOptions options;
  options.masks = {{{}, {0, 1, 2, 3, 4, 5}}};
  for (Index i = 0; i < cage.size(); ++i) {
    if (cage.points(Dim - 1, i) == 0) options.masks[0].control_points.push_back(i);
  }
  const auto binding = Rig<Dim>(cage, mesh, points, {}, options).bind();
  expect_piece(binding.report.note, "6 of 6 masked vertices are on facets");
  EXPECT_LT((binding.deform(cage.points) - points).cwiseAbs().maxCoeff(), 2 * rounding);
  for (Index p = 0; p < 6; ++p) {
    const Eigen::VectorXd weights = binding.weights.at(p);
    Index movers = 0;
    for (const Index i : options.masks[0].control_points) movers += weights[i] != 0 ? 1 : 0;
    EXPECT_LE(movers, p < 3 ? Dim : Dim - 1) << p;
  }
}

TEST_IN_2D_AND_3D(ModelMasksTest, AConflictHasItsPointsAndItsCure) {
  const auto [cage, mesh, name] = box_in_grid<Dim>();
  const Grid<Dim> grid(0.07);
  BindOptions options;
  options.masks = {grid.mask(cage.points, 0.3, 0.4)};
  // The control points that are left span a box.
  double end = 0;
  for (const double x : cage.points.row(0)) end = x > 0.3 ? end : std::max(end, x);
  std::vector<Index> beyond;
  for (const Index p : options.masks[0].points) {
    if (grid.points(0, p) > end) beyond.push_back(p);
  }
  std::vector<Index> cure;
  try {
    Rig<Dim>(cage, mesh, grid.points, grid.edges, options).bind();
    FAIL();
  } catch (const MaskConflict& conflict) {
    EXPECT_EQ(conflict.points, beyond);
    cure = conflict.control_points;
  }
  std::vector<Index> freed;
  options.masks = relax_masks(cage, grid.points, options.masks, freed);
  EXPECT_FALSE(cure.empty());
  EXPECT_EQ(freed, cure);
  EXPECT_FALSE(options.masks[0].control_points.empty());
  for (const Index i : freed) EXPECT_GT(cage.points(0, i), 0.3);
  const auto binding = Rig<Dim>(cage, mesh, grid.points, grid.edges, options).bind();
  expect_obeyed(binding, cage.points, grid.points, options.masks[0]);
  EXPECT_TRUE(relax_masks(cage, grid.points, options.masks, freed) == options.masks);
  EXPECT_TRUE(freed.empty());
}

TEST_IN_2D_AND_3D(ModelMasksTest, RelaxedMasksFitTheMirror) {
  const auto [cage, mesh, name] = box_in_grid<Dim>();
  const Grid<Dim> grid(0.07);
  BindOptions options;
  options.mirror_axis = 0;
  options.masks = {grid.mask(cage.points, 0.3, 0.4)};
  options.masks[0].points.resize(3);  // on one side
  const auto first = options.masks[0].control_points;
  std::vector<Index> freed;
  options.masks = relax_masks(cage, grid.points, options.masks, freed, options.mirror_axis);
  EXPECT_FALSE(freed.empty());
  const MirroredModel<Dim> mirror(cage, 0, grid.points);
  for (const Index i : freed) {
    EXPECT_TRUE(std::binary_search(freed.begin(), freed.end(), mirror.images()[i])) << i;
  }
  const auto binding = Rig<Dim>(cage, mesh, grid.points, grid.edges, options).bind();
  Mask left{{}, {0, 1, 2}};
  for (const Index i : first) {
    if (!std::binary_search(freed.begin(), freed.end(), i)) left.control_points.push_back(i);
  }
  EXPECT_FALSE(left.control_points.empty());
  expect_obeyed(binding, cage.points, grid.points, left);
}

}  // namespace
}  // namespace flbc::testing
