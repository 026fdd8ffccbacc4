// SPDX-License-Identifier: BSD-3-Clause
// Defective cages become sound, and say what was done to them.
#include "flbc/repair_cage.h"

#include <Eigen/QR>

#include "flbc/cage_facts.h"
#include "flbc/meshing.h"
#include "support/enclosure_judge.h"
#include "support/model_cages.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
RepairedCage<Dim> repair(const Cage<Dim>& cage) {
  auto repaired = repair_cage(cage);
  EXPECT_EQ(find_defects(repaired.cage).size(), 0u);
  EXPECT_EQ(find_self_intersections(repaired.cage).size(), 0u);
  EXPECT_EQ(repaired.new_numbers.size(), static_cast<std::size_t>(cage.size()));
  for (Index v = 0; v < cage.size(); ++v) {
    const Index number = repaired.new_numbers[v];
    EXPECT_LT(number, repaired.cage.size());
    if (repaired.keeps_numbers) {
      EXPECT_EQ(number, v);
    }
    if (number >= 0 && !repaired.is_wrapped) {
      EXPECT_LT((repaired.cage.points.col(number) - cage.points.col(v)).norm(), 1e-5);
    }
  }
  return repaired;
}

bool says(const std::vector<std::string>& changes, const std::string& words) {
  for (const auto& change : changes) {
    if (change.find(words) != std::string::npos) return true;
  }
  return false;
}

template <int Dim>
std::string kind() {
  return Dim == 2 ? "edge " : "triangle ";
}

// The cage encloses what a box of half size 1 does.
template <int Dim>
void expect_box(const Cage<Dim>& cage) {
  EXPECT_NEAR(measure_cage(cage).measure, std::pow(2.0, Dim), 1e-9);
}

template <int Dim>
void expect_united(const RepairedCage<Dim>& repaired, double measure, double tolerance) {
  EXPECT_FALSE(repaired.is_wrapped);
  EXPECT_NEAR(measure_cage(repaired.cage).measure, measure, tolerance);
}

TEST_IN_2D_AND_3D(RepairCageTest, SoundCagesStayAsTheyAre) {
  const auto cage = join(box_cage<Dim>(1), box_cage<Dim>(0.5));
  const auto repaired = repair(cage);
  EXPECT_TRUE(repaired.changes.empty());
  EXPECT_TRUE(repaired.keeps_numbers);
  EXPECT_EQ(repaired.cage.points, cage.points);
  EXPECT_EQ(repaired.cage.facets, cage.facets);
}

// Every facet has separate corners, some of them slightly displaced.
TEST_IN_2D_AND_3D(RepairCageTest, UnweldedCagesAreWelded) {
  const auto box = box_cage<Dim>(1);
  const auto count = static_cast<Index>(box.facets.cols());
  Cage<Dim> loose{PointList<Dim>(Dim, Dim * count), FacetList<Dim>(Dim, count)};
  for (Index f = 0; f < count; ++f) {
    for (int k = 0; k < Dim; ++k) {
      loose.facets(k, f) = Dim * f + k;
      loose.points.col(Dim * f + k) = box.points.col(box.facets(k, f)).array() + 1e-8 * (f % 3);
    }
  }
  const auto repaired = repair(loose);
  EXPECT_EQ(repaired.cage.size(), box.size());
  EXPECT_EQ(repaired.cage.facets.cols(), count);
  EXPECT_FALSE(repaired.is_wrapped);
  EXPECT_FALSE(repaired.keeps_numbers);
  EXPECT_EQ(static_cast<Index>(repaired.changes.size()), loose.size() - box.size());
  EXPECT_TRUE(says(repaired.changes, "is merged into control point "));
  EXPECT_NEAR(measure_cage(repaired.cage).measure, std::pow(2.0, Dim), 1e-6);
}

TEST_IN_2D_AND_3D(RepairCageTest, RepeatedAndDegenerateFacetsGo) {
  const auto box = box_cage<Dim>(1);
  const auto count = box.facets.cols();
  auto cage = box;
  cage.facets.conservativeResize(Dim, count + 2);
  cage.facets.col(count) = box.facets.col(1).reverse();
  cage.facets.col(count + 1).setConstant(2);
  const auto repaired = repair(cage);
  EXPECT_EQ(repaired.cage.facets, box.facets);
  EXPECT_TRUE(repaired.keeps_numbers);
  EXPECT_TRUE(says(repaired.changes,
                   kind<Dim>() + std::to_string(count) + " is the same as " + kind<Dim>() + "1"));
  EXPECT_TRUE(says(repaired.changes,
                   kind<Dim>() + std::to_string(count + 1) + " has the same corner twice"));
}

