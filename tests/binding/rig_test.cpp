// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/rig.h"

#include <algorithm>

#include "flbc/deform.h"
#include "flbc/sparsify.h"
#include "support/refined_sample.h"

namespace flbc::testing {
namespace {

template <int Dim>
Sample<Dim> sample() {
  return refined_sample<Dim>(Shape::kCorner, Dim == 2 ? 8 : 3);
}

// Points near the centers of cells.
template <int Dim>
PointList<Dim> model(const DomainMesh<Dim>& mesh) {
  PointList<Dim> points(Dim, 30);
  for (Index p = 0; p < points.cols(); ++p) {
    const Index cell = p * (mesh.num_cells() / 30);
    points.col(p).setZero();
    for (int k = 0; k <= Dim; ++k)
      points.col(p) += mesh.points.col(mesh.cells(k, cell)) / (Dim + 1);
  }
  return points;
}

template <int Dim>
PointList<Dim> with_one_moved(const PointList<Dim>& points, double part) {
  PointList<Dim> moved = points;
  const Vector<Dim> size = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  moved.col(0) -= part * size;  // the lowest corner, outward
  return moved;
}

template <int Dim>
Rig<Dim> rig(const BindOptions& options = {}) {
  const auto [cage, mesh, name] = sample<Dim>();
  return {cage, mesh, model<Dim>(mesh), {}, options};
}

template <int Dim>
void expect_reproduces(Rig<Dim>& rig, const PointList<Dim>& points) {
  EXPECT_LT((rig.bind().deform(rig.cage().points) - points).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GE(rig.bind().report.quality.min_weight, 0);
}

TEST_IN_2D_AND_3D(RigTest, SolvesInSlicesToTheWeightsOfBind) {
  const auto [cage, mesh, name] = sample<Dim>();
  auto sliced = rig<Dim>();
  while (sliced.solve({10}).report.status != SolveStatus::kConverged) {
  }
  EXPECT_TRUE(sliced.bind().weights ==
              Rig<Dim>(cage, mesh, model<Dim>(mesh), {}, {}).bind().weights);
}

TEST_IN_2D_AND_3D(RigTest, AReshapedCageHasTheWeightsOfANewOne) {
  auto reshaped = rig<Dim>();
  const auto points = model<Dim>(reshaped.mesh());
  const auto control_points = with_one_moved<Dim>(reshaped.cage().points, 0.05);
  reshaped.reshape(control_points);
  EXPECT_TRUE(reshaped.cage().points == control_points);
  expect_reproduces<Dim>(reshaped, points);
  Rig<Dim> made(reshaped.cage(), reshaped.mesh(), points, {}, {});
  const WeightMatrix difference =
      reshaped.weights_of_points().dense() - made.weights_of_points().dense();
  EXPECT_LT(difference.squaredNorm() / static_cast<double>(points.cols()), 1e-5);
}

TEST_IN_2D_AND_3D(RigTest, ARefusedShapeChangesNothing) {
  auto changed = rig<Dim>();
  const auto weights = changed.weights_of_points();
  const auto cage = changed.cage();
  const auto mesh = changed.mesh();
  const auto expect_unchanged = [&] {
    EXPECT_TRUE(changed.cage().points == cage.points);
    EXPECT_TRUE(changed.mesh().points == mesh.points);
    EXPECT_TRUE(changed.weights_of_points() == weights);
  };
  const Vector<Dim> center = cage.points.rowwise().mean();
  const PointList<Dim> small = (0.2 * (cage.points.colwise() - center)).colwise() + center;
  expect_refused<InputError>("outside", [&] { changed.reshape(small); });
  expect_unchanged();
  PointList<Dim> flat = cage.points;
  flat.row(0).setZero();
  EXPECT_THROW(changed.reshape(flat), InputError);
  expect_unchanged();
  EXPECT_THROW(changed.reshape(cage.points.leftCols(1)), InputError);
  expect_unchanged();
  PointList<Dim> far = model<Dim>(mesh);
  far.col(3).array() += 100;
  expect_refused<InputError>("outside", [&] { changed.set_model(far, {}); });
  expect_unchanged();
  BindOptions few;
  few.max_influences = Dim;
  EXPECT_THROW(changed.set_options(few), OptionError);
  expect_unchanged();
}

TEST_IN_2D_AND_3D(RigTest, AnotherModelNeedsNoSolve) {
  auto changed = rig<Dim>();
  changed.weights_of_points();
  const auto iterations = changed.solution().report.iterations;
  const PointList<Dim> points = model<Dim>(changed.mesh()).rightCols(10);
  changed.set_model(points, {});
  expect_reproduces<Dim>(changed, points);
  EXPECT_EQ(changed.solution().report.iterations, iterations);
  BindOptions outside;
  outside.outside = OutsidePoints::kNearest;
  changed.set_options(outside);
  PointList<Dim> far = points;
  far.col(3).array() += 100;
  changed.set_model(far, {});
  EXPECT_EQ(changed.bind().outside, std::vector<Index>{3});
}

TEST_IN_2D_AND_3D(RigTest, TakesTheSolutionOfAnother) {
  auto first = rig<Dim>();
  auto second = rig<Dim>();
  second.set_solution(first.solve());
  EXPECT_TRUE(second.weights_of_points() == first.weights_of_points());
  const auto control_points = with_one_moved<Dim>(first.cage().points, 0.05);
  EXPECT_TRUE(second.solve().weights == first.solution().weights) << "converged ones are kept";
  first.reshape(control_points);
  second.reshape(control_points);
  EXPECT_TRUE(second.mesh().points == first.mesh().points) << "it follows the given weights";
  const Eigen::MatrixXd difference =
      second.weights_of_points().dense() - first.weights_of_points().dense();
  EXPECT_LT(difference.array().square().mean(), 1e-6);
  EXPECT_THROW(second.set_solution({}), InputError);
}

TEST_IN_2D_AND_3D(RigTest, WithoutAModelThePointsAreTheVerticesOfTheMesh) {
  const auto [cage, mesh, name] = sample<Dim>();
  Rig<Dim> whole(cage, MadeDomain<Dim>{mesh}, {}, {}, {});
  EXPECT_TRUE(whole.placement().points == mesh.points);
  const auto& solution = whole.solve();
  EXPECT_TRUE(whole.weights_of_points() == solution.weights);
  const auto few = whole.binding().reduced({Dim + 1}).weights;
  for (Index v = 0; v < mesh.num_vertices(); ++v) EXPECT_LE(few.count(v), Dim + 1);
  EXPECT_LT((deform<Dim>(few, cage.points) - mesh.points).cwiseAbs().maxCoeff(), 1e-12);
  // A vertex inside obeys a mask of the control point that it needs least.
  const auto on_boundary = boundary_vertices(build_topology(mesh), mesh.num_vertices());
  const auto found = std::find(on_boundary.begin(), on_boundary.end(), false);
  const auto inside = static_cast<Index>(found - on_boundary.begin());
  Eigen::Index least = 0;
  whole.weights_of_points().at(inside).minCoeff(&least);
  BindOptions options;
  options.masks = {{{static_cast<Index>(least)}, {inside}}};
  whole.set_options(options);
  EXPECT_EQ(whole.masks().masked, 1);
  EXPECT_EQ(whole.weights_of_points().at(inside)[least], 0) << "before it is solved";
  EXPECT_LT((deform<Dim>(whole.weights_of_points(), cage.points) - mesh.points).norm(), 1e-12);
  whole.solve();
  EXPECT_EQ(whole.weights_of_points().at(inside)[least], 0);
  options.mirror_axis = 0;
  expect_refused<OptionError>("of a model", [&] { whole.set_options(options); });
}

// A box with masks on the left for control points on the right, in a cage of many control points.
template <int Dim>
struct MaskedBox {
  Sample<Dim> sample = with_fine_cage<Dim>(Shape::kBox, 4, 8);
  PointList<Dim> points = model<Dim>(sample.mesh);
  BindOptions options{};

  MaskedBox() {
    Mask mask;
    for (Index i = 0; i < sample.cage.size(); ++i) {
      if (sample.cage.points(0, i) > 0.7) mask.control_points.push_back(i);
    }
    for (Index p = 0; p < points.cols(); ++p) {
      if (points(0, p) < 0.5) mask.points.push_back(p);
    }
    options.masks = {mask};
  }

  // Only the control points in the left `part` move to the right, `far`.
  PointList<Dim> squeezed(double part, double far) const {
    PointList<Dim> moved = sample.cage.points;
    for (Index i = 0; i < moved.cols(); ++i) {
      const double x = moved(0, i);
      moved(0, i) = x < part ? x - far : x - far * (1 - x) / (1 - part);
    }
    return moved;
  }
};

// A small change of the weights changes reduced ones less than a reduction that chooses anew, and
// hardly costs more.
TEST_IN_2D_AND_3D(RigTest, AReductionStartsFromTheLastOne) {
  const auto [cage, mesh, name] = with_fine_cage<Dim>(Shape::kBox, 4, 8);
  const auto edges = edges_of_cells(mesh);
  BindOptions options;
  options.max_influences = Dim + 2;
  Rig<Dim> rig(cage, mesh, mesh.points, edges, options);
  const auto first = rig.bind().weights;
  EXPECT_TRUE(rig.bind().weights == first);
  double jump = 0, jump_anew = 0;
  for (const double smoothness : {0.004, 0.003, 0.006}) {
    options.solver.smoothness = smoothness;
    const WeightMatrix before = rig.bind().weights.dense();
    const WeightMatrix before_anew =
        rig.binding().reduced({options.max_influences}).weights.dense();
    rig.set_options(options);
    rig.solve();
    const auto all = rig.binding();
    const auto few = rig.bind().weights;
    const auto anew = all.reduced({options.max_influences}).weights;
    jump += (few.dense() - before).norm();
    jump_anew += (anew.dense() - before_anew).norm();
    const auto cost = [&](const SparseWeights& reduced) {
      return poisson_cost<Dim>(cage.points, mesh.points, edges, all.weights, reduced, {});
    };
    EXPECT_LE(cost(few), 1.05 * cost(anew));
    for (Index p = 0; p < few.num_points(); ++p) EXPECT_LE(few.count(p), options.max_influences);
  }
  EXPECT_LT(jump, jump_anew);
  // With more influences it chooses anew, and for another model as well.
  options.max_influences = Dim + 6;
  rig.set_options(options);
  const auto anew = rig.binding().reduced({options.max_influences}).weights;
  EXPECT_TRUE(rig.bind().weights == anew);
  const PointList<Dim> turned = mesh.points.rowwise().reverse();
  rig.set_model(turned, edges_of_cells(DomainMesh<Dim>{
                            turned, (mesh.num_vertices() - 1 - mesh.cells.array()).matrix()}));
  const auto of_other = rig.binding().reduced({options.max_influences}).weights;
  EXPECT_TRUE(rig.bind().weights == of_other);
}

TEST_IN_2D_AND_3D(RigTest, AShapeThatBreaksAPromiseIsRefused) {
  const MaskedBox<Dim> box;
  BindOptions mirrored;
  mirrored.mirror_axis = 0;
  const std::tuple<BindOptions, PointList<Dim>, const char*> cases[] = {
      {box.options, box.squeezed(0.7, 0.4), "masked vertices cannot follow"},
      {mirrored, with_one_moved<Dim>(box.sample.cage.points, 0.05), "has no mirror image"}};
  for (const auto& [options, control_points, words] : cases) {
    Rig<Dim> rig(box.sample.cage, box.sample.mesh, box.points, {}, options);
    const auto weights = rig.weights_of_points();
    expect_refused(words, [&, &points = control_points] { rig.reshape(points); });
    EXPECT_TRUE(rig.cage().points == box.sample.cage.points);
    EXPECT_TRUE(rig.weights_of_points() == weights);
    rig.set_options({});
    rig.reshape(control_points);
    expect_reproduces<Dim>(rig, box.points);
  }
}

}  // namespace
}  // namespace flbc::testing
