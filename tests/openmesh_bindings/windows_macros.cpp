// SPDX-License-Identifier: BSD-3-Clause
// Compiles with the macros of windows.h, which the standard library and Eigen allow for.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyCreator.hh>
#include <OpenMesh/Core/Utils/color_cast.hh>

#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))

#include "flbc/openmesh/bind.h"
#include "flbc/openmesh/gradient_admm.h"
#include "flbc/openmesh/gradients.h"
#include "flbc/openmesh/lbc.h"
#include "flbc/openmesh/skin.h"

using Model = OpenMesh::TriMesh_ArrayKernelT<>;

void follow(Model& model, const flbc::Cage<3>& cage, const flbc::DomainMesh<3>& domain) {
  flbc::openmesh::bind(model, cage, domain);
  flbc::openmesh::sparsify(model, 4);
  flbc::openmesh::bind_new_vertices(model);
  flbc::openmesh::deform(model, cage);
}
