// SPDX-License-Identifier: BSD-3-Clause
// Exact mirror symmetry, in a mesh that is not symmetric.
#include "flbc/mirror.h"

#include "flbc/deform.h"
#include "flbc/masks.h"
#include "flbc/rig.h"
#include "support/refined_sample.h"

namespace flbc::testing {
namespace {

// Points of a symmetric box with their images, points in the plane, and a point without an image.
template <int Dim>
PointList<Dim> mirrored_points() {
  PointList<Dim> points = PointList<Dim>::Constant(Dim, 49, 0.4);
  for (Index k = 0; k < 20; ++k) {
    points(0, 2 * k) = 0.05 + 0.02 * k;
    points(Dim - 1, 2 * k) = 0.1 + 0.04 * ((7 * k) % 20);
    points.col(2 * k + 1) = points.col(2 * k);
    points(0, 2 * k + 1) = 1 - points(0, 2 * k);
  }
  for (Index k = 40; k < 48; ++k) {
    points(0, k) = 0.5;
    points(Dim - 1, k) = 0.1 * (k - 39);
  }
  points(0, 48) = 0.77;
  return points;
}

EdgeList mirrored_edges() {
  EdgeList edges;
  for (Index k = 0; k < 38; ++k) edges.ends.push_back({k, k + 2});
  for (Index k = 40; k < 47; ++k) edges.ends.push_back({k, k + 1});
  edges.ends.push_back({38, 44});
  edges.ends.push_back({39, 44});
  return edges;
}

// \param twice  the place of the plane, x = twice / 2
template <int Dim>
Index image_of(const PointList<Dim>& points, Index p, double twice = 1) {
  Vector<Dim> image = points.col(p);
  image[0] = twice - image[0];
  for (Index q = 0; q < points.cols(); ++q) {
    if ((points.col(q) - image).norm() < 1e-9) return q;
  }
  return -1;
}

// Two mirrored lists of weights, exactly.
template <int Dim>
void expect_mirrored(const SparseWeights& weights, Index p, Index q,
                     const PointList<Dim>& control_points, double twice = 1) {
  const Eigen::VectorXd here = weights.at(p), there = weights.at(q);
  for (Index i = 0; i < control_points.cols(); ++i) {
    ASSERT_EQ(here[i], there[image_of<Dim>(control_points, i, twice)]) << p << ' ' << i;
  }
}

// Coordinates as files in single precision have them.
template <int Dim>
PointList<Dim> in_single_precision(const PointList<Dim>& points) {
  return points.template cast<float>().template cast<double>();
}

// Rounding moves mirror images by other amounts, except where the plane is x = 0.
TEST_IN_2D_AND_3D(MirrorTest, PartnersAreFoundWithinThePrecisionOfFiles) {
  const auto [cage, mesh, name] = with_fine_cage<Dim>(Shape::kBox, 4, 4);
  auto points = mirrored_points<Dim>();
  PointList<Dim> outside = points.leftCols(4);
  outside.row(Dim - 1).setConstant(-0.03);
  PointList<Dim> all(Dim, 53);
  all << points.leftCols(48), outside, points.col(48);
  for (const double place : {0.1, 0.0, -2.3}) {
    const double shift = place - 0.5;
    auto moved = cage;
    auto moved_mesh = mesh;
    moved.points.row(0).array() += shift;
    moved_mesh.points.row(0).array() += shift;
    points = all;
    points.row(0).array() += shift;
    points = in_single_precision<Dim>(points);
    for (const bool is_single : {false, true}) {
      if (is_single) {
        moved.points = in_single_precision<Dim>(moved.points);
        moved_mesh.points = in_single_precision<Dim>(moved_mesh.points);
      }
      EXPECT_EQ(MirroredModel<Dim>(moved, 0, points.leftCols(52)).note(), "");
      expect_piece(MirroredModel<Dim>(moved, 0, points).note(), "1 of 53 vertices have no mirror");
      BindOptions options;
      options.mirror_axis = 0;
      options.outside = OutsidePoints::kNearest;
      for (const bool masked : {false, true}) {
        if (masked) options.masks = {{{0}, {2, 4, 6, 49}}};
        Rig<Dim> rig(moved, moved_mesh, points, mirrored_edges(), options);
        for (const Index most : {0, 8, Dim + 1}) {
          options.max_influences = most;
          rig.set_options(options);
          const auto binding = rig.bind();
          const double size = bounding_box_diagonal(moved.points), accuracy = 1e-6 * size;
          EXPECT_LT((binding.deform(moved.points) - points).cwiseAbs().maxCoeff(), accuracy);
          for (Index p = 0; p < 52; ++p) {
            const bool is_in_plane = p >= 40 && p < 48;
            if (is_in_plane && most == Dim + 1) continue;
            expect_mirrored<Dim>(binding.weights, p, is_in_plane ? p : p ^ 1, cage.points);
          }
        }
      }
    }
  }
}

// Rounding decides which of them is on the cage.
TEST_IN_2D_AND_3D(MirrorTest, PointsAtTheToleranceStayTogether) {
  const auto [cage, mesh, name] = with_fine_cage<Dim>(Shape::kBox, 2, 8);
  const double tolerance = kBoundaryTolerance * bounding_box_diagonal(cage.points);
  PointList<Dim> points = PointList<Dim>::Constant(Dim, 3, 0.3);
  points.row(Dim - 1) << -0.9 * tolerance, -1.1 * tolerance, 0.3;
  points(0, 1) = 0.7;
  BindOptions options;
  options.mirror_axis = 0;
  options.outside = OutsidePoints::kKeep;
  const auto binding = Rig<Dim>(cage, mesh, points, {}, options).bind();
  EXPECT_EQ(binding.outside, (std::vector<Index>{0, 1}));
  EXPECT_LT((binding.deform(cage.points) - points).cwiseAbs().maxCoeff(), 1e-12);
}

// Tests end after a time in which all pairs could not be compared.
TEST_IN_2D_AND_3D(MirrorTest, LargeModelsOfOneHeightFindTheirPartners) {
  const auto [cage, mesh, name] = with_fine_cage<Dim>(Shape::kBox, 2, 4);
  constexpr Index kHalf = 400000;
  PointList<Dim> points = PointList<Dim>::Constant(Dim, 2 * kHalf, 0.4);
  for (Index p = 0; p < kHalf; ++p) {
    points(0, p) = 0.4 * (p + 1) / kHalf;
    if constexpr (Dim == 3) points(1, p) = 0.2 + 0.1 * (p % 7);
    points.col(p + kHalf) = points.col(p);
    points(0, p + kHalf) = 1 - points(0, p);
  }
  points.col(0) = points.col(1);  // copies share partners
  Mask left{{0}, std::vector<Index>(kHalf)};
  std::iota(left.points.begin(), left.points.end(), 0);
  const auto both = MirroredModel<Dim>(cage, 0, points).symmetrized({left});
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].points, left.points);
  for (Index& p : left.points) p += kHalf;
  left.points.erase(left.points.begin());  // the image of point 0 is gone
  EXPECT_EQ(both[1].points, left.points);
}

