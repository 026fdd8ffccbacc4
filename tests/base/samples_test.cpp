// SPDX-License-Identifier: BSD-3-Clause
// The sample cages and models of meshes/ keep the promises of meshes/README.md.
#include <filesystem>

#include "flbc/io/model_file.h"
#include "support/test.h"

namespace flbc {
namespace {

using io::PolygonSoup;
using Point = Vector<3>;
using Polygon = std::vector<Index>;

constexpr double kPi = 3.14159265358979323846;
constexpr double kMargin = 0.02;  // between model and cage, in diagonals of the cage

PolygonSoup load(const std::string& name) {
  return io::read_polygons(std::string(FLBC_MESHES_DIR) + "/" + name + ".obj");
}

// The names, without extension, of the files of a folder that end like this.
std::vector<std::string> names(const std::string& folder, const std::string& ending) {
  std::vector<std::string> found;
  const std::filesystem::path path = std::filesystem::path(FLBC_MESHES_DIR) / folder;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    const std::string name = entry.path().stem().string();
    if (name.size() < ending.size() || entry.path().extension() != ".obj") continue;
    if (name.substr(name.size() - ending.size()) == ending) found.push_back(folder + "/" + name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string with_ending(const std::string& cage, const std::string& ending) {
  return cage.substr(0, cage.rfind("_cage")) + ending;
}

double diagonal(const PolygonSoup& soup) {
  Eigen::AlignedBox3d box;
  for (const Point& point : soup.points) box.extend(point);
  return box.diagonal().norm();
}

// Directed edges; each may occur only once, or two adjacent faces have inconsistent orientation.
std::set<std::pair<Index, Index>> directed_edges(const std::vector<Polygon>& polygons) {
  std::set<std::pair<Index, Index>> edges;
  for (const Polygon& polygon : polygons) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const std::pair<Index, Index> edge{polygon[k], polygon[(k + 1) % polygon.size()]};
      EXPECT_TRUE(edges.insert(edge).second) << "edge " << edge.first << " " << edge.second;
    }
  }
  return edges;
}

Index euler_characteristic(const PolygonSoup& soup) {
  std::set<std::pair<Index, Index>> edges;
  for (const auto& [a, b] : directed_edges(soup.polygons)) edges.insert(std::minmax(a, b));
  return static_cast<Index>(soup.points.size() + soup.polygons.size() - edges.size());
}

void expect_distinct_and_used(const PolygonSoup& soup, const std::vector<Polygon>& elements) {
  std::set<std::vector<double>> places;
  for (const Point& p : soup.points) places.insert({p.x(), p.y(), p.z()});
  EXPECT_EQ(places.size(), soup.points.size()) << "duplicate points";
  std::set<Index> used;
  for (const Polygon& element : elements) used.insert(element.begin(), element.end());
  EXPECT_EQ(used.size(), soup.points.size()) << "points without an element";
}

// The faces around each vertex form one closed fan, as on a surface without pinches.
void expect_closed_fans(const PolygonSoup& soup) {
  std::map<Index, std::map<Index, Index>> fans;
  for (const Polygon& t : soup.polygons) {
    for (int k = 0; k < 3; ++k) fans[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
  }
  for (const auto& [vertex, fan] : fans) {
    std::size_t steps = 0;
    Index at = fan.begin()->first;
    do {
      ASSERT_EQ(fan.count(at), 1u) << "open at vertex " << vertex;
      at = fan.at(at);
      ++steps;
    } while (at != fan.begin()->first && steps <= fan.size());
    EXPECT_EQ(steps, fan.size()) << "pinched at vertex " << vertex;
  }
}

void expect_closed_outward_surface(const PolygonSoup& soup, Index euler) {
  expect_distinct_and_used(soup, soup.polygons);
  double six_volumes = 0;
  for (const Polygon& t : soup.polygons) {
    ASSERT_EQ(t.size(), 3u);
    const Point &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
    EXPECT_GT((b - a).cross(c - a).norm(), 1e-5);
    six_volumes += a.dot(b.cross(c));
  }
  EXPECT_GT(six_volumes, 0);
  const auto edges = directed_edges(soup.polygons);
  for (const auto& [a, b] : edges) EXPECT_EQ(edges.count({b, a}), 1u) << a << " " << b;
  expect_closed_fans(soup);
  EXPECT_EQ(euler_characteristic(soup), euler);
}

double cross2(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// How often the cage turns around a point: angles of its edges in 2D, solid angles of its
// triangles in 3D (the formula with the triple product in an arctangent).
double winding_number(const PolygonSoup& cage, const Point& at) {
  double turns = 0;
  for (const Polygon& line : cage.polylines) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Point a = cage.points[line[k]] - at, b = cage.points[line[k + 1]] - at;
      turns += std::atan2(cross2(a, b), a.dot(b)) / (2 * kPi);
    }
  }
  for (const Polygon& t : cage.polygons) {
    const Point a = (cage.points[t[0]] - at).normalized(),
                b = (cage.points[t[1]] - at).normalized(),
                c = (cage.points[t[2]] - at).normalized();
    turns += std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a)) / (2 * kPi);
  }
  return turns;
}