TEST_IN_2D_AND_3D(RepairCageTest, HolesAreClosed) {
  const auto repaired = repair(without_facet(box_cage<Dim>(1), 1));
  EXPECT_TRUE(repaired.keeps_numbers);
  EXPECT_EQ(repaired.changes.size(), 1u);
  EXPECT_EQ(repaired.measure_before, 0);
  // Half a side, from the middle of the hole.
  EXPECT_GT(repaired.max_distance, 0.5);
  EXPECT_LE(repaired.max_distance, 1);
  expect_box(repaired.cage);
}

TEST_IN_2D_AND_3D(RepairCageTest, FlapsGo) {
  auto cage = box_cage<Dim>(1);
  const Index flap = static_cast<Index>(cage.facets.cols());
  cage.points.conservativeResize(Dim, cage.size() + 1);
  cage.points.rightCols(1).setConstant(-2);
  cage.facets.conservativeResize(Dim, flap + 1);
  cage.facets.col(flap) = cage.facets.col(0);
  cage.facets(Dim - 1, flap) = cage.size() - 1;
  const auto repaired = repair(cage);
  EXPECT_TRUE(says(repaired.changes, kind<Dim>() + std::to_string(flap) + " belongs to a flap"));
  EXPECT_TRUE(says(repaired.changes, "belongs to no facet and is removed"));
  EXPECT_EQ(repaired.new_numbers.back(), -1);
  expect_box(repaired.cage);
}

template <int Dim>
using Boxes = std::vector<Eigen::AlignedBox<double, Dim>>;

template <int Dim>
Eigen::AlignedBox<double, Dim> box(double low, double high) {
  return {Vector<Dim>::Constant(low), Vector<Dim>::Constant(high)};
}

template <int Dim>
Eigen::AlignedBox<double, Dim> moved(Eigen::AlignedBox<double, Dim> box, int axis, double by) {
  return box.translate(by * Vector<Dim>::Unit(axis));
}

template <int Dim>
Cage<Dim> cage_of(const Boxes<Dim>& boxes) {
  Cage<Dim> all{PointList<Dim>(Dim, 0), FacetList<Dim>(Dim, 0)};
  for (const auto& box : boxes) all = join(all, box_cage<Dim>(box.min(), box.max()));
  return all;
}

template <int Dim>
bool covers(const Boxes<Dim>& boxes, const Vector<Dim>& point) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const auto& box) { return box.contains(point); });
}

// By inclusion and exclusion.
template <int Dim>
double measure_of_union(const Boxes<Dim>& boxes) {
  double sum = 0;
  for (std::size_t subset = 1; subset < (std::size_t{1} << boxes.size()); ++subset) {
    Eigen::AlignedBox<double, Dim> common(Vector<Dim>::Constant(-100), Vector<Dim>::Constant(100));
    int count = 0;
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      if ((subset >> b) % 2 == 0) continue;
      common = common.intersection(boxes[b]);
      ++count;
    }
    const double measure = common.isEmpty() ? 0 : common.sizes().prod();
    sum += count % 2 == 1 ? measure : -measure;
  }
  return sum;
}

// Winding numbers at random points say the same as `is_inside`.
template <int Dim, class IsInside>
void expect_inside(const Cage<Dim>& cage, const IsInside& is_inside) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  const Vector<Dim> low = cage.points.rowwise().minCoeff();
  const Vector<Dim> sizes = cage.points.rowwise().maxCoeff() - low;
  for (int k = 0; k < 300; ++k) {
    Vector<Dim> point;
    for (int axis = 0; axis < Dim; ++axis) {
      point(axis) = low(axis) + (1.1 * place(random) - 0.05) * sizes(axis);
    }
    EXPECT_NEAR(std::abs(winding_number(cage, point)), is_inside(point) ? 1 : 0, 1e-6)
        << point.transpose();
  }
}

