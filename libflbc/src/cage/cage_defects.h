// SPDX-License-Identifier: BSD-3-Clause
// The single checks of which find_defects() is made, in the order in which they must run.
#pragma once

#include <utility>
#include <vector>

#include "flbc/cage.h"

namespace flbc {

//! Collects defects up to a limit.
class DefectList {
 public:
  explicit DefectList(std::size_t limit) : limit_(limit) {}

  bool empty() const { return defects_.empty(); }
  bool is_full() const { return defects_.size() >= limit_; }
  void add(Defect defect) {
    if (!is_full()) defects_.push_back(std::move(defect));
  }
  std::vector<Defect> take() { return std::move(defects_); }

 private:
  std::size_t limit_;
  std::vector<Defect> defects_;
};

//! Counts, finiteness, extent and indices. Only a cage that passes may be given to the other
//! checks.
template <int Dim>
void check_numbers(const Cage<Dim>& cage, DefectList& found);

//! Coinciding and unreferenced control points, and cages that are flat as a whole.
template <int Dim>
void check_points(const Cage<Dim>& cage, DefectList& found);

//! Facets without measure and facets that occur twice.
template <int Dim>
void check_facets(const Cage<Dim>& cage, DefectList& found);

//! How the facets meet: 2D, two edges at each control point.
void check_connections(const Cage<2>& cage, DefectList& found);

//! How the facets meet: 3D, two triangles at each edge, in opposite directions, and one fan of
//! triangles round each control point.
void check_connections(const Cage<3>& cage, DefectList& found);

}  // namespace flbc
