// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A folder of weights that were computed before.
#pragma once

#include <optional>
#include <string>

#include "flbc/domain_mesh.h"
#include "flbc/solver.h"
#include "solve/mesher.h"

namespace flbc::app {

//! Result of a solve with the domain it belongs to.
template <int Dim>
struct SolvedDomain {
  DomainMesh<Dim> domain{};
  SparseSolution solution{};  //!< at the V vertices of the domain
  double mesh_seconds = 0;    //!< for making or reading the domain
  Mesher mesher = Mesher::kGiven;
};

//! Answer of the cache for a key.
template <int Dim>
struct CacheAnswer {
  std::optional<SolvedDomain<Dim>> solved{};
  std::string complaint{};  //!< why the file that is there is of no use; empty if there is none
};

//! A file per key, named by the key's hash. Each has the key itself, which is what decides whether
//! the file is used, and ends with a hash of all that comes before. Files appear whole or not at
//! all, so that several programs may share the folder, and any file may be removed at any time.
class WeightsCache {
 public:
  //! Makes the folder if there is none. \throws IoError naming it if files could not be read and
  //! written there
  explicit WeightsCache(std::string folder);

  //! Where weights with this key (key_of()) are kept.
  std::string path_of(const std::string& key) const;

  //! Never throws for a file that is damaged, cannot be read, or belongs to another key.
  template <int Dim>
  CacheAnswer<Dim> find(const std::string& key) const;

  //! Replaces whatever the file was. \throws IoError
  template <int Dim>
  void store(const std::string& key, const SolvedDomain<Dim>& solved) const;

 private:
  std::string folder_;
};

}  // namespace flbc::app
