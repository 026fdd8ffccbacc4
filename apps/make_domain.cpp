// SPDX-License-Identifier: BSD-3-Clause
#include "make_domain.h"

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
DomainMesh<Dim> make_domain(const Cage<Dim>& cage, Index vertices,
                            const PointList<Dim>& embedded_points) {
  MeshingOptions<Dim> options;
  options.embedded_points = embedded_points;
  options.vertices = vertices > 0 ? vertices : kDefaultVertices;
  if (vertices > 0) return mesh_cage(cage, options);
  try {
    return mesh_cage(cage, options);
  } catch (const OptionError&) {  // the default is too small for this cage or model
    options.vertices = 0;
    return mesh_cage(cage, options);
  }
}

template DomainMesh<2> make_domain(const Cage<2>&, Index, const PointList<2>&);
template DomainMesh<3> make_domain(const Cage<3>&, Index, const PointList<3>&);

}  // namespace flbc::app
