// SPDX-License-Identifier: BSD-3-Clause
// Cost of iterating on a mesh's properties instead of plain arrays:
//
//   flbc_bench_properties [PAIRS]
//
// On a generated domain in 2D (a triangle mesh of OpenMesh's) and in 3D (a TetMesh), alternates
// fixed numbers of iterations on both and prints, as comma-separated values, the seconds in the
// iteration of the last pair and the median of the pairs' ratios. No files, no options that could
// differ.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "flbc/meshing.h"
#include "flbc/openmesh/lbc.h"

namespace {

using namespace flbc;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

// A star with 2 k corners.
Cage<2> make_cage_2d(Index k) {
  Cage<2> cage;
  cage.points.resize(2, 2 * k);
  cage.facets.resize(2, 2 * k);
  for (Index i = 0; i < 2 * k; ++i) {
    const double angle = M_PI * i / k;
    const double radius = i % 2 == 0 ? 1 : 0.6;
    cage.points.col(i) << radius * std::cos(angle), radius * std::sin(angle);
    cage.facets.col(i) << i, (i + 1) % (2 * k);
  }
  return cage;
}

// A bumpy ball: rings of k points between two poles.
Cage<3> make_cage_3d(Index k) {
  const Index rings = k / 2;
  Cage<3> cage;
  cage.points.resize(3, rings * k + 2);
  std::vector<Vector<3>> facets;
  const auto at = [&](Index ring, Index i) { return ring * k + i % k; };
  for (Index ring = 0; ring < rings; ++ring) {
    const double polar = M_PI * (ring + 1) / (rings + 1);
    for (Index i = 0; i < k; ++i) {
      const double angle = 2 * M_PI * i / k;
      const double radius = (ring + i) % 2 == 0 ? 1 : 0.8;
      cage.points.col(at(ring, i)) << radius * std::sin(polar) * std::cos(angle),
          radius * std::sin(polar) * std::sin(angle), radius * std::cos(polar);
    }
  }
  const Index north = rings * k;
  const Index south = north + 1;
  cage.points.col(north) << 0, 0, 1;
  cage.points.col(south) << 0, 0, -1;
  for (Index i = 0; i < k; ++i) {
    facets.emplace_back(north, at(0, i), at(0, i + 1));
    facets.emplace_back(south, at(rings - 1, i + 1), at(rings - 1, i));
    for (Index ring = 0; ring + 1 < rings; ++ring) {
      facets.emplace_back(at(ring, i), at(ring + 1, i), at(ring + 1, i + 1));
      facets.emplace_back(at(ring, i), at(ring + 1, i + 1), at(ring, i + 1));
    }
  }
  cage.facets.resize(3, facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) cage.facets.col(f) = facets[f].cast<Index>();
  return cage;
}

TriMesh to_mesh(const DomainMesh<2>& domain) {
  TriMesh mesh;
  for (Index v = 0; v < domain.num_vertices(); ++v) {
    mesh.add_vertex({domain.points(0, v), domain.points(1, v), 0});
  }
  for (Index s = 0; s < domain.num_cells(); ++s) {
    mesh.add_face(TriMesh::VertexHandle(domain.cells(0, s)),
                  TriMesh::VertexHandle(domain.cells(1, s)),
                  TriMesh::VertexHandle(domain.cells(2, s)));
  }
  return mesh;
}
openmesh::TetMesh to_mesh(const DomainMesh<3>& domain) {
  return openmesh::TetMesh::from(domain);
}

template <int Dim>
void compare(const Cage<Dim>& cage, const DomainMesh<Dim>& domain, Method method, int iterations,
             int pairs) {
  SolverOptions options;
  options.method = method;
  options.tolerance = 1e-30;
  options.max_iterations = iterations;
  options.check_interval = iterations;
  openmesh::PropertyOptions properties;
  properties.keep_state = true;
  properties.restart = true;
  auto mesh = to_mesh(domain);
  std::vector<double> ratios;
  double arrays = 0, on_mesh = 0;
  for (int pair = 0; pair < pairs; ++pair) {
    // Whichever comes second finds warmer caches and memory: take turns.
    for (int turn = 0; turn < 2; ++turn) {
      if ((pair + turn) % 2 == 0) {
        arrays = solve(cage, domain, options).report.seconds.solve;
      } else {
        on_mesh = openmesh::solve(mesh, cage, options, properties).seconds.solve;
      }
    }
    ratios.push_back(on_mesh / arrays);
  }
  std::sort(ratios.begin(), ratios.end());
  std::printf("%s,%s,%d,%d,%.4g,%.4g,%.4g\n", Dim == 2 ? "TriMesh" : "TetMesh",
              method == Method::kValue ? "value" : "gradient", domain.num_vertices(), iterations,
              arrays, on_mesh, ratios[ratios.size() / 2]);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int pairs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 9;
    std::printf("mesh,method,vertices,iterations,arrays_seconds,properties_seconds,ratio\n");
    const auto cage2 = make_cage_2d(13);
    const auto domain2 = triangulate(cage2, {10000});
    compare(cage2, domain2, Method::kValue, 200, pairs);
    compare(cage2, domain2, Method::kGradient, 200, pairs);
    const auto cage3 = make_cage_3d(10);
    const auto domain3 = tetrahedralize(cage3, {6000});
    compare(cage3, domain3, Method::kValue, 100, pairs);
    compare(cage3, domain3, Method::kGradient, 100, pairs);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
