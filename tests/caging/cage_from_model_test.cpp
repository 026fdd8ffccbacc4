// SPDX-License-Identifier: BSD-3-Clause
// Generated cages enclose their models, even defective ones.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>

#include "flbc/bounding_box.h"
#include "flbc/cage_facts.h"
#include "flbc/cage_from_model.h"
#include "flbc/errors.h"
#include "flbc/meshing.h"
#include "support/code_cages.h"
#include "support/dimensions.h"
#include "support/enclosure_judge.h"
#include "support/model_cages.h"

namespace flbc::testing {
namespace {

template <int Dim>
void expect_cage_of(const Cage<Dim>& model, const CagingOptions& options,
                    const ModelCage<Dim>& made) {
  EXPECT_EQ(find_defects(made.cage).size(), 0u);
  EXPECT_EQ(find_self_intersections(made.cage).size(), 0u);
  if (options.control_points > 0) {
    EXPECT_LE(made.cage.size(), options.control_points);
  }
  EXPECT_EQ(count_outside(model, made.cage), 0);
  EXPECT_EQ(count_crossings(model, made.cage), 0);
}

template <int Dim>
ModelCage<Dim> make(const Cage<Dim>& model, const CagingOptions& options) {
  auto made = cage_from_model(model.points, model.facets, options);
  expect_cage_of(model, options, made);
  return made;
}

// A bar along each axis, crossing in the middle: they intersect themselves and have long limbs.
template <int Dim>
Cage<Dim> crossed_bars() {
  Cage<Dim> bars;
  for (int axis = 0; axis < Dim; ++axis) {
    Vector<Dim> half = Vector<Dim>::Constant(0.1 + 0.02 * axis);
    half(axis) = 1 + 0.1 * axis;
    const auto bar = box_cage<Dim>(-half, half);
    bars = axis == 0 ? bar : join(bars, bar);
  }
  return bars;
}

// Facets anywhere, with separate corners.
template <int Dim>
Cage<Dim> soup(Index count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1), side(-0.1, 0.1);
  Cage<Dim> facets{PointList<Dim>(Dim, Dim * count), FacetList<Dim>(Dim, count)};
  for (Index f = 0; f < count; ++f) {
    Vector<Dim> middle;
    for (int axis = 0; axis < Dim; ++axis) middle(axis) = place(random);
    for (int k = 0; k < Dim; ++k) {
      for (int axis = 0; axis < Dim; ++axis) {
        facets.points(axis, Dim * f + k) = middle(axis) + side(random);
      }
      facets.facets(k, f) = Dim * f + k;
    }
  }
  return facets;
}

TEST_IN_2D_AND_3D(CageFromModelTest, EnclosesWithAtMostSoManyControlPoints) {
  const auto model = crossed_bars<Dim>();
  for (const Index count : {Dim + 1, 2 * Dim + 2, 20, 60}) {
    CagingOptions options;
    options.control_points = count;
    make(model, options);
  }
}

TEST_IN_2D_AND_3D(CageFromModelTest, MoreControlPointsFollowTheModelMoreClosely) {
  const auto model = crossed_bars<Dim>();
  double previous = std::numeric_limits<double>::infinity();
  for (const Index count : {8, 24, 80}) {
    CagingOptions options;
    options.control_points = count;
    const double distance = make(model, options).mean_distance;
    EXPECT_LT(distance, previous);
    previous = distance;
  }
  EXPECT_LT(previous, 0.03 * bounding_box_diagonal<Dim>(model.points));
}

TEST_IN_2D_AND_3D(CageFromModelTest, AnyStateOfTheModel) {
  const auto box = box_cage<Dim>(1);
  auto far = box_cage<Dim>(0.3);
  far.points.array() += 3;
  auto fin = box;  // three facets at one edge (2D: three edges at a vertex)
  fin.points.conservativeResize(Dim, box.size() + 1);
  fin.points.rightCols(1).setConstant(-2);
  fin.facets.conservativeResize(Dim, box.facets.cols() + 1);
  fin.facets.rightCols(1) = box.facets.col(0);
  fin.facets(Dim - 1, box.facets.cols()) = box.size();
  auto degenerate = box;  // segments, points, and facets without measure
  degenerate.facets.col(0).setConstant(degenerate.facets(0, 0));
  degenerate.facets(1, 1) = degenerate.facets(0, 1);
  const Cage<Dim> points{box.points, FacetList<Dim>(Dim, 0)};
  const std::vector<Cage<Dim>> models{
      join(box, far), without_facet(box, 1), fin, join(box, reversed(box)), degenerate,
      points,         soup<Dim>(60)};
  for (std::size_t k = 0; k < models.size(); ++k) {
    SCOPED_TRACE("model " + std::to_string(k));
    CagingOptions options;
    options.control_points = 40;
    make(models[k], options);
    make(models[k], {});
  }
}

TEST_IN_2D_AND_3D(CageFromModelTest, FlatModels) {
  Cage<Dim> flat{PointList<Dim>::Zero(Dim, Dim), FacetList<Dim>(Dim, 1)};
  for (int k = 0; k < Dim; ++k) flat.facets(k, 0) = k;
  for (int k = 1; k < Dim; ++k) flat.points(k, k) = k;
  make(flat, {});
}

TEST_IN_2D_AND_3D(CageFromModelTest, SymmetricModelsGetSymmetricCages) {
  // Symmetric across x = 0.5 only.
  auto model = join(crossed_bars<Dim>(), box_cage<Dim>(0.3));
  model.points.bottomRightCorner(Dim - 1, box_cage<Dim>(1).size()).array() += 0.9;
  model.points.row(0).array() += 0.5;
  for (const auto symmetry : {CageSymmetry::kAuto, CageSymmetry::kX, CageSymmetry::kY}) {
    CagingOptions options;
    options.control_points = 50;
    options.symmetry = symmetry;
    const auto made = make(model, options);
    const int axis = symmetry == CageSymmetry::kY ? 1 : 0;
    ASSERT_EQ(made.symmetry_axis, axis);
    if (axis == 0) {
      EXPECT_NEAR(made.symmetry_place, 0.5, 1e-12);
    }
    for (Index i = 0; i < made.cage.size(); ++i) {
      Vector<Dim> image = made.cage.points.col(i);
      image(axis) = 2 * made.symmetry_place - image(axis);
      EXPECT_LT((made.cage.points.colwise() - image).colwise().norm().minCoeff(), 1e-12);
    }
  }
  CagingOptions free;
  free.symmetry = CageSymmetry::kNone;
  EXPECT_EQ(make(model, free).symmetry_axis, -1);
}

TEST_IN_2D_AND_3D(CageFromModelTest, SameInputSameCage) {
  const auto model = crossed_bars<Dim>();
  const auto one = make(model, {}).cage, other = make(model, {}).cage;
  EXPECT_EQ(one.points, other.points);
  EXPECT_EQ(one.facets, other.facets);
}

TEST_IN_2D_AND_3D(CageFromModelTest, UnitsDoNotMatter) {
  const auto model = crossed_bars<Dim>();
  const auto cage = make(model, {}).cage;
  for (const double unit : {0x1p-80, 0x1p60}) {
    const auto scaled = cage_from_model<Dim>(unit * model.points, model.facets).cage;
    EXPECT_EQ(scaled.points, unit * cage.points);
    EXPECT_EQ(scaled.facets, cage.facets);
  }
}

TEST_IN_2D_AND_3D(CageFromModelTest, OffsetIsADistance) {
  const auto model = box_cage<Dim>(1);
  CagingOptions options;
  options.offset = 0.5;
  const auto cage = make(model, options).cage;
  EXPECT_GT(cage.points.maxCoeff(), 1.25);
  EXPECT_LT(cage.points.maxCoeff(), 2.5);
}

TEST_IN_2D_AND_3D(CageFromModelTest, CagesCanBeMeshed) {
  const auto cage = make(crossed_bars<Dim>(), {}).cage;
  if constexpr (Dim == 2) {
    EXPECT_GT(triangulate(cage, {500}).num_cells(), 0);
  }
}

TEST_IN_2D_AND_3D(CageFromModelTest, RefusesWhatHasNoCage) {
  const auto model = box_cage<Dim>(1);
  CagingOptions options;
  options.control_points = Dim;
  EXPECT_THROW(make(model, options), OptionError);
  options = {};
  options.offset = -1;
  EXPECT_THROW(make(model, options), OptionError);
  const FacetList<Dim> none(Dim, 0);
  EXPECT_THROW(cage_from_model<Dim>(PointList<Dim>(Dim, 0), none), InputError);
  EXPECT_THROW(cage_from_model<Dim>(PointList<Dim>::Ones(Dim, 3), none), InputError);
  auto infinite = model;
  infinite.points(0, 2) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(make(infinite, {}), InputError);
}

TEST(CageFromRealModelTest, RealModels) {
  for (const char* name : {"shark", "arm", "armadillo", "clothing"}) {
    const std::string file = "3d/" + std::string(name) + ".obj";
    if (!has_model(file)) GTEST_SKIP() << model_path(file) << " is absent";
    SCOPED_TRACE(file);
    const auto model = load_cage<3>(file);
    CagingOptions options;
    options.control_points = 100;
    const auto made = make(model, options);
    EXPECT_GT(made.cage.size(), 90);
    EXPECT_LT(made.mean_distance, 0.03 * bounding_box_diagonal<3>(model.points));
  }
}

}  // namespace
}  // namespace flbc::testing
