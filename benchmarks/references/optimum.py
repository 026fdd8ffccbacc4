# SPDX-License-Identifier: BSD-3-Clause
"""The optimum of the problem of local barycentric coordinates as a second-order cone program.

    minimise sum_s sum_i phi_s^i A_s |grad w_i|_s
    subject to sum_i w_i(v) = 1 and sum_i w_i(v) c_i = x_v at interior vertices v,
    w given at boundary vertices, and w >= 0 if wanted

The constraints at v are met by w(v) = particular solution + null space basis * y_v, whatever y_v.
Unknowns of the program are all y_v and, per cell and control point, a bound t of phi A |grad w|.
An interior point method solves it: nothing is shared with iterative solvers but the problem.
"""

from dataclasses import dataclass

import cvxopt
import numpy as np
from cvxopt import matrix, solvers, spmatrix

from domains import hat_gradients, measure
from normal_equations import NormalEquations

# Asked of the interior point method. Its residuals need not be small, because weights meet the
# constraints and the lower bound is a bound whatever they are.
GAP_TOLERANCE = 1e-10
RESIDUAL_TOLERANCE = 1e-6


@dataclass
class Optimum:
    objective: float  # of the weights themselves
    gap: float  # relative: (objective - lower bound) / objective
    weights: np.ndarray  # V x n


class Geometry:
    """Measures and gradients of the hat functions of cells."""

    def __init__(self, domain, cells):
        corners = domain.points[domain.cells[cells]]
        self.measures = np.array([measure(c) for c in corners])
        shape = (-1, domain.dim, domain.dim + 1)
        self.hats = np.array([hat_gradients(c) for c in corners]).reshape(shape)


def distance_weights(domain):
    """phi, F x n: the distances to the control points divided by the largest one, averaged over the
    cell's vertices, squared."""
    distances = np.linalg.norm(domain.points[:, None] - domain.cage_points[None], axis=2)
    return (distances / distances.max())[domain.cells].mean(axis=1) ** 2


def objective(domain, phi, weights, cells=slice(None)):
    geometry = Geometry(domain, cells)
    gradients = np.einsum("sda,san->sdn", geometry.hats, weights[domain.cells[cells]])
    norms = np.linalg.norm(gradients, axis=1)
    return float((phi[cells] * geometry.measures[:, None] * norms).sum())


def minimise(domain, phi, non_negative):
    """The best weights found and how good they are; it is for the caller to judge the gap."""
    start, basis = feasible_set(domain)
    interior = domain.interior()
    cells = np.isin(domain.cells, interior).any(axis=1)  # the others have nothing to choose
    lines, offsets = norm_rows(domain, phi, start, basis, cells)
    signs = sign_rows(len(interior), basis, non_negative)
    signed = start[interior if non_negative else []].ravel()
    equations = NormalEquations(-signs, -lines, domain.dim)
    y, z = solve(equations, signed, offsets)
    weights = start.copy()
    weights[interior] += y.reshape(len(interior), -1) @ basis.T
    bound = (objective(domain, phi, start, ~cells)
             + lower_bound(signs, signed, lines, offsets, z, len(interior)))
    value = objective(domain, phi, weights)
    return Optimum(value, (value - bound) / value, weights)


def solve(equations, signed, offsets):
    """The y and all dual variables that the interior point method ends with."""
    costs = np.repeat([0.0, 1.0], [equations.free, equations.cones])
    cones = np.hstack([np.zeros((len(offsets), 1)), offsets])
    limits = np.concatenate([signed, cones.ravel()])
    dims = {"l": equations.linear, "q": [cones.shape[1]] * equations.cones, "s": []}
    solvers.options.update(show_progress=False, maxiters=60, refinement=2, abstol=GAP_TOLERANCE,
                           reltol=GAP_TOLERANCE, feastol=RESIDUAL_TOLERANCE)
    solution = solvers.conelp(matrix(costs), equations.join_rows(), matrix(limits), dims,
                              kktsolver=equations.factor)
    return np.array(solution["x"][:equations.free]).ravel(), np.array(solution["z"]).ravel()


def lower_bound(signs, signed, lines, offsets, z, vertices):
    """No feasible weights with |w(v)| <= 2 at all interior vertices have a smaller sum of norms.

    For multipliers m >= 0 of the signs and p with |p_k| <= 1 that sum is at least
    p . (lines y + offsets) - m . (signs y + signed), the part in y being small by optimality; and
    |y_v| <= |w(v)|, as the particular solution is perpendicular to the basis.
    """
    multipliers = np.maximum(z[:len(signed)], 0)
    p = -z[len(signed):].reshape(len(offsets), -1)[:, 1:]
    p /= np.maximum(1, np.linalg.norm(p, axis=1, keepdims=True))
    slopes = np.array(lines.T * matrix(p.ravel()) - signs.T * matrix(multipliers))
    rest = 2 * np.linalg.norm(slopes.reshape(vertices, -1), axis=1).sum()
    return float((p * offsets).sum() - multipliers @ signed - rest)


def feasible_set(domain):
    """Weights that meet all equations, V x n, and a basis of the directions in which a row may
    move at interior vertices, n x m."""
    demands = np.vstack([np.ones(len(domain.cage_points)), domain.cage_points.T])
    weights = np.zeros((len(domain.points), len(domain.cage_points)))
    for v, row in domain.boundary_weights.items():
        weights[v] = row
    for v in domain.interior():
        weights[v] = np.linalg.lstsq(demands, np.append(1, domain.points[v]), rcond=None)[0]
    return weights, np.linalg.svd(demands)[2][len(demands):].T


def norm_rows(domain, phi, start, basis, cells):
    """phi A grad w_i per cell and control point as matrix * y + offset: a sparse matrix, all y by
    vertices, and the offsets, (F n) x Dim."""
    geometry = Geometry(domain, cells)
    number = np.full(len(domain.points), -1)
    number[domain.interior()] = np.arange(len(domain.interior()))
    scales = phi[cells] * geometry.measures[:, None]
    offsets = np.einsum("si,sda,sai->sid", scales, geometry.hats, start[domain.cells[cells]])
    # entry (s, i, d, a, k): cell, control point, direction, corner of the cell, component of y
    entries = np.einsum("si,sda,ik->sidak", scales, geometry.hats, basis)
    s, i, d, a, k = np.indices(entries.shape)
    rows = np.ravel_multi_index((s, i, d), offsets.shape)
    vertices = number[domain.cells[cells][s, a]]
    columns = vertices * basis.shape[1] + k
    inner = vertices >= 0
    size = (offsets.size, len(domain.interior()) * basis.shape[1])
    return (spmatrix(entries[inner], rows[inner], columns[inner], size),
            offsets.reshape(-1, domain.dim))


def sign_rows(vertices, basis, non_negative):
    """w as matrix * y + start, all interior vertices in turn; without rows if w is free."""
    if not non_negative:
        return spmatrix([], [], [], (0, vertices * basis.shape[1]))
    rows, columns = basis.shape
    v, i, k = np.indices((vertices, rows, columns)).reshape(3, -1)
    return spmatrix(basis[i, k], v * rows + i, v * columns + k, (vertices * rows, vertices * columns))
