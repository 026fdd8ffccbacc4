// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/names.h"

#include <algorithm>

namespace flbc {
namespace {

template <class Enum>
struct Named {
  Enum value;
  const char* name;
};

// A table per enumeration, the default first.

constexpr Named<Method> kMethodNames[]{
    {Method::kAuto, "auto"},          {Method::kValue, "value"},
    {Method::kGradient, "gradient"},  {Method::kPaper, "paper"},
    {Method::kLbc2014, "lbc2014"},    {Method::kHarmonic, "harmonic"},
    {Method::kMeanValue, "meanvalue"}};
constexpr Named<NonNegative> kNonNegativeNames[]{{NonNegative::kAuto, "auto"},
                                                 {NonNegative::kConstraint, "constraint"},
                                                 {NonNegative::kProject, "project"},
                                                 {NonNegative::kOff, "off"}};
constexpr Named<DistanceScheme> kDistanceSchemeNames[]{{DistanceScheme::kSquare, "square"},
                                                       {DistanceScheme::kLinear, "linear"},
                                                       {DistanceScheme::kSquareRoot, "sqrt"},
                                                       {DistanceScheme::kConstant, "constant"}};
constexpr Named<Distances> kDistancesNames[]{{Distances::kAuto, "auto"},
                                             {Distances::kExact, "exact"},
                                             {Distances::kInterpolated, "interpolated"}};
constexpr Named<Recovery> kRecoveryNames[]{{Recovery::kAuto, "auto"},
                                           {Recovery::kBreadthFirst, "breadth-first"},
                                           {Recovery::kLeastSquares, "least-squares"}};
constexpr Named<Precision> kPrecisionNames[]{{Precision::kAuto, "auto"},
                                             {Precision::kSingle, "single"},
                                             {Precision::kDouble, "double"}};
constexpr Named<ActiveSet> kActiveSetNames[]{
    {ActiveSet::kAuto, "auto"}, {ActiveSet::kOn, "on"}, {ActiveSet::kOff, "off"}};
constexpr Named<CoarseToFine> kCoarseToFineNames[]{
    {CoarseToFine::kAuto, "auto"}, {CoarseToFine::kOn, "on"}, {CoarseToFine::kOff, "off"}};
constexpr Named<LinearSolver> kLinearSolverNames[]{{LinearSolver::kAuto, "auto"},
                                                   {LinearSolver::kDirect, "direct"},
                                                   {LinearSolver::kMultigrid, "multigrid"},
                                                   {LinearSolver::kNone, "none"}};
constexpr Named<SolveStatus> kSolveStatusNames[]{{SolveStatus::kConverged, "converged"},
                                                 {SolveStatus::kIterationLimit, "iteration limit"},
                                                 {SolveStatus::kStopped, "stopped"}};
constexpr Named<Criterion> kCriterionNames[]{
    {Criterion::kNone, "none"}, {Criterion::kTolerance, "tolerance"}, {Criterion::kGap, "gap"}};
constexpr Named<OutsidePoints> kOutsidePointsNames[]{{OutsidePoints::kFail, "fail"},
                                                     {OutsidePoints::kNearest, "nearest"},
                                                     {OutsidePoints::kExtend, "extend"}};

constexpr auto& table_for(Method) {
  return kMethodNames;
}
constexpr auto& table_for(NonNegative) {
  return kNonNegativeNames;
}
constexpr auto& table_for(DistanceScheme) {
  return kDistanceSchemeNames;
}
constexpr auto& table_for(Distances) {
  return kDistancesNames;
}
constexpr auto& table_for(Recovery) {
  return kRecoveryNames;
}
constexpr auto& table_for(Precision) {
  return kPrecisionNames;
}
constexpr auto& table_for(ActiveSet) {
  return kActiveSetNames;
}
constexpr auto& table_for(CoarseToFine) {
  return kCoarseToFineNames;
}
constexpr auto& table_for(LinearSolver) {
  return kLinearSolverNames;
}
constexpr auto& table_for(SolveStatus) {
  return kSolveStatusNames;
}
constexpr auto& table_for(Criterion) {
  return kCriterionNames;
}
constexpr auto& table_for(OutsidePoints) {
  return kOutsidePointsNames;
}

template <class Enum>
const char* find_name(Enum value) {
  const auto& table = table_for(value);
  const auto found = std::find_if(std::begin(table), std::end(table),
                                  [&](const auto& entry) { return entry.value == value; });
  return found == std::end(table) ? "unknown" : found->name;
}

}  // namespace

const char* name_of(Method value) {
  return find_name(value);
}
const char* name_of(NonNegative value) {
  return find_name(value);
}
const char* name_of(DistanceScheme value) {
  return find_name(value);
}
const char* name_of(Distances value) {
  return find_name(value);
}
const char* name_of(Recovery value) {
  return find_name(value);
}
const char* name_of(Precision value) {
  return find_name(value);
}
const char* name_of(ActiveSet value) {
  return find_name(value);
}
const char* name_of(CoarseToFine value) {
  return find_name(value);
}
const char* name_of(LinearSolver value) {
  return find_name(value);
}
const char* name_of(SolveStatus value) {
  return find_name(value);
}
const char* name_of(Criterion value) {
  return find_name(value);
}
const char* name_of(OutsidePoints value) {
  return find_name(value);
}

template <class Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  for (const auto& entry : table_for(Enum{})) names.emplace_back(entry.name);
  return names;
}

template <class Enum>
std::optional<Enum> value_named(const std::string& name) {
  for (const auto& entry : table_for(Enum{})) {
    if (name == entry.name) return entry.value;
  }
  return std::nullopt;
}

#define FLBC_INSTANTIATE(Enum)                        \
  template std::vector<std::string> names_of<Enum>(); \
  template std::optional<Enum> value_named<Enum>(const std::string&);
FLBC_INSTANTIATE(Method)
FLBC_INSTANTIATE(NonNegative)
FLBC_INSTANTIATE(DistanceScheme)
FLBC_INSTANTIATE(Distances)
FLBC_INSTANTIATE(Recovery)
FLBC_INSTANTIATE(Precision)
FLBC_INSTANTIATE(ActiveSet)
FLBC_INSTANTIATE(CoarseToFine)
FLBC_INSTANTIATE(LinearSolver)
FLBC_INSTANTIATE(SolveStatus)
FLBC_INSTANTIATE(Criterion)
FLBC_INSTANTIATE(OutsidePoints)
#undef FLBC_INSTANTIATE

}  // namespace flbc
