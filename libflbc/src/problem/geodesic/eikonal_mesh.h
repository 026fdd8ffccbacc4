// SPDX-License-Identifier: BSD-3-Clause
// The mesh in the form used by fast marching, shared by all sources.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "flbc/domain_mesh.h"
#include "mesh/vertex_cells.h"
#include "problem/geodesic/simplex_ray.h"

namespace flbc::distance {

//! An edge as seen from one end.
struct EdgeTo {
  Index vertex;
  float length;
};

//! A corner of a cell or facet, packed into one integer, because lists of them are read for every
//! vertex.
class Corner {
 public:
  Corner() = default;
  Corner(Index simplex, int corner)
      : code_(static_cast<std::uint32_t>(simplex) * 16 + (1u << corner)) {}
  std::size_t simplex() const { return code_ / 16; }
  unsigned bit() const { return code_ % 16; }  //!< 1 << corner
  int corner() const { return __builtin_ctz(code_); }

 private:
  std::uint32_t code_;
};

//! Conditions under which a passed corner of a cell can be improved by a corner that is passed
//! later. The angle between their edge and another edge must be obtuse, and the corner must not be
//! much nearer to the source.
struct LookBack {
  std::uint16_t obtuse;  //!< bit 4 o + c: obtuse angle at corner c between the edge to o and
                         //!< another edge
  float latest;          //!< maximum delay of a plane wave between c and such an o
  float longest2;        //!< squared length of the longest such edge

  //! The corners that corner o may improve, as bits.
  unsigned obtuse_beside(int o) const { return obtuse >> (4 * o) & 15u; }

  //! Whether a ray through the cell can reduce the distance `of_corner` of a corner, if a corner
  //! passed later has the distance `of_other`. Applies the law of cosines with the largest possible
  //! angle between the ray and their edge.
  bool can_help(float of_corner, float of_other) const {
    return (of_other - of_corner) * (of_other + of_corner) < longest2 + 2 * latest * of_corner;
  }
};

//! A cell of a 2D mesh.
struct alignas(32) TriangleCell : Triangle {
  Index corners[3];
};

//! A cell with its vertices.
template <int Dim>
using EikonalCell = std::conditional_t<Dim == 2, TriangleCell, Tetrahedron>;

//! \param topology  must outlive this object
template <int Dim>
struct EikonalMesh {
  std::vector<EikonalCell<Dim>> cells;
  std::vector<LookBack> look_back;  //!< of each cell
  VertexItems<Corner> corners;      //!< per vertex: its corners in cells; ascending
  VertexItems<EdgeTo> edges;        //!< from each vertex
  float mean_length = 0;            //!< of edges
  const MeshTopology<Dim>& topology;

  // Only in 3D, where rays also run within facets:
  std::vector<Triangle> facets;
  VertexItems<Corner> bends;  //!< facet corners opposite to a side around which paths may bend, for
                              //!< both ends of the side

  EikonalMesh(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology);

  Index num_vertices() const { return static_cast<Index>(edges.start.size()) - 1; }
};

}  // namespace flbc::distance
