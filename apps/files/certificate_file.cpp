// SPDX-License-Identifier: BSD-3-Clause
#include "files/certificate_file.h"

#include <ostream>

#include "flbc/io/files.h"
#include "weights/npz.h"

namespace flbc::app {
template <int Dim>
void write_certificate(const std::string& path, const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                       const Solution& solution) {
  const auto weights = solution.weights.dense();
  const auto& bounds = solution.report.certificate;
  const auto& proof = *bounds.proof;
  const auto phi = proof.phi.dense();
  const double claimed[] = {bounds.objective, bounds.lower_bound};
  io::write_file(path, [&](std::ostream& out) {
    io::NpzWriter file(path, out);
    const auto n = weights.rows();
    const auto vertices = weights.cols(), cells = proof.phi.cols();
    // Columns of Eigen are rows of NumPy.
    file.add("control_points", cage.points.data(), {n, Dim});
    file.add("facets", cage.facets.data(), {cage.facets.cols(), Dim});
    file.add("points", mesh.points.data(), {vertices, Dim});
    file.add("cells", mesh.cells.data(), {cells, Dim + 1});
    file.add("weights", weights.data(), {vertices, n});
    file.add("phi", phi.data(), {cells, n});
    file.add("flux", proof.flux.data(), {cells, Dim, n});
    file.add("multipliers", proof.multipliers.data(), {vertices, Dim});
    file.add("smoothness", &proof.smoothness, {});
    file.add("masked", proof.masked.data(), {proof.masked.cols(), 2});
    file.add("claimed", claimed, {2});
    file.finish();
  });
}

template void write_certificate(const std::string&, const Cage<2>&, const DomainMesh<2>&,
                                const Solution&);
template void write_certificate(const std::string&, const Cage<3>&, const DomainMesh<3>&,
                                const Solution&);

}  // namespace flbc::app
