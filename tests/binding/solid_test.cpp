// SPDX-License-Identifier: BSD-3-Clause
// Solid regions: every pose moves them by an affine map.
#include "flbc/deform.h"
#include "flbc/io/binding_file.h"
#include "flbc/rig.h"
#include "support/feasible_vertices.h"
#include "support/refined_sample.h"

namespace flbc::testing {
namespace {

// A grid in a box, with two solid balls in it.
template <int Dim>
struct SolidTest {
  Sample<Dim> sample = with_fine_cage<Dim>(Shape::kBox, Dim == 2 ? 8 : 4, 8);
  const Cage<Dim>& cage = sample.cage;
  PointList<Dim> points;
  EdgeList edges;
  BindOptions options;

  explicit SolidTest(int size = 17, double radius = 0.12) {
    const int count = Dim == 2 ? size * size : size * size * size;
    points.resize(Dim, count);
    for (int p = 0; p < count; ++p) {
      for (int d = 0, rest = p, step = 1; d < Dim; ++d, rest /= size, step *= size) {
        points(d, p) = 0.05 + 0.9 * (rest % size) / (size - 1);
        if (rest % size > 0) edges.ends.push_back({p - step, p});
      }
    }
    for (const double place : {0.3, 0.7}) options.solid.push_back(ball(place, radius));
  }

  std::vector<Index> ball(double place, double radius) const {
    std::vector<Index> inside;
    for (Index p = 0; p < points.cols(); ++p) {
      if ((points.col(p).array() - place).matrix().norm() < radius) inside.push_back(p);
    }
    return inside;
  }