// Every old point stays if it is on the boundary of the union.
template <int Dim>
RepairedCage<Dim> expect_union(const Boxes<Dim>& boxes) {
  const auto cage = cage_of<Dim>(boxes);
  const auto repaired = repair(cage);
  expect_united(repaired, measure_of_union<Dim>(boxes), 1e-9);
  EXPECT_NEAR(repaired.measure_before, measure_of_union<Dim>(boxes), 1e-9);
  EXPECT_EQ(repaired.max_distance, 0);
  expect_inside(repaired.cage, [&](const auto& point) { return covers<Dim>(boxes, point); });
  for (Index v = 0; v < cage.size(); ++v) {
    const bool is_within = std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) {
      return ((cage.points.col(v) - box.min()).array() > 1e-9).all() &&
             ((box.max() - cage.points.col(v)).array() > 1e-9).all();
    });
    EXPECT_EQ(repaired.new_numbers[v] < 0, is_within) << "control point " << v;
  }
  return repaired;
}

TEST_IN_2D_AND_3D(RepairCageTest, CrossingPartsAreUnited) {
  const auto one = box<Dim>(-1, 1);
  expect_union<Dim>({one, box<Dim>(-0.3, 1.7)});
  expect_union<Dim>({one, box<Dim>(0.2, 1.3), box<Dim>(-1.3, 0.4)});
  // Through each other, sides partly in the same planes.
  expect_union<Dim>({one,
                     {Vector<Dim>::Unit(0) * -2 - Vector<Dim>::Ones() * 0.5,
                      Vector<Dim>::Unit(0) * 2 + Vector<Dim>::Ones() * 0.5}});
  expect_union<Dim>({one, moved<Dim>(one, 0, 0.7)});
}

TEST_IN_2D_AND_3D(RepairCageTest, TouchingPartsAreUnited) {
  const auto one = box<Dim>(0, 1);
  const auto same = expect_union<Dim>({one, moved<Dim>(one, 0, 1)});
  EXPECT_EQ(same.cage.size(), 3 << (Dim - 1));
  Eigen::AlignedBox<double, Dim> small = box<Dim>(0.25, 0.75);
  small = moved<Dim>(small, 0, 0.75);
  const auto part = expect_union<Dim>({one, small});
  EXPECT_EQ(part.cage.size(), 2 << Dim);
  EXPECT_EQ(part.kept, 2 << Dim);
  // The contact reaches over the edge of both.
  expect_union<Dim>({one, moved<Dim>(moved<Dim>(one, 0, 1), 1, 0.4)});
}

// A convex polyhedron between a chord of a ring and the opposite one.
struct Wedge {
  double begin, end;  // angles
  double inner, outer, low, high;

  Cage<3> cage() const {
    auto box = box_cage<3>(Vector<3>::Zero(), Vector<3>::Ones());
    for (auto&& p : box.points.colwise()) {
      const double radius = p.x() > 0 ? outer : inner, angle = p.y() > 0 ? end : begin;
      p = Vector<3>(radius * std::cos(angle), radius * std::sin(angle), p.z() > 0 ? high : low);
    }
    return box;
  }
  bool contains(const Vector<3>& p) const {
    const double middle = (begin + end) / 2, half = (end - begin) / 2;
    const Eigen::Vector2d along(std::cos(middle), std::sin(middle)), q = p.head<2>();
    const Eigen::Vector2d across(-along.y(), along.x());
    const double depth = along.dot(q) / std::cos(half);
    return p.z() >= low && p.z() <= high && depth >= inner && depth <= outer &&
           std::abs(across.dot(q)) <= along.dot(q) * std::tan(half);
  }
};

