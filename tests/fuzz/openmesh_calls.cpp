// SPDX-License-Identifier: BSD-3-Clause
// Functions of the bindings to OpenMesh with damaged arguments.
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "flbc/openmesh/bind.h"
#include "flbc/openmesh/deform.h"
#include "flbc/openmesh/lbc.h"
#include "flbc/openmesh/sparsify.h"
#include "flbc/openmesh/tet_mesh.h"
#include "fuzz/mutations.h"
#include "support/sample_meshes.h"

namespace flbc::fuzz {
namespace {

using testing::make_sample;
using testing::Shape;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Model = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

const testing::Sample<3>& sample() {
  static const auto instance = make_sample<3>(Shape::kBox, 2, 0.1);
  return instance;
}

// A strip of two triangles in the box.
Model some_model(Mutator& mutator) {
  PointList<3> points(3, 4);
  points << 0.3, 0.7, 0.4, 0.6,  //
      0.2, 0.2, 0.6, 0.6,        //
      0.4, 0.5, 0.5, 0.3;
  mutator.damage(points);
  Model model;
  for (const auto& point : points.colwise()) model.add_vertex({point[0], point[1], point[2]});
  using Vertex = OpenMesh::VertexHandle;
  if (points.cols() == 4) {
    model.add_face({Vertex(0), Vertex(1), Vertex(2)});
    model.add_face({Vertex(2), Vertex(1), Vertex(3)});
  }
  return model;
}

PointList<3> some_pose(Mutator& mutator) {
  PointList<3> pose = sample().cage.points;
  pose(0, 0) += 0.1;
  mutator.damage(pose);
  return pose;
}

void bind_model(Mutator& mutator) {
  auto model = some_model(mutator);
  auto cage = sample().cage;
  auto domain = sample().mesh;
  mutator.damage(cage.points);
  mutator.damage(cage.facets);
  mutator.damage(domain.points);
  mutator.damage(domain.cells);
  openmesh::BindOptions options;
  options.max_influences = mutator.one_of<Index>({0, 4, 8});
  options.outside = mutator.one_of({OutsidePoints::kFail, OutsidePoints::kNearest});
  options.solver.max_iterations = 12;
  openmesh::internal::bind_to<3>(model, cage, &domain, {}, options);
  openmesh::deform(model, some_pose(mutator));
  openmesh::restore_rest(model);
}

void attach_weights(Mutator& mutator) {
  auto model = some_model(mutator);
  WeightMatrix weights = WeightMatrix::Constant(8, 4, 0.125);
  mutator.damage(weights);
  if (mutator.below(2) == 0) {
    openmesh::set_weights(model, weights);
  } else {
    openmesh::set_influences(model, weights);
  }
  if (mutator.below(2) == 0) openmesh::sparsify(model, some_pose(mutator), 4);
  openmesh::deform(model, some_pose(mutator));
}

void solve_on_cells(Mutator& mutator) {
  auto cage = sample().cage;
  auto domain = sample().mesh;
  mutator.damage(domain.points);
  mutator.damage(domain.cells);
  auto mesh = openmesh::TetMesh::from(domain);
  mutator.damage(cage.points);
  mutator.damage(cage.facets);
  SolverOptions options;
  options.max_iterations = 12;
  openmesh::solve(mesh, cage, options, {});
  openmesh::deform(mesh, some_pose(mutator));
}

}  // namespace

std::vector<Call> openmesh_calls() {
  return {{"bind_openmesh", bind_model},
          {"weights_openmesh", attach_weights},
          {"solve_openmesh", solve_on_cells}};
}

}  // namespace flbc::fuzz