  Rig<Dim> rig() const { return Rig<Dim>(cage, sample.mesh, points, edges, options); }
};

// How far random poses move a region from the affine map that fits best.
template <int Dim>
double non_affine(const Binding<Dim>& binding, const std::vector<Index>& region) {
  Numbers numbers(3);
  Eigen::MatrixXd places(static_cast<Index>(region.size()), Dim + 1);
  places << binding.rest()(Eigen::all, region).transpose(), Eigen::VectorXd::Ones(places.rows());
  double worst = 0;
  for (int k = 0; k < 5; ++k) {
    const PointList<Dim> pose = numbers.matrix(Dim, binding.cage.size(), -1, 1);
    const Eigen::MatrixXd moved = binding.deform(pose)(Eigen::all, region).transpose();
    const Eigen::MatrixXd left = moved - places * least_squares(places, moved);
    worst = std::max(worst, left.cwiseAbs().maxCoeff());
  }
  return worst;
}

template <int Dim>
void expect_solid(const Binding<Dim>& binding, Index most = 1000) {
  const auto weights = binding.weights.dense();
  EXPECT_GE(weights.minCoeff(), 0);
  EXPECT_LE((weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-13);
  EXPECT_LE((binding.cage.points * weights - binding.points).cwiseAbs().maxCoeff(), 1e-13);
  ASSERT_FALSE(binding.solid.empty());
  for (const auto& region : binding.solid) {
    ASSERT_GE(region.size(), 5U);
    EXPECT_LE(non_affine(binding, region), 1e-12);
    const Eigen::VectorXd largest = weights(Eigen::all, region).rowwise().maxCoeff();
    EXPECT_LE((largest.array() > 0).count(), most);
  }
  EXPECT_LE((weights.array() > 0).colwise().count().maxCoeff(), most);
}

TEST_IN_2D_AND_3D(SolidTest, RegionsAreAffineInAllThatIsMadeOfABinding) {
  SolidTest<Dim> t;
  auto rig = t.rig();
  const auto binding = rig.binding();
  expect_solid(binding);
  EXPECT_GT(non_affine(binding, t.ball(0.5, 0.12)), 1e-3) << "everything is affine";
  expect_piece(binding.report.note, "a certificate does not hold");
  for (const Index most : {8, 4}) {
    expect_solid(binding.reduced({most}), most);
    expect_solid(binding.reduced({most}, {}, Reduction::kQuadratic), most);
  }
  expect_solid(rig.bind(), 8);
  const auto read = std::get<Binding<Dim>>(io::decode_binding(io::encode_binding(binding)));
  EXPECT_EQ(read.solid, t.options.solid);
  expect_solid(read.reduced({8}), 8);
  // A finer version of the model, evaluated in the mesh and from the surface.
  const SolidTest<Dim> finer(21);
  FacetList<3> elements(3, static_cast<Index>(t.edges.ends.size()));
  for (Eigen::Index e = 0; e < elements.cols(); ++e) {
    const auto& [a, b] = t.edges.ends[e];
    elements.col(e) << a, b, b;
  }
  expect_solid(binding.transferred(finer.points, finer.edges, OutsidePoints::kFail));
  expect_solid(binding.transferred(elements, finer.points, finer.edges, 1));
  PointList<Dim> moved = t.cage.points;
  moved.row(0) *= 1.1;
  rig.reshape(moved);
  expect_solid(rig.binding());
}

// The nearest feasible weights W of W0 are the only ones with <W - W0, V - W> >= 0 for all feasible
// V, such as those of all simplices of control points around a region.
TEST_IN_2D_AND_3D(SolidTest, NoAffineWeightsAreNearer) {
  SolidTest<Dim> t(17, 0.2);
  t.options.solid.resize(1);
  t.options.solid[0] = t.ball(0.5, 0.2);
  const auto region = t.options.solid[0];
  const auto solid = t.rig().binding().weights.dense()(Eigen::all, region).eval();
  t.options.solid.clear();
  const auto given = t.rig().binding().weights.dense()(Eigen::all, region).eval();
  EXPECT_EQ(solid.minCoeff(), 0) << "all constraints are idle";
  Numbers numbers(5);
  Eigen::MatrixXd places(Dim + 1, static_cast<Index>(region.size()));
  places << t.points(Eigen::all, region), Eigen::RowVectorXd::Ones(places.cols());
  std::vector<Index> order(t.cage.size());
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(7);
  int count = 0;
  for (int k = 0; k < 20000; ++k) {
    std::shuffle(order.begin(), order.end(), random);
    const std::vector<Index> simplex(order.begin(), order.begin() + Dim + 1);
    Eigen::MatrixXd corners(Dim + 1, Dim + 1);
    corners << t.cage.points(Eigen::all, simplex), Eigen::RowVectorXd::Ones(Dim + 1);
    if (std::abs(determinant(corners)) < 1e-3) continue;
    const Eigen::MatrixXd own = solve_square(corners, places);
    if (own.minCoeff() < 0) continue;
    Eigen::MatrixXd other = Eigen::MatrixXd::Zero(solid.rows(), solid.cols());
    other(simplex, Eigen::all) = own;
    EXPECT_GE((solid - given).cwiseProduct(other - solid).sum(), -1e-10);
    ++count;
  }
  EXPECT_GT(count, 5);
}

// A square sheet with two solid discs. \return the largest difference of neighbors, not both in one
template <int Dim>
double largest_step(int size) {
  SolidTest<Dim> t(2);
  t.points.setConstant(Dim, size * size, 0.5);
  t.edges = {};
  for (int p = 0; p < size * size; ++p) {
    const int column = p % size, row = p / size;
    t.points.col(p).template head<2>() << column, row;
    if (column > 0) t.edges.ends.push_back({p - 1, p});
    if (row > 0) t.edges.ends.push_back({p - size, p});
  }
  t.points.topRows(2) = 0.05 + 0.9 / (size - 1) * t.points.topRows(2).array();
  std::vector<bool> is_in(size * size, false);
  t.options.solid.assign(2, {});
  for (int p = 0; p < size * size; ++p) {
    for (const int k : {0, 1}) {
      is_in[p] =
          is_in[p] ||
          (t.points.col(p).template head<2>().array() - (k > 0 ? 0.7 : 0.3)).matrix().norm() < 0.12;
      if (is_in[p]) {
        t.options.solid[k].push_back(p);
        break;
      }
    }
  }
  const auto solid = t.rig().binding();
  for (const auto& region : solid.solid) EXPECT_LE(non_affine(solid, region), 1e-12);
  t.options.solid.clear();
  const auto given = t.rig().binding();
  const Eigen::MatrixXd change = solid.weights.dense() - given.weights.dense();
  const auto unchanged = (change.colwise().norm().array() == 0).count();
  EXPECT_GT(unchanged, change.cols() / 3) << "bands are wide";
  double largest = 0;
  for (const auto& [a, b] : t.edges.ends) {
    if (!is_in[a] || !is_in[b]) largest = std::max(largest, (change.col(a) - change.col(b)).norm());
  }
  return largest;
}

// Weights are continuous along the mesh: neighbors a quarter as far apart differ less. Without a
// band the differences at the border would stay.
TEST_IN_2D_AND_3D(SolidTest, WeightsChangeGraduallyAroundARegion) {
  EXPECT_LT(largest_step<Dim>(129), 0.6 * largest_step<Dim>(33));
}

// Vertices that a seam doubles stay together, although only one of them is marked.
TEST_IN_2D_AND_3D(SolidTest, SeamsStayClosed) {
  SolidTest<Dim> t;
  t.options.solid.resize(1);
  const Index marked = t.options.solid[0].front(), twin = static_cast<Index>(t.points.cols());
  t.points.conservativeResize(Eigen::NoChange, twin + 1);
  t.points.col(twin) = t.points.col(marked);
  const auto weights = t.rig().binding().weights;
  EXPECT_LT((weights.at(marked) - weights.at(twin)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_IN_2D_AND_3D(SolidTest, MaskedControlPointsDoNotMoveARegion) {
  SolidTest<Dim> t;
  auto& [control_points, masked] = t.options.masks.emplace_back();
  for (Index i = 0; i < t.cage.size(); ++i) {
    if (t.cage.points(0, i) > 0.8) control_points.push_back(i);
  }
  masked = {t.options.solid[0].front()};
  const auto binding = t.rig().binding();
  expect_solid(binding);
  for (const auto& few : {binding, binding.reduced({8}), binding.reduced({Dim + 1})}) {
    const auto weights = few.weights.dense();
    EXPECT_EQ(weights(control_points, t.options.solid[0]).cwiseAbs().maxCoeff(), 0);
    EXPECT_GT(weights(control_points, t.options.solid[1]).maxCoeff(), 0);
  }
  for (Index i = 0; i < t.cage.size(); ++i) {
    if (t.cage.points(0, i) > 0.3 && t.cage.points(0, i) < 0.8) control_points.push_back(i);
  }
  // A point that the other control points surround.
  masked = {*std::min_element(t.options.solid[0].begin(), t.options.solid[0].end(),
                              [&](Index a, Index b) { return t.points(0, a) < t.points(0, b); })};
  expect_refused("masks leave too few control points", [&] { t.rig(); });
}

TEST_IN_2D_AND_3D(SolidTest, WhatCannotBeSolidIsRefusedByName) {
  SolidTest<Dim> t;
  const auto refused = [&](const std::string& words, auto change) {
    auto other = t;
    change(other);
    expect_refused(words, [&] { other.rig(); });
  };
  const auto all = static_cast<Index>(t.points.cols());
  refused("solid region 1: vertex " + std::to_string(all) + " does not exist",
          [&](auto& o) { o.options.solid[1].push_back(all); });
  refused("is in a solid region already",
          [](auto& o) { o.options.solid[1].push_back(o.options.solid[0][0]); });
  refused("solid region 2 has no vertices", [](auto& o) { o.options.solid.emplace_back(); });
  refused("exclude each other", [](auto& o) { o.options.mirror_axis = 0; });
  refused("is outside the cage", [](auto& o) {
    o.options.outside = OutsidePoints::kKeep;
    o.points.col(o.options.solid[0][0]).setConstant(-1);
  });
  // Weights that are affine in all of a box are not >= 0.
  std::vector<Index> whole(t.points.cols());
  std::iota(whole.begin(), whole.end(), 0);
  refused("solid region 0 of " + std::to_string(whole.size()) + " vertices, 90% of the cage size",
          [&](auto& o) { o.options.solid = {whole}; });
  // The other regions of a Rig stay.
  auto rig = t.rig();
  rig.solve();
  auto options = t.options;
  options.solid = {whole};
  expect_refused("enlarge the cage there", [&] { rig.set_options(options); });
  expect_solid(rig.binding());
  expect_refused("solid regions", [&] { rig.binding().joined({}); });
}

}  // namespace
}  // namespace flbc::testing