// A cup as physics programs decompose it: 13 wedges and a bottom, that overlap or touch. What is in
// the cup is outside.
TEST(RepairCage3Test, DecompositionsIntoHullsAreUnited) {
  constexpr int kWedges = 13;
  const double step = 2 * std::acos(-1.0) / kWedges;
  for (const double overlap : {0.0, 0.03}) {
    for (const bool is_rounded : {false, true}) {
      std::vector<Wedge> wedges;
      auto all = box_cage<3>(Vector<3>(-0.7, -0.7, -0.2), Vector<3>(0.7, 0.7, overlap));
      for (int k = 0; k < kWedges; ++k) {
        wedges.push_back({k * step - overlap, (k + 1) * step + overlap, 0.6, 1, 0, 2});
        all = join(all, wedges.back().cage());
      }
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(0.6, Vector<3>(1, 2, 0.5).normalized()).toRotationMatrix();
      if (is_rounded) all.points = (1e6 * turn * all.points).array().round() / 1e6;
      const auto repaired = repair(all);
      EXPECT_FALSE(repaired.is_wrapped);
      EXPECT_EQ(measure_cage(repaired.cage).parts, 1);
      expect_inside(repaired.cage, [&](const Vector<3>& point) {
        const Vector<3> p = is_rounded ? Vector<3>(turn.transpose() * point) : point;
        const bool is_in_bottom =
            (p.head<2>().array().abs() <= 0.7).all() && p.z() >= -0.2 && p.z() <= overlap;
        return is_in_bottom || std::any_of(wedges.begin(), wedges.end(),
                                           [&](const Wedge& wedge) { return wedge.contains(p); });
      });
    }
  }
}

// Of height 1 over a convex outline.
Cage<3> prism_over(const Cage<2>& outline) {
  const Index n = outline.size();
  Cage<3> prism{PointList<3>::Zero(3, 2 * n), FacetList<3>(3, 4 * n - 4)};
  prism.points.leftCols(n).topRows<2>() = outline.points;
  prism.points.rightCols(n).topRows<2>() = outline.points;
  prism.points.rightCols(n).row(2).setOnes();
  Index next = 0;
  for (Index j = 0; j < n; ++j) {
    const Index k = (j + 1) % n;
    prism.facets.col(next++) << j, k, k + n;
    prism.facets.col(next++) << j, k + n, j + n;
    if (j == 0 || k == 0) continue;
    prism.facets.col(next++) << 0, k, j;
    prism.facets.col(next++) << n, j + n, k + n;
  }
  return prism;
}

// Prisms whose ends lie in two planes, in any direction, with coordinates of six digits.
TEST(RepairCage3Test, RoundedPrismsAreUnited) {
  constexpr int kSides = 10;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Cage<2> outlines;
  Cage<3> prisms;
  for (int k = 0; k < 6; ++k) {
    const Eigen::Vector2d center = 0.6 * Eigen::Vector2d(uniform(random), uniform(random));
    const double radius = 0.4 + 0.1 * uniform(random), start = uniform(random);
    Cage<2> outline{PointList<2>(2, kSides), FacetList<2>(2, kSides)};
    for (int j = 0; j < kSides; ++j) {
      const double angle = start + 2 * std::acos(-1.0) * j / kSides;
      outline.points.col(j) = center + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      outline.facets.col(j) << j, (j + 1) % kSides;
    }
    outlines = join(outlines, outline);
    prisms = join(prisms, prism_over(outline));
  }
  const double area = measure_cage(repair(outlines).cage).measure;
  for (int k = 0; k < 16; ++k) {
    const Eigen::Vector4d turn =
        Eigen::Vector4d::NullaryExpr([&] { return uniform(random); }).normalized();
    auto turned = prisms;
    turned.points = Eigen::Quaterniond(turn).toRotationMatrix() * prisms.points;
    turned.points = (1e6 * turned.points).array().round() / 1e6;
    const auto repaired = repair(turned);
    expect_united(repaired, area, 1e-4);
    EXPECT_GT(thinnest_place(repaired.cage).distance, 1e-6);  // so that meshers can fill it
  }
}

// 82 bricks in a running bond touch with parts of their sides.
TEST(RepairCage3Test, WallsOfBricksAreUnited) {
  Boxes<3> bricks;
  for (int course = 0; course < 11; ++course) {
    for (int k = course % 2 == 0 ? 0 : -1; k < 14; k += 2) {
      bricks.emplace_back(Vector<3>(std::max(k, 0), 0, 0.6 * course),
                          Vector<3>(std::min(k + 2, 14), 1, 0.6 * (course + 1)));
    }
  }
  ASSERT_EQ(bricks.size(), 82u);
  for (const bool is_rounded : {false, true}) {
    auto wall = cage_of<3>(bricks);
    if (is_rounded) {
      wall.points = Eigen::AngleAxisd(0.6, Vector<3>(1, 2, 0.5).normalized()).toRotationMatrix() *
                    wall.points;
      wall.points = (1e5 * wall.points).array().round() / 1e5;
    }
    expect_united(repair(wall), 14 * 6.6, 1e-3);
  }
}

