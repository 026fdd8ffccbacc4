// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The files that flbc run makes, as far as their names are always the same.
#pragma once

namespace flbc::app {

constexpr const char* kCage = "cage.obj";  //!< made round a model
constexpr const char* kDomain = "domain";  //!< the extension depends on the dimension
constexpr const char* kDomainWeights = "domain_weights.npy";
constexpr const char* kWeights = "weights.npy";
constexpr const char* kSparseWeights = "sparse_weights.mtx";
constexpr const char* kSkin = "model.glb";        //!< of four influences, which every reader knows
constexpr const char* kFullSkin = "model_8.glb";  //!< of up to eight
// Pictures; the extension depends on the format.
constexpr const char* kFunction = "function";
constexpr const char* kModelPicture = "model";
constexpr const char* kDeformation = "deformation";
constexpr const char* kPage = "model.html";

//! The report, in which the names of all files are: the next run knows by them what is its own.
constexpr const char* kReport = "report.json";

}  // namespace flbc::app
