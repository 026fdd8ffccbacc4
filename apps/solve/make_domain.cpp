// SPDX-License-Identifier: BSD-3-Clause
#include "solve/make_domain.h"

#include "files/load.h"
#include "flbc/errors.h"

namespace flbc::app {
namespace {

DomainMesh<2> mesh_cage([[maybe_unused]] const Cage<2>& cage,
                        [[maybe_unused]] const MeshingOptions<2>& options) {
#ifdef FLBC_WITH_CGAL
  return triangulate(cage, options);
#else
  throw OptionError(
      "this flbc was built without CGAL and cannot mesh in 2D; give a mesh by --domain");
#endif
}

DomainMesh<3> mesh_cage([[maybe_unused]] const Cage<3>& cage,
                        [[maybe_unused]] const MeshingOptions<3>& options) {
#ifdef FLBC_WITH_TETGEN
  return tetrahedralize(cage, options);
#else
  throw OptionError(
      "this flbc was built without TetGen and cannot mesh in 3D; give a mesh by --domain");
#endif
}

}  // namespace

template <int Dim>
DomainMesh<Dim> make_domain(const std::string& cage_file, const Cage<Dim>& cage, Index vertices,
                            const std::string& embedded_file, const PointList<Dim>& model,
                            double time_limit) {
  MeshingOptions<Dim> options;
  if (!embedded_file.empty()) options.embedded_points = model;
  options.vertices = vertices > 0 ? vertices : kDefaultVertices;
  options.time_limit = time_limit;
  const auto name = embedded_file.empty() ? cage_file : cage_file + " with " + embedded_file;
  return naming(name, [&] {
    try {
      return mesh_cage(cage, options);
    } catch (const OptionError&) {  // too few for this cage or model, or far too many
      const Index asked = options.vertices;
      options.vertices = 0;
      auto domain = mesh_cage(cage, options);
      if (domain.num_vertices() < asked) throw;
      return domain;
    }
  });
}

std::string note_on_count(Index asked, Index count) {
  constexpr double kTolerance = 1.1;  // promised by MeshingOptions
  if (asked == 0 || count <= kTolerance * asked) return "";
  return "cells of good shape take " + std::to_string(count) + " vertices in this cage, more than " +
         std::to_string(asked) + " (--vertices)";
}

template <int Dim>
CoarseMesher<Dim> coarse_mesher() {
#ifndef FLBC_WITH_CGAL
  if (Dim == 2) return {};
#endif
#ifndef FLBC_WITH_TETGEN
  if (Dim == 3) return {};
#endif
  // A mesher that fails on so few vertices must not keep the solve waiting.
  constexpr double kTimeLimit = 60;
  return [](const Cage<Dim>& cage, Index vertices) {
    MeshingOptions<Dim> options;
    options.vertices = vertices;
    options.roughly = true;
    options.time_limit = kTimeLimit;
    return mesh_cage(cage, options);
  };
}

template CoarseMesher<2> coarse_mesher();
template CoarseMesher<3> coarse_mesher();
template DomainMesh<2> make_domain(const std::string&, const Cage<2>&, Index, const std::string&,
                                   const PointList<2>&, double);
template DomainMesh<3> make_domain(const std::string&, const Cage<3>&, Index, const std::string&,
                                   const PointList<3>&, double);

}  // namespace flbc::app