// Plates that cross each other, in any direction: rounded crossings are close to each other.
TEST_IN_2D_AND_3D(RepairCageTest, CrossingPlatesAreUnited) {
  std::mt19937 random(5);
  std::normal_distribution<double> number;
  Boxes<Dim> boxes;
  for (int axis = 0; axis < Dim; ++axis) {
    for (const double place : {-0.4, 0.3}) {
      Vector<Dim> half = Vector<Dim>::Ones();
      half(axis) = 0.02;
      const Vector<Dim> center = place * Vector<Dim>::Unit(axis);
      boxes.emplace_back(center - half, center + half);
    }
  }
  for (int round = 0; round < 4; ++round) {
    auto cage = cage_of<Dim>(boxes);
    Eigen::Matrix<double, Dim, Dim> turn;
    for (double& x : turn.reshaped()) x = number(random);
    turn = turn.householderQr().householderQ();
    cage.points = turn * cage.points;
    const auto repaired = repair(cage);
    expect_united(repaired, measure_of_union<Dim>(boxes), 1e-5);
  }
}

// Plates that lean all ways: what is inside one of them is inside the union.
TEST(RepairCage3Test, LeaningPlatesAreUnited) {
  std::mt19937 random(2);
  std::normal_distribution<double> number;
  for (int round = 0; round < 4; ++round) {
    std::vector<Eigen::Matrix3d> turns;
    const Eigen::AlignedBox3d plate(Vector<3>(-0.01, -0.7, -1), Vector<3>(0.01, 0.7, 1));
    Cage<3> all{PointList<3>(3, 0), FacetList<3>(3, 0)};
    for (int k = 0; k < 4; ++k) {
      const Eigen::Quaterniond turn(number(random), number(random), number(random), number(random));
      turns.push_back(turn.normalized().toRotationMatrix());
      auto one = box_cage<3>(plate.min(), plate.max());
      one.points = turns.back() * one.points;
      all = join(all, one);
    }
    const auto repaired = repair(all);
    EXPECT_FALSE(repaired.is_wrapped);
    expect_inside(repaired.cage, [&](const Vector<3>& point) {
      return std::any_of(turns.begin(), turns.end(), [&](const Eigen::Matrix3d& turn) {
        return plate.contains(Vector<3>(turn.transpose() * point));
      });
    });
  }
}

// A wall without thickness encloses nothing, even if it reaches out of the cage.
TEST_IN_2D_AND_3D(RepairCageTest, SheetsThatPassThroughGo) {
  Cage<Dim> sheet{PointList<Dim>(Dim, 1 << (Dim - 1)), FacetList<Dim>(Dim, Dim - 1)};
  for (Index v = 0; v < sheet.size(); ++v) {
    const double far = v % 2 == 0 ? -1.7 : 1.6;
    sheet.points(0, v) = 0.1 * far;
    sheet.points(1, v) = far;
    if (Dim == 3) sheet.points(Dim - 1, v) = v < 2 ? -0.3 : 1.4;
  }
  for (int f = 0; f < Dim - 1; ++f) {
    for (int k = 0; k < Dim; ++k) sheet.facets(k, f) = f + k;
  }
  auto across = sheet;
  across.points.row(0).swap(across.points.row(1));
  const auto repaired = repair(join(join(box_cage<Dim>(1), sheet), across));
  EXPECT_FALSE(repaired.is_wrapped);
  EXPECT_TRUE(says(repaired.changes, "belongs to a flap"));
  expect_box(repaired.cage);
}

