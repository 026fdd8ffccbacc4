// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/names.h"

namespace flbc {

const char* name_of(Method method) {
  switch (method) {
    case Method::kAuto:
      return "auto";
    case Method::kValue:
      return "value";
    case Method::kGradient:
      return "gradient";
    case Method::kPaper:
      return "paper";
    case Method::kLbc2014:
      return "lbc2014";
    case Method::kHarmonic:
      return "harmonic";
    case Method::kMeanValue:
      break;
  }
  return "meanvalue";
}

const char* name_of(NonNegative non_negative) {
  switch (non_negative) {
    case NonNegative::kAuto:
      return "auto";
    case NonNegative::kConstraint:
      return "constraint";
    case NonNegative::kProject:
      return "project";
    case NonNegative::kOff:
      break;
  }
  return "off";
}

const char* name_of(SolveStatus status) {
  switch (status) {
    case SolveStatus::kConverged:
      return "converged";
    case SolveStatus::kIterationLimit:
      return "iteration limit";
    case SolveStatus::kStopped:
      break;
  }
  return "stopped";
}

const char* name_of(DistanceScheme scheme) {
  switch (scheme) {
    case DistanceScheme::kSquare:
      return "square";
    case DistanceScheme::kLinear:
      return "linear";
    case DistanceScheme::kSquareRoot:
      return "sqrt";
    case DistanceScheme::kConstant:
      break;
  }
  return "constant";
}

const char* name_of(Recovery recovery) {
  switch (recovery) {
    case Recovery::kAuto:
      return "auto";
    case Recovery::kBreadthFirst:
      return "breadth-first";
    case Recovery::kLeastSquares:
      break;
  }
  return "least-squares";
}

}  // namespace flbc
