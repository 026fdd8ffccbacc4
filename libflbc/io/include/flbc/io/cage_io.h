// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Makes a cage from the points, polylines, and polygons of a file, and compares two files.
#pragma once

#include <string>
#include <variant>
#include <vector>

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

//! A sound cage as files have it: triangles, in 2D closed polylines.
//! \param height  2D: the z of all points
template <int Dim>
PolygonSoup cage_polygons(const Cage<Dim>& cage, double height = 0);

//! The control points in the file of a pose.
//! \param rest  as returned by control_polygons() \param name  of its file, for messages
//! \throws IoError; InputError unless the file has the same control points in the same order
template <int Dim>
PointList<Dim> read_pose(const std::string& path, const PolygonSoup& rest, const std::string& name);

//! The points of a model in Dim dimensions. \throws InputError naming the vertex if Dim is 2 and
//! the points are not in a plane z = const
template <int Dim>
PointList<Dim> to_points(const PolygonSoup& soup, const std::string& name);

//! Triangulates a polygon in space. A convex quadrilateral is cut along its shorter diagonal,
//! another convex polygon into a fan, and any other by ear clipping. Triangles keep the orientation
//! of the polygon. The cut depends on the places and numbers of the vertices, but neither on which
//! corner comes first nor on the orientation. Of two equal diagonals, the one at the lowest number
//! is taken.
//! \param points  coordinates of all vertices \param polygon  at least 3 vertices
//! \return 3 x (number of corners - 2), vertex indices
FacetList<3> cut_polygon(const std::vector<Vector<3>>& points, const std::vector<Index>& polygon);

//! The same for a polygon given by the coordinates of its corners, at least 3.
//! \return 3 x (number of corners - 2), corner indices
FacetList<3> cut_polygon(const std::vector<Vector<3>>& corners);

//! Checks that vertices with equal numbers are the same in both files, by the polygons that join
//! them. Both files have the same polygons, or divide them in other ways, such as quadrangles into
//! triangles. A pose without polygons passes.
//! \param rest_name, pose_name  of the files, for messages
//! \throws InputError if the numbers of vertices differ, or the polygons, naming the first one
void check_same_vertices(const PolygonSoup& rest, const std::string& rest_name,
                         const PolygonSoup& pose, const std::string& pose_name);

}  // namespace flbc::io
