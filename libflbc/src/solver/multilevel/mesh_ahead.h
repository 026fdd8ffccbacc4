// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The first coarse mesh, made while the finest one is set up.
#pragma once

#include <omp.h>

#include <future>
#include <memory>
#include <vector>

#include "flbc/coarse_to_fine.h"
#include "problem/unit_scale.h"

namespace flbc {

//! Calls a mesher for the first of some sizes at once, from a thread of its own if there are
//! several.
template <int Dim>
class MeshAhead {
 public:
  //! \param mesh  the finest, unscaled like its cage \param mesher  outlives this
  MeshAhead(const Cage<Dim>& cage, const std::vector<Index>& sizes, const CoarseMesher<Dim>& mesher)
      : mesher_(mesher) {
    if (sizes.empty() || omp_get_max_threads() == 1) return;
    auto scaled = cage;
    scaled.points = UnitScale<Dim>(cage)(cage.points);
    first_ = std::make_shared<std::future<DomainMesh<Dim>>>(std::async(
        std::launch::async | std::launch::deferred, [&mesher, scaled, size = sizes.front()] {
          omp_set_num_threads(1);  // the others have work
          return mesher(scaled, size);
        }));
  }

  //! \return a mesher of the same meshes, whose first call waits for the one that has begun
  CoarseMesher<Dim> mesher() const {
    if (!first_) return mesher_;
    return [first = first_, &mesher = mesher_](const Cage<Dim>& cage, Index vertices) {
      return first->valid() ? first->get() : mesher(cage, vertices);
    };
  }

 private:
  const CoarseMesher<Dim>& mesher_;
  std::shared_ptr<std::future<DomainMesh<Dim>>> first_;
};

}  // namespace flbc