TEST_IN_2D_AND_3D(MirrorTest, DuplicatesOnOneSideStayTogether) {
  const auto [cage, mesh, name] = with_fine_cage<Dim>(Shape::kBox, 4, 8);
  const auto once = mirrored_points<Dim>();
  const auto count = static_cast<Index>(once.cols());
  const std::vector<Index> copied{0, 2, 2, 5, 41};
  PointList<Dim> points(Dim, once.cols() + copied.size());
  points << once, once(Eigen::all, copied);
  BindOptions options;
  options.mirror_axis = 0;
  for (const bool masked : {false, true}) {
    if (masked) options.masks = {{{0}, {3, 4}}};
    for (const Index most : {0, 8}) {
      options.max_influences = most;
      const auto binding = Rig<Dim>(cage, mesh, points, mirrored_edges(), options).bind();
      for (std::size_t k = 0; k < copied.size(); ++k) {
        const Index copy = count + static_cast<Index>(k);
        EXPECT_TRUE(binding.weights.at(copy) == binding.weights.at(copied[k])) << k;
        expect_mirrored<Dim>(binding.weights, copy, image_of<Dim>(points, copy), cage.points);
      }
    }
  }
}

// The boxes of samples have quads that are cut along diagonals without mirror images.
TEST_IN_2D_AND_3D(MirrorTest, MasksEndAlikeOnFlatQuads) {
  const auto [cage, mesh, name] = with_fine_cage<Dim>(Shape::kBox, 4, 8);
  PointList<Dim> points(Dim, 36);
  for (Index k = 0; k < 18; ++k) {
    points.col(2 * k).setConstant(0.1 + 0.04 * static_cast<double>((5 * k) % 18));
    points(0, 2 * k) = 0.025 * static_cast<double>(k + 1);
    points(Dim - 1, 2 * k) = k % 3 == 0 ? 0.001 : k % 3 == 1 ? 0 : -0.05;
    points.col(2 * k + 1) = points.col(2 * k);
    points(0, 2 * k + 1) = 1 - points(0, 2 * k);
  }
  BindOptions options;
  options.mirror_axis = 0;
  options.max_influences = 0;
  std::vector<Mask> masks;
  for (Index p = 0; p < points.cols(); ++p) {
    if (points(Dim - 1, p) <= 0 && points(0, p) < 0.5) masks.push_back({{}, {p}});
  }
  for (const auto policy :
       {OutsidePoints::kExtend, OutsidePoints::kNearest, OutsidePoints::kKeep}) {
    options.outside = policy;
    options.masks.clear();
    Rig<Dim> rig(cage, mesh, points, {}, options);
    for (Index i = 0; i < cage.size(); ++i) {
      for (auto& mask : masks) mask.control_points = {i};
      options.masks = masks;
      rig.set_options(options);
      const auto binding = rig.bind();
      for (Index p = 0; p < points.cols(); ++p) {
        expect_mirrored<Dim>(binding.weights, p, p ^ 1, cage.points);
      }
      EXPECT_LT((binding.deform(cage.points) - points).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

// The nearest points of the cage are not unique in a notch, and in the plane over one.
TEST(MirrorTest, PointsOutsideInNotchesAreMirrored) {
  Cage<2> cage{PointList<2>(2, 7), FacetList<2>(2, 7)};
  cage.points << -4, 4, 4, 2, 0, -2, -4,  //
      0, 0, 3, 1, 2.5, 1, 3;
  for (Index k = 0; k < 7; ++k) cage.facets.col(k) << k, (k + 1) % 7;
  DomainMesh<2> mesh{cage.points, CellList<2>(3, 5)};
  mesh.cells << 0, 0, 1, 0, 3,  //
      5, 1, 2, 3, 4,            //
      6, 3, 3, 5, 5;
  PointList<2> points(2, 7);
  points << 2, -2, 3, -3, 0, 1.2, -1.2,  //
      2.5, 2.5, 2.9, 2.9, 3, 0.5, 0.5;
  BindOptions options;
  options.mirror_axis = 0;
  options.outside = OutsidePoints::kNearest;
  for (const bool masked : {false, true}) {
    if (masked) options.masks = {{{1}, {1, 3, 6}}};
    for (const Index most : {0, 4}) {
      options.max_influences = most;
      const auto binding = Rig<2>(cage, mesh, points, {}, options).bind();
      for (const Index p : {0, 2, 5}) expect_mirrored<2>(binding.weights, p, p + 1, cage.points, 0);
      expect_mirrored<2>(binding.weights, 4, 4, cage.points, 0);
      EXPECT_LT((binding.deform(cage.points) - points).cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_LT((binding.offsets.row(0) + binding.offsets(Eigen::all, {1, 0, 3, 2, 4, 6, 5}).row(0))
                    .norm(),
                1e-13);
      const auto attached = attached_points(cage, points, binding.weights);
      EXPECT_LT((deform<2>(binding.weights, cage.points) - attached).cwiseAbs().maxCoeff(), 1e-13);
    }
  }
}

TEST(MirrorTest, QuadsThatAreCutDifferentlyMustBeFlat) {
  auto [cage, mesh, name] = with_fine_cage<3>(Shape::kBox, 4, 4);
  const auto points = mirrored_points<3>();
  MirroredModel<3>(cage, 0, points);
  for (Index i = 0; i < cage.size(); ++i) {
    const auto x = cage.points.col(i);
    if (x[2] == 1 && x[1] == 0.25 && std::abs(x[0] - 0.5) == 0.25) {
      cage.points(2, i) += 0.1;
    }
  }
  expect_refused("has no mirror image across x = 0.5; cut quads that are not flat alike",
                 [&, &cage = cage] { MirroredModel<3>(cage, 0, points); });
}

TEST_IN_2D_AND_3D(MirrorTest, OtherCagesAreRefused) {
  const auto [cage, mesh, name] = with_fine_cage<Dim>(Shape::kBox, 2, 4);
  const auto points = mirrored_points<Dim>();
  expect_refused<OptionError>("no mirror axis",
                              [&, &cage = cage] { MirroredModel<Dim>(cage, Dim, points); });
  Cage<Dim> lopsided = cage;
  lopsided.points(0, 0) -= 0.1;
  expect_refused(": the nearest control point is 0.1 away from it; make a symmetric cage",
                 [&] { MirroredModel<Dim>(lopsided, 0, points); });
  BindOptions options;  // before a solve, too
  options.mirror_axis = 0;
  expect_refused("has no mirror image across x = ",
                 [&, &mesh = mesh] { Rig<Dim>(lopsided, mesh, points, {}, options); });
}

}  // namespace
}  // namespace flbc::testing
