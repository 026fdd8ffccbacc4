// SPDX-License-Identifier: BSD-3-Clause
// Defective cages become sound, and say what was done to them.
#include "flbc/repair_cage.h"
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

TEST_IN_2D_AND_3D(RepairCageTest, CagesThatIntersectThemselvesAreWrapped) {
  auto other = box_cage<Dim>(1);
  other.points.array() += 0.7;
  const auto both = join(box_cage<Dim>(1), other);
  const auto repaired = repair(both);
  EXPECT_TRUE(repaired.is_wrapped);
  EXPECT_FALSE(repaired.keeps_numbers);
  EXPECT_TRUE(says(repaired.changes, "the cage is wrapped"));
  EXPECT_LE(repaired.cage.size(), both.size());
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