// The walls of an open channel touch its rims, whose holes are closed all the same.
TEST(RepairCage3Test, OpenChannelsWithWallsAreClosed) {
  const auto quad = [](const Vector<3>& corner, const Vector<3>& u, const Vector<3>& v) {
    Cage<3> both{PointList<3>(3, 4), FacetList<3>(3, 2)};
    both.points << corner, corner + u, corner + u + v, corner + v;
    both.facets << 0, 0, 1, 2, 2, 3;
    return both;
  };
  const Vector<3> x = Vector<3>::UnitX(), y = Vector<3>::UnitY(), z = Vector<3>::UnitZ();
  const Vector<3> origin = Vector<3>::Zero();
  Cage<3> all = quad(origin, x, 3 * z);
  for (const auto& other :
       {quad(2 * y, x, 3 * z), quad(origin, 2 * y, 3 * z), quad(x, 2 * y, 3 * z),
        quad(0.5 * x, 2 * y, 3 * z), quad(y, x, 3 * z)}) {
    all = join(all, other);
  }
  const auto repaired = repair(all);
  expect_united(repaired, 6, 1e-9);
}

// Parts touch only within the tolerance, or miss each other by little more.
TEST_IN_2D_AND_3D(RepairCageTest, RoundedPartsThatTouchAreRepaired) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> error(-1, 1);
  const auto one = box<Dim>(0, 1);
  for (const double scale : {1e-9, 1e-7, 1e-6, 3e-6}) {
    auto cage = cage_of<Dim>({one, moved<Dim>(moved<Dim>(one, 0, 1), 1, 0.4)});
    for (double& x : cage.points.reshaped()) x += scale * error(random);
    const auto repaired = repair(cage);
    if (scale <= 1e-7) {
      expect_united(repaired, 2, 1e-5);
    }
  }
}

// The corners of facets that share none are apart by more than the tolerance.
TEST_IN_2D_AND_3D(RepairCageTest, CornersThatAreNearlyTheSameAreMerged) {
  std::mt19937 random(4);
  for (const double gap : {1e-5, 1e-4, 1e-3}) {
    std::uniform_real_distribution<double> error(-gap, gap);
    const auto box = box_cage<Dim>(1);
    Cage<Dim> cage{PointList<Dim>(Dim, box.facets.size()), box.facets};
    std::iota(cage.facets.reshaped().begin(), cage.facets.reshaped().end(), 0);
    cage.points = box.points(Eigen::all, box.facets.reshaped());
    for (double& x : cage.points.reshaped()) x += error(random);
    const auto repaired = repair_cage(cage);
    EXPECT_FALSE(repaired.is_wrapped);
    EXPECT_EQ(repaired.cage.size(), box.size());
    EXPECT_NEAR(measure_cage(repaired.cage).measure, 1 << Dim, 20 * gap);
    EXPECT_TRUE(says(repaired.changes, "apart are merged"));
  }
}

// A hole that touches the boundary with a corner (2D) or a side (3D) stays a hole. A box with a
// side in that of another one and the same orientation may be a part of a decomposition.
TEST_IN_2D_AND_3D(RepairCageTest, HolesThatTouchTheBoundaryStay) {
  auto hole = box_cage<Dim>(0.5);
  if constexpr (Dim == 2)
    hole.points = Eigen::Rotation2Dd(std::atan(1)).toRotationMatrix() * hole.points;
  hole.points.row(0).array() -= 1 + hole.points.row(0).minCoeff();
  const auto repaired = repair(join(box_cage<Dim>(1), reversed(hole)));
  EXPECT_FALSE(repaired.is_wrapped);
  EXPECT_NEAR(measure_cage(repaired.cage).measure, (1 << Dim) - 1, 1e-3);
  const auto united = repair(join(box_cage<Dim>(1), hole));
  EXPECT_NEAR(measure_cage(united.cage).measure, Dim == 2 ? 3 : 8, 1e-3);
}

TEST(RepairCage3Test, AFlatCageEnclosesNothing) {
  Cage<3> cage{PointList<3>(3, 4), FacetList<3>(3, 4)};
  cage.points << 0, 2, 2, 0, 0, 0, 2, 2, 1, 1, 1, 1;
  cage.facets << 0, 0, 0, 1, 2, 1, 3, 2, 1, 3, 2, 3;
  EXPECT_THROW(repair_cage(cage), InputError);
}

