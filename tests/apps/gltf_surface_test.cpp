// SPDX-License-Identifier: BSD-3-Clause
#include "model/surface.h"

#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "flbc/errors.h"
#include "flbc/io/mesh_io.h"
#include "support/io_files.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

using gltf::Surface;

Vector<3> corner(const io::PolygonSoup& soup, const Surface& surface, Eigen::Index t, int k) {
  return soup.points[surface.sources[surface.triangles(k, t)]];
}

// Twice the area along the normal.
Vector<3> area(const io::PolygonSoup& soup, const Surface& surface, Eigen::Index t) {
  const Vector<3> a = corner(soup, surface, t, 0);
  return (corner(soup, surface, t, 1) - a).cross(corner(soup, surface, t, 2) - a);
}

io::PolygonSoup cube() {
  io::PolygonSoup soup;
  for (int k = 0; k < 8; ++k) soup.points.emplace_back(k % 2, k / 2 % 2, k / 4);
  soup.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                   {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return soup;
}

TEST(SurfaceOfModel, NormalsDoNotDependOnHowACubeIsCut) {
  const auto soup = cube();
  const auto surface = gltf::surface_of_model<3>({soup});
  EXPECT_EQ(surface.triangles.cols(), 12);
  EXPECT_EQ(surface.sources, (std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(surface.texture_coordinates.cols(), 0);
  EXPECT_EQ(surface.colors.cols(), 0);
  for (int v = 0; v < 8; ++v) {
    const Vector<3> diagonal = (soup.points[v] - Vector<3>::Constant(0.5)).normalized();
    EXPECT_LT((surface.normals.col(v) - diagonal).norm(), 1e-14);
  }
}

TEST(SurfaceOfModel, SeamsPartVerticesAndEqualValuesDoNot) {
  // Two quadrilaterals side by side. The left and the right have different texture coordinates
  // where they meet at vertex 1, equal ones of different number at vertex 4.
  io::PolygonSoup soup;
  for (int k = 0; k < 6; ++k) soup.points.emplace_back(k % 3, k / 3, 0);
  soup.polygons = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  io::SurfaceAttributes attributes;
  attributes.texture_coordinates.resize(2, 8);
  attributes.texture_coordinates << 0, 0.5, 0.5, 0, 0.6, 1, 1, 0.5,  //
      0, 0, 1, 1, 0, 0, 1, 1;
  attributes.corners = {{{0}, {1}, {2}, {3}}, {{4}, {5}, {6}, {7}}};
  const auto surface = gltf::surface_of_model<3>({soup, attributes});
  EXPECT_EQ(surface.sources, (std::vector<Index>{0, 1, 1, 2, 3, 4, 5}));
  ASSERT_EQ(surface.texture_coordinates.cols(), 7);
  // In glTF the second coordinate points down.
  EXPECT_EQ(surface.texture_coordinates.col(1), Vector<2>(0.5, 1));
  EXPECT_EQ(surface.texture_coordinates.col(2), Vector<2>(0.6, 1));
  EXPECT_EQ(surface.texture_coordinates.col(5), Vector<2>(0.5, 0));
  // Every corner has what its polygon says.
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    EXPECT_GT(area(soup, surface, t).z(), 0);
    const bool is_right =
        (corner(soup, surface, t, 0) + corner(soup, surface, t, 1) + corner(soup, surface, t, 2))
            .x() > 3;
    for (int k = 0; k < 3; ++k) {
      const Index v = surface.triangles(k, t);
      if (surface.sources[v] == 1) {
        EXPECT_EQ(surface.texture_coordinates(0, v), is_right ? 0.6 : 0.5);
      }
    }
  }
}

TEST(SurfaceOfModel, NormalsOfTheFileComeFirst) {
  auto soup = cube();
  io::SurfaceAttributes attributes;
  attributes.normals.setZero(3, 3);
  attributes.normals(2, 0) = -5;
  attributes.normals(1, 2) = 1e-200;  // whose square is 0
  for (const auto& polygon : soup.polygons) attributes.corners.emplace_back(polygon.size());
  for (auto& reference : attributes.corners[0]) reference.normal = 0;  // the bottom
  for (auto& reference : attributes.corners[3]) reference.normal = 2;  // the back
  attributes.corners[5][0].normal = 1;                                 // no direction: none
  const auto surface = gltf::surface_of_model<3>({soup, attributes});
  EXPECT_LT((surface.normals.colwise().norm().array() - 1).abs().maxCoeff(), 1e-15);
  int bottoms = 0, backs = 0;
  for (std::size_t v = 0; v < surface.sources.size(); ++v) {
    const Vector<3> normal = surface.normals.col(v);
    if (normal == Vector<3>(0, 0, -1)) {
      ++bottoms;
    } else if (normal == Vector<3>(0, 1, 0)) {
      ++backs;
    } else {
      const Vector<3> diagonal =
          (soup.points[surface.sources[v]] - Vector<3>::Constant(0.5)).normalized();
      EXPECT_LT((normal - diagonal).norm(), 1e-14);
    }
  }
  EXPECT_EQ(bottoms, 4);
  EXPECT_EQ(backs, 4);
}

TEST(SurfaceOfModel, ColoursBecomeLinear) {
  auto soup = cube();
  io::SurfaceAttributes attributes;
  attributes.colors.setConstant(3, 8, 0.5);
  attributes.colors.col(3) << 0, 1, 0.04;
  const auto surface = gltf::surface_of_model<3>({soup, attributes});
  ASSERT_EQ(surface.colors.cols(), 8);
  // Halfway in sRGB is 21.4 % of the light.
  EXPECT_NEAR(surface.colors(0, 0), 0.21404114, 1e-8);
  EXPECT_EQ(surface.colors(0, 3), 0);
  EXPECT_NEAR(surface.colors(1, 3), 1, 1e-15);
  EXPECT_NEAR(surface.colors(2, 3), 0.04 / 12.92, 1e-15);
}

TEST(SurfaceOfModel, WhatNobodySeesIsLeftOut) {
  auto soup = cube();
  soup.points.insert(soup.points.begin(), Vector<3>(9, 9, 9));
  for (auto& polygon : soup.polygons) {
    for (auto& point : polygon) ++point;
  }
  soup.polygons.push_back({1, 1, 2});
  const auto surface = gltf::surface_of_model<3>({soup});
  EXPECT_EQ(surface.sources, (std::vector<Index>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(surface.triangles.cols(), 12);
  soup.polygons = {{1, 1, 2}};
  expect_error<InputError>([&] { gltf::surface_of_model<3>({soup}); },
                           {"its 1 polygons contain no triangle"});
  expect_error<InputError>([&] { gltf::surface_of_model<2>({}); },
                           {"its 0 polygons contain no triangle"});
}

TEST(SurfaceOfModel, TrianglesWithoutAreaHaveANormalToo) {
  io::PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  soup.polygons = {{0, 1, 2}};
  const auto surface = gltf::surface_of_model<3>({soup});
  EXPECT_EQ(surface.normals, Vector<3>(0, 0, 1).replicate(1, 3));
}

TEST(SurfaceOfModel, In2DAllTrianglesFaceUp) {
  io::PolygonSoup soup;
  soup.points = {{0, 0, 7}, {2, 0, 7}, {2, 2, 7}, {1, 0.5, 7}, {0, 2, 7}};
  soup.polygons = {{0, 1, 3}, {0, 4, 3}, {1, 2, 3}, {3, 2, 4}};
  io::SurfaceAttributes attributes;
  attributes.normals = Vector<3>(0, 0, -1);
  for (const auto& polygon : soup.polygons) attributes.corners.emplace_back(polygon.size());
  for (auto& reference : attributes.corners[0]) reference.normal = 0;
  const auto surface = gltf::surface_of_model<2>({soup, attributes});
  EXPECT_EQ(surface.sources.size(), 5);
  EXPECT_EQ(surface.normals, Vector<3>(0, 0, 1).replicate(1, 5));
  for (Eigen::Index t = 0; t < 4; ++t) EXPECT_GT(area(soup, surface, t).z(), 0);
}

TEST(SurfaceOfDomain, TrianglesOfThePlane) {
  const auto sample = make_sample<2>(Shape::kRing, 3, 0.2);
  const auto surface = gltf::surface_of_model<2>({io::to_polygons(sample.mesh)});
  EXPECT_EQ(surface.triangles, sample.mesh.cells);
  EXPECT_EQ(surface.sources.size(), sample.mesh.num_vertices());
}

TEST(SurfaceOfDomain, BoundaryOfTetrahedraIsClosedAndEnclosesThem) {
  const auto sample = make_sample<3>(Shape::kRing, 3, 0.2);
  const auto& mesh = sample.mesh;
  const auto surface = gltf::surface_of_model<3>({io::to_polygons(mesh)});
  EXPECT_LT(surface.sources.size(), mesh.num_vertices());
  // Every edge is passed once in either direction.
  std::map<std::pair<Index, Index>, int> passes;
  double volume = 0;
  for (const auto& triangle : surface.triangles.colwise()) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      corners.col(k) = mesh.points.col(surface.sources[triangle[k]]);
      ++passes[{triangle[k], triangle[(k + 1) % 3]}];
    }
    volume += corners.determinant() / 6;
  }
  for (const auto& [edge, count] : passes) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(passes.count({edge.second, edge.first}), 1);
  }
  double expected = 0;
  for (Index s = 0; s < mesh.num_cells(); ++s) expected += signed_measure(mesh, s);
  EXPECT_NEAR(volume, expected, 1e-12 * expected);
}

}  // namespace
}  // namespace flbc::testing
