// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/report.h"

#include <utility>

namespace flbc {
namespace {

// One table per enumeration, default first.
template <class Enum>
using Names = std::vector<std::pair<Enum, const char*>>;

template <class Enum>
const Names<Enum>& names();

}  // namespace

template <class Enum>
const char* name_of(Enum value) {
  for (const auto& [known, name] : names<Enum>()) {
    if (known == value) return name;
  }
  return "unknown";
}

template <class Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> all;
  for (const auto& [value, name] : names<Enum>()) all.emplace_back(name);
  return all;
}

template <class Enum>
std::optional<Enum> value_named(const std::string& name) {
  for (const auto& [value, known] : names<Enum>()) {
    if (known == name) return value;
  }
  return std::nullopt;
}

#define FLBC_NAMES(Enum, ...)                         \
  namespace {                                         \
  template <>                                         \
  const Names<Enum>& names() {                        \
    static const Names<Enum> table{__VA_ARGS__};      \
    return table;                                     \
  }                                                   \
  }                                                   \
  template const char* name_of(Enum);                 \
  template std::vector<std::string> names_of<Enum>(); \
  template std::optional<Enum> value_named(const std::string&);

FLBC_NAMES(Method, {Method::kWeights, "weights"}, {Method::kAuto, "auto"},
           {Method::kGradient, "gradient"}, {Method::kPaper, "paper"},
           {Method::kLbc2014, "lbc2014"})
FLBC_NAMES(Coordinates, {Coordinates::kHarmonic, "harmonic"},
           {Coordinates::kMeanValue, "meanvalue"}, {Coordinates::kMaxEntropy, "maxentropy"},
           {Coordinates::kMaxLikelihood, "maxlikelihood"}, {Coordinates::kBlended, "blended"},
           {Coordinates::kBiharmonic, "bbw"}, {Coordinates::kGreen, "green"})
FLBC_NAMES(NonNegative, {NonNegative::kAuto, "auto"}, {NonNegative::kConstraint, "constraint"},
           {NonNegative::kProject, "project"}, {NonNegative::kOff, "off"})
FLBC_NAMES(DistanceScheme, {DistanceScheme::kSquare, "square"}, {DistanceScheme::kLinear, "linear"},
           {DistanceScheme::kSquareRoot, "sqrt"}, {DistanceScheme::kConstant, "constant"})
FLBC_NAMES(Distances, {Distances::kAuto, "auto"}, {Distances::kExact, "exact"},
           {Distances::kInterpolated, "interpolated"})
FLBC_NAMES(Precision, {Precision::kSingle, "single"}, {Precision::kAuto, "auto"},
           {Precision::kDouble, "double"})
FLBC_NAMES(ActiveSet, {ActiveSet::kAuto, "auto"}, {ActiveSet::kOn, "on"}, {ActiveSet::kOff, "off"})
FLBC_NAMES(SolveStatus, {SolveStatus::kConverged, "converged"},
           {SolveStatus::kIterationLimit, "iteration limit"}, {SolveStatus::kStopped, "stopped"})
FLBC_NAMES(Criterion, {Criterion::kNone, "none"}, {Criterion::kTolerance, "tolerance"},
           {Criterion::kGap, "gap"})
FLBC_NAMES(DefectKind, {DefectKind::kCount, "count"}, {DefectKind::kNonFinite, "non-finite"},
           {DefectKind::kExtent, "extent"}, {DefectKind::kIndex, "index"},
           {DefectKind::kCoincident, "coincident"}, {DefectKind::kUnreferenced, "unreferenced"},
           {DefectKind::kFlat, "flat"}, {DefectKind::kDegenerate, "degenerate"},
           {DefectKind::kDuplicate, "duplicate"}, {DefectKind::kOpen, "open"},
           {DefectKind::kNonManifold, "non-manifold"}, {DefectKind::kOrientation, "orientation"},
           {DefectKind::kSelfIntersection, "self-intersection"})
FLBC_NAMES(OutsidePoints, {OutsidePoints::kFail, "fail"}, {OutsidePoints::kNearest, "nearest"},
           {OutsidePoints::kKeep, "keep"}, {OutsidePoints::kExtend, "extend"})

}  // namespace flbc