TEST_IN_2D_AND_3D(RepairCageTest, InnerWallsGo) {
  auto cage = repair(cage_of<Dim>({box<Dim>(0, 1), moved<Dim>(box<Dim>(0, 1), 0, 1)})).cage;
  const auto count = static_cast<Index>(cage.facets.cols());
  // The common side, of control points in the plane x = 1.
  std::vector<Index> side;
  for (Index v = 0; v < cage.size(); ++v) {
    if (cage.points(0, v) == 1) side.push_back(v);
  }
  ASSERT_EQ(side.size(), std::size_t{1} << (Dim - 1));
  cage.facets.conservativeResize(Dim, count + (Dim - 1));
  for (int f = 0; f < Dim - 1; ++f) {
    for (int k = 0; k < Dim; ++k) cage.facets(k, count + f) = side[f + k];
  }
  const auto repaired = repair(cage);
  EXPECT_FALSE(repaired.is_wrapped);
  EXPECT_TRUE(repaired.keeps_numbers);
  EXPECT_EQ(repaired.kept, cage.size());
  EXPECT_TRUE(says(repaired.changes,
                   kind<Dim>() + std::to_string(count) + " has the inside on both sides"));
  EXPECT_NEAR(measure_cage(repaired.cage).measure, 2, 1e-9);
}

// One of the facets at an edge has a corner in the middle of it. In 2D, a second way along an edge.
TEST_IN_2D_AND_3D(RepairCageTest, FacetsAreSplitAtPointsOnTheirEdges) {
  auto cage = box_cage<Dim>(1);
  const Index a = cage.facets(0, 0), b = cage.facets(1, 0), middle = cage.size();
  cage.points.conservativeResize(Dim, middle + 1);
  cage.points.col(middle) = 0.7 * cage.points.col(a) + 0.3 * cage.points.col(b);
  const auto count = cage.facets.cols();
  if constexpr (Dim == 2) {
    cage.facets.conservativeResize(Dim, count + 2);
    cage.facets.rightCols(2) << a, middle, middle, b;
  } else {
    cage.facets.conservativeResize(Dim, count + 1);
    cage.facets.col(count) = cage.facets.col(0);
    cage.facets(1, 0) = cage.facets(0, count) = middle;
  }
  const auto repaired = repair(cage);
  EXPECT_TRUE(repaired.keeps_numbers);
  EXPECT_FALSE(repaired.is_wrapped);
  EXPECT_TRUE(says(repaired.changes, "is split at control point " + std::to_string(middle)));
  EXPECT_EQ(repaired.cage.size(), middle + 1);
  EXPECT_EQ(repaired.max_distance, 0);
  expect_box(repaired.cage);
}

// What crosses a wall of a hollow box does not fill the cavity.
TEST_IN_2D_AND_3D(RepairCageTest, CavitiesStay) {
  const auto outer = box<Dim>(-2, 2), cavity = box<Dim>(-1, 1);
  auto pin = box<Dim>(-0.2, 0.2);
  pin.max()(0) = 3;
  const auto repaired = repair(cage_of<Dim>({outer, cavity, pin}));
  EXPECT_FALSE(repaired.is_wrapped);
  expect_inside(repaired.cage, [&](const Vector<Dim>& point) {
    return pin.contains(point) || (outer.contains(point) && !cavity.contains(point));
  });
}

// Boxes that share only a corner or, in 3D, an edge: their copies of it are apart.
TEST_IN_2D_AND_3D(RepairCageTest, SolidsThatOnlyTouchAreSeparated) {
  auto other = moved<Dim>(box<Dim>(0, 1), 0, 1);
  for (int axis = 1; axis < Dim; ++axis) {
    other = moved<Dim>(other, axis, 1);
    const auto repaired = repair(cage_of<Dim>({box<Dim>(0, 1), other}));
    EXPECT_FALSE(repaired.is_wrapped);
    EXPECT_EQ(measure_cage(repaired.cage).parts, 2);
    EXPECT_EQ(repaired.cage.size(), 2 << Dim);
    EXPECT_NEAR(measure_cage(repaired.cage).measure, 2, 1e-3);
  }
}

TEST(RepairCage2Test, BothLobesOfAnOutlineThatCrossesItselfStay) {
  PointList<2> points(2, 4);
  points << 0, 3, 3, 0,  //
      0, 1, 0, 1;
  const auto repaired = repair(loop(points));
  expect_united(repaired, 1.5, 1e-3);
}

