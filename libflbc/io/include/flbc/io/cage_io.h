// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a file's points, polylines and polygons to a cage.
#pragma once

#include <string>
#include <variant>

#include "flbc/cage.h"
#include "flbc/io/model.h"

namespace flbc::io {

//! A cage whose dimension the file decides.
using AnyCage = std::variant<Cage<2>, Cage<3>>;

//! Polygons make a 3D cage, polylines a 2D cage; points alone are one closed polyline in their
//! order. Polygons in a plane z = const stand for the edges that bound them together, or for the
//! polylines if there are any. Polygons with more than three vertices
//! are cut into triangles, because the coordinates are linear on triangles: along the shorter
//! diagonal if they are convex and have four, fanwise if they are convex, else ear by ear. The cage
//! is not validated. \param name  of the file, for messages \throws InputError if a 2D cage is not
//! in a plane z = const, or polygons that are not in a plane and polylines mix
AnyCage to_cage(const PolygonSoup& soup, const std::string& name);

//! The points of a model in Dim dimensions. \throws InputError naming the vertex if Dim is 2 and
//! the points are not in a plane z = const
template <int Dim>
PointList<Dim> to_points(const PolygonSoup& soup, const std::string& name);

}  // namespace flbc::io
