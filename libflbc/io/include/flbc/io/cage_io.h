// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Makes a cage from the points, polylines, and polygons of a file.
#pragma once

#include <string>
#include <variant>

#include "flbc/cage.h"
#include "flbc/io/model.h"

namespace flbc::io {

//! A cage whose dimension depends on the file.
using AnyCage = std::variant<Cage<2>, Cage<3>>;

//! Makes a 3D cage from polygons, a 2D cage from polylines, or a 2D cage from points alone as one
//! closed polyline. Polygons in a plane z = const are replaced by the polylines, or by their common
//! boundary if there are no polylines; vertices inside of it are left out. Polygons with more than
//! three vertices are triangulated as by cut_polygon(), because the coordinates are linear on
//! triangles. The cage is not validated.
//! \param name  of the file, for messages
//! \throws InputError if a 2D cage is not in a plane z = const, or if polylines occur together with
//! polygons that are not in such a plane
AnyCage to_cage(const PolygonSoup& soup, const std::string& name);

//! The control points that to_cage() makes of a file for Dim dimensions, with the polygons that
//! join them: in 3D those of the file, in 2D the closed polylines of the outline.
template <int Dim>
PolygonSoup control_polygons(const PolygonSoup& soup);

//! The points of a model in Dim dimensions. \throws InputError naming the vertex if Dim is 2 and
//! the points are not in a plane z = const
template <int Dim>
PointList<Dim> to_points(const PolygonSoup& soup, const std::string& name);

}  // namespace flbc::io