// Moved by the margin along any axis, every vertex is still inside.
void expect_inside(const PolygonSoup& cage, const PolygonSoup& model, int dim) {
  const double step = kMargin * diagonal(cage);
  for (const Point& vertex : model.points) {
    ASSERT_NEAR(winding_number(cage, vertex), 1, 1e-9) << vertex.transpose();
    for (int axis = 0; axis < dim; ++axis) {
      const Point offset = step * Point::Unit(axis);
      ASSERT_NEAR(winding_number(cage, vertex + offset), 1, 1e-9) << vertex.transpose();
      ASSERT_NEAR(winding_number(cage, vertex - offset), 1, 1e-9) << vertex.transpose();
    }
  }
}

// Every loop is closed, and every control point has its one place in one loop.
void expect_closed_loops(const PolygonSoup& cage) {
  expect_distinct_and_used(cage, cage.polylines);
  std::size_t places = 0;
  for (const Polygon& line : cage.polylines) {
    EXPECT_EQ(line.front(), line.back());
    places += line.size() - 1;
  }
  EXPECT_EQ(places, cage.points.size());
  for (const Point& point : cage.points) EXPECT_EQ(point.z(), 0);
}

void expect_no_crossing_edges(const PolygonSoup& cage) {
  std::vector<std::pair<Index, Index>> edges;
  for (const Polygon& line : cage.polylines) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) edges.emplace_back(line[k], line[k + 1]);
  }
  const auto side = [&](const std::pair<Index, Index>& edge, Index point) {
    const Point& a = cage.points[edge.first];
    return cross2(cage.points[edge.second] - a, cage.points[point] - a);
  };
  for (const auto& e : edges) {
    for (const auto& g : edges) {
      const bool crossing =
          side(e, g.first) * side(e, g.second) < 0 && side(g, e.first) * side(g, e.second) < 0;
      EXPECT_FALSE(crossing) << e.first << " " << e.second << " and " << g.first << " " << g.second;
    }
  }
}

TEST(SamplesTest, PlanarCagesAndModels) {
  const std::vector<std::string> cages = names("2d", "_cage");
  ASSERT_GE(cages.size(), 3u);
  for (const std::string& name : cages) {
    SCOPED_TRACE(name);
    const PolygonSoup cage = load(name), model = load(with_ending(name, "_model"));
    const Index holes = name == "2d/ring_cage" ? 1 : 0;
    EXPECT_EQ(cage.polylines.size(), static_cast<std::size_t>(1 + holes));
    expect_closed_loops(cage);
    expect_no_crossing_edges(cage);
    expect_distinct_and_used(model, model.polygons);
    EXPECT_EQ(euler_characteristic(model), 1 - holes);
    for (const Polygon& t : model.polygons) {
      const Point& a = model.points[t[0]];
      ASSERT_EQ(t.size(), 3u);
      EXPECT_GT(cross2(model.points[t[1]] - a, model.points[t[2]] - a), 1e-5);
    }
    expect_inside(cage, model, 2);
  }
}

TEST(SamplesTest, SpatialCagesAndModels) {
  const std::vector<std::string> cages = names("3d", "_cage");
  ASSERT_GE(cages.size(), 3u);
  for (const std::string& name : cages) {
    SCOPED_TRACE(name);
    const PolygonSoup cage = load(name), model = load(with_ending(name, "_model"));
    const bool is_ring = name == "3d/torus_cage" || name == "3d/knot_cage";
    const Index euler = is_ring ? 0 : 2;
    expect_closed_outward_surface(cage, euler);
    expect_closed_outward_surface(model, euler);
    expect_inside(cage, model, 3);
  }
}

TEST(SamplesTest, PosesDifferFromTheirCagesInCoordinatesOnly) {
  std::vector<std::string> poses = names("2d", "_cage_pose");
  ASSERT_GE(poses.size(), 1u);
  const std::vector<std::string> spatial = names("3d", "_cage_pose");
  ASSERT_GE(spatial.size(), 1u);
  poses.insert(poses.end(), spatial.begin(), spatial.end());
  for (const std::string& name : poses) {
    SCOPED_TRACE(name);
    const PolygonSoup pose = load(name), cage = load(with_ending(name, "_cage"));
    EXPECT_EQ(pose.polylines, cage.polylines);
    EXPECT_EQ(pose.polygons, cage.polygons);
    ASSERT_EQ(pose.points.size(), cage.points.size());
    double farthest = 0;
    for (std::size_t i = 0; i < pose.points.size(); ++i) {
      farthest = std::max(farthest, (pose.points[i] - cage.points[i]).norm());
    }
    EXPECT_GT(farthest, 0.1 * diagonal(cage));
    if (pose.polylines.empty()) {
      expect_closed_outward_surface(pose, 2);
    } else {
      expect_closed_loops(pose);
      expect_no_crossing_edges(pose);
    }
  }
}

}  // namespace
}  // namespace flbc
