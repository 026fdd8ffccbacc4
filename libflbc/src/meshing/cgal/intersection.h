// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What CGAL::intersection() returns: a variant of Boost before CGAL 6, of the standard since.
#pragma once

#include <CGAL/version.h>
#if CGAL_VERSION_NR < 1060000000
#include <boost/variant.hpp>
#else
#include <variant>
#endif

namespace flbc {

//! \return null if it holds another shape
template <class Shape, class Variant>
const Shape* shape_in(const Variant& common) {
#if CGAL_VERSION_NR < 1060000000
  return boost::get<Shape>(&common);
#else
  return std::get_if<Shape>(&common);
#endif
}

template <class Action, class Variant>
auto visit_shape(const Action& action, const Variant& common) {
#if CGAL_VERSION_NR < 1060000000
  return boost::apply_visitor(action, common);
#else
  return std::visit(action, common);
#endif
}

}  // namespace flbc
