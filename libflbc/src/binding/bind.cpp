// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/bind.h"

#include "flbc/deform.h"
#include "flbc/rig.h"

namespace flbc {

template <int Dim>
PointList<Dim> Binding<Dim>::deform(const PointList<Dim>& control_points) const {
  PointList<Dim> moved = flbc::deform<Dim>(weights, control_points);
  if (offsets.cols() > 0) moved += offsets;
  return moved;
}

template <int Dim>
Binding<Dim> bind(const Cage<Dim>& cage, const PointList<Dim>& points, const EdgeList& edges,
                  const BindOptions& options, const Meshers<Dim>& meshers) {
  return Rig<Dim>(cage, points, edges, options, meshers).bind();
}

template <int Dim>
Binding<Dim> bind(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                  const PointList<Dim>& points, const EdgeList& edges, const BindOptions& options) {
  return Rig<Dim>(cage, domain, points, edges, options).bind();
}

#define FLBC_INSTANTIATE(Dim)                                                                 \
  template struct Binding<Dim>;                                                               \
  template Binding<Dim> bind(const Cage<Dim>&, const PointList<Dim>&, const EdgeList&,        \
                             const BindOptions&, const Meshers<Dim>&);                        \
  template Binding<Dim> bind(const Cage<Dim>&, const DomainMesh<Dim>&, const PointList<Dim>&, \
                             const EdgeList&, const BindOptions&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc
