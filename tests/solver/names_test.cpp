// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/report.h"

#include "support/test.h"

namespace flbc::testing {
namespace {

template <class Enum>
class NamesTest : public ::testing::Test {};
using Enumerations =
    ::testing::Types<Method, Coordinates, NonNegative, DistanceScheme, Distances, Precision,
                     ActiveSet, DefectKind, SolveStatus, Criterion, OutsidePoints>;
TYPED_TEST_SUITE(NamesTest, Enumerations);

// kAuto may be another name for a value, so values can have two names.
TYPED_TEST(NamesTest, GoBothWays) {
  const auto names = names_of<TypeParam>();
  std::set<std::string> distinct(names.begin(), names.end());
  EXPECT_EQ(distinct.size(), names.size());
  std::set<TypeParam> values;
  for (const auto& name : names) {
    const auto value = value_named<TypeParam>(name);
    ASSERT_TRUE(value.has_value()) << name;
    EXPECT_EQ(value_named<TypeParam>(name_of(*value)), value);
    const bool is_new = values.insert(*value).second;
    EXPECT_TRUE(is_new || name == "auto" || distinct.count("auto") > 0) << name;
  }
  // Enumerations count from 0, so that none is left out if the largest is as many.
  EXPECT_EQ(static_cast<std::size_t>(*values.rbegin()) + 1, values.size());
  EXPECT_EQ(value_named<TypeParam>(names.front()), TypeParam{});
  EXPECT_FALSE(value_named<TypeParam>("no such name"));
}

// Programs choose both by one option.
TEST(NamesOfCoordinatesTest, AreNotThoseOfMethods) {
  for (const auto& name : names_of<Coordinates>()) EXPECT_FALSE(value_named<Method>(name)) << name;
}

}  // namespace
}  // namespace flbc::testing