// A facet that hangs in space bounds nothing.
TEST_IN_2D_AND_3D(RepairCageTest, OpenPartsAreWrappedClosely) {
  Cage<Dim> facet{PointList<Dim>::Zero(Dim, Dim), FacetList<Dim>(Dim, 1)};
  for (int k = 0; k < Dim; ++k) {
    facet.points.col(k) = 1.5 * Vector<Dim>::Ones() + 0.5 * Vector<Dim>::Unit(k);
    facet.facets(k, 0) = k;
  }
  const auto both = join(box_cage<Dim>(1), facet);
  const auto repaired = repair(both);
  EXPECT_TRUE(repaired.is_wrapped);
  EXPECT_FALSE(repaired.keeps_numbers);
  EXPECT_EQ(repaired.kept, 0);
  // That of the box, in 3D.
  const double volume = Dim == 3 ? 8 : 0;
  EXPECT_NEAR(repaired.measure_before, volume, 0.02 * volume);
  EXPECT_TRUE(says(repaired.changes, "the cage is wrapped"));
  EXPECT_LE(repaired.max_distance, 0.03 * bounding_box_diagonal<Dim>(both.points));
  EXPECT_GT(repaired.max_distance, 0);
  EXPECT_EQ(count_outside(both, repaired.cage), 0);
  EXPECT_EQ(count_crossings(both, repaired.cage), 0);
}

TEST_IN_2D_AND_3D(RepairCageTest, RefusesWhatIsNoCage) {
  auto cage = box_cage<Dim>(1);
  cage.facets.resize(Dim, 0);
  EXPECT_THROW(repair_cage(cage), InputError);
  cage = box_cage<Dim>(1);
  cage.facets(0, 0) = 100;
  EXPECT_THROW(repair_cage(cage), InputError);
  cage = box_cage<Dim>(1);
  cage.points(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(repair_cage(cage), InputError);
}

TEST(RepairCage3Test, TrianglesAreOrientedAsMostOfThemAre) {
  auto cage = box_cage<3>(1);
  std::set<Index> reversed{2, 5, 6};
  for (const Index t : reversed) cage.facets.col(t).reverseInPlace();
  const auto repaired = repair(cage);
  ASSERT_EQ(repaired.changes.size(), reversed.size());
  for (const Index t : reversed) {
    EXPECT_TRUE(says(repaired.changes, "triangle " + std::to_string(t) + " is reversed"));
  }
  EXPECT_TRUE(repaired.keeps_numbers);
  EXPECT_NEAR(winding_number<3>(repaired.cage, Vector<3>::Zero()), 1, 1e-12);
}

// A corner in the middle of an edge, with a degenerate triangle next to it.
TEST(RepairCage3Test, FlatTrianglesGiveTheirCornersToTheirNeighbours) {
  auto cage = box_cage<3>(1);
  const Index a = cage.facets(0, 0), b = cage.facets(1, 0), c = cage.facets(2, 0);
  const Index middle = cage.size();
  cage.points.conservativeResize(3, middle + 1);
  cage.points.col(middle) = (cage.points.col(a) + cage.points.col(b)) / 2;
  const auto count = cage.facets.cols();
  cage.facets.conservativeResize(3, count + 2);
  cage.facets.col(0) << a, middle, c;
  cage.facets.col(count) << middle, b, c;
  cage.facets.col(count + 1) << a, b, middle;
  const auto repaired = repair(cage);
  EXPECT_TRUE(repaired.keeps_numbers);
  EXPECT_FALSE(repaired.is_wrapped);
  EXPECT_TRUE(says(repaired.changes, "triangle " + std::to_string(count + 1) + " has no area"));
  expect_box(repaired.cage);
}

TEST(RepairRealCageTest, RealCages) {
  for (const char* name : {"genus1_self_intersecting", "self_intersecting", "non_manifold",
                           "inconsistent_orientation", "unwelded"}) {
    const std::string file = "defective/" + std::string(name) + "_cage.obj";
    if (!has_model(file)) GTEST_SKIP() << "the real models are absent";
    SCOPED_TRACE(file);
    const auto repaired = repair(load_cage<3>(file));
    EXPECT_FALSE(repaired.changes.empty());
  }
}

}  // namespace
}  // namespace flbc::testing
