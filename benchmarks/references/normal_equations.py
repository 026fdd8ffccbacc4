# SPDX-License-Identifier: BSD-3-Clause
"""The linear systems of cvxopt's interior point method for sums of norms.

cvxopt's own solvers are dense, and where a norm vanishes at the optimum, as most do here, normal
equations that keep the norm's bound t as an unknown lose their digits to cancellation. So t is
eliminated by hand. A cone's scaling is W = beta (2 v v' - J) with J = diag(1, -1, -1 ..) and
v' J v = 1; with v = (a, u) the square of W is, without cancellation,

    beta^2 [ 1 + 8 a^2 |u|^2        4 a (2 a^2 - 1) u' ]
           [ 4 a (2 a^2 - 1) u      1 + 8 a^2 u u'     ].
"""

import cvxopt
import cvxopt.cholmod
import numpy as np
from cvxopt import matrix, misc, spmatrix


class NormalEquations:
    """For minimise sum t subject to linear constraints on y and cones (t_k, affine in y).

    `linear_rows` and `norm_rows` are minus the matrices that multiply y; every `dim` rows of the
    latter form a cone. The unknowns are (y, t), the rows as cvxopt wants them (see join_rows).
    """

    def __init__(self, linear_rows, norm_rows, dim):
        self.linear = linear_rows.size[0]
        self.cones = norm_rows.size[0] // dim
        self.dim = dim
        self.free = norm_rows.size[1]
        self.rows = cvxopt.sparse([linear_rows, norm_rows])
        first = self.linear + dim * np.arange(self.cones)[:, None, None]
        inner = np.arange(dim)
        blocks = np.broadcast_arrays(first + inner[:, None], first + inner[None, :])
        diagonal = np.arange(self.linear)
        self.places = [np.concatenate([diagonal, block.ravel()]) for block in blocks]
        self.symbolic = None

    def join_rows(self):
        """cvxopt's G: the linear constraints, then each cone with the row of its t first."""
        cone_of = np.arange(self.cones)
        entries = self.rows.I, self.rows.J, self.rows.V
        below, columns, values = [np.array(part).ravel() for part in entries]
        shifted = below + np.where(below < self.linear, 0, 1 + (below - self.linear) // self.dim)
        heads = self.linear + (self.dim + 1) * cone_of
        return spmatrix(np.concatenate([values, -np.ones(self.cones)]),
                        np.concatenate([shifted, heads]).astype(int),
                        np.concatenate([columns, self.free + cone_of]).astype(int),
                        (self.rows.size[0] + self.cones, self.free + self.cones))

    def factor(self, scaling):
        """The function that cvxopt asks for. It solves [0 G'; G -W^2] [x; z] = [p; q] in place and
        leaves W z in place of z."""
        beta = np.array(scaling["beta"])
        v = np.array([np.array(column).ravel() for column in scaling["v"]])
        a, u = v[:, 0], v[:, 1:]
        stretch = 1 + 8 * a**2 * (u**2).sum(axis=1)
        arm = (4 * a * (2 * a**2 - 1))[:, None] * u
        weight = 8 * a**2 / stretch
        inverse = np.eye(self.dim) - weight[:, None, None] * u[:, :, None] * u[:, None, :]
        inverse /= (beta**2)[:, None, None]
        linear = np.array(scaling["di"]).ravel() ** 2
        metric = spmatrix(np.concatenate([linear, inverse.ravel()]), *self.places)

        product = self.rows.T * metric
        normal = product * self.rows
        if self.symbolic is None:
            self.symbolic = cvxopt.cholmod.symbolic(normal)
        cvxopt.cholmod.numeric(normal, self.symbolic)

        def solve(x, _, z):
            p_t = np.array(x[self.free:]).ravel()
            q = np.array(z).ravel()
            q_linear, q_cones = q[:self.linear], q[self.linear:].reshape(self.cones, -1)
            z_head = -p_t
            right = matrix(np.concatenate(
                [q_linear, (q_cones[:, 1:] + arm * (beta**2 * z_head)[:, None]).ravel()]))
            y = x[:self.free] + product * right
            cvxopt.cholmod.solve(self.symbolic, y)
            rises = self.rows * y
            below = np.array(metric * (rises - right)).ravel()
            z_tail = below[self.linear:].reshape(self.cones, self.dim)
            tail = np.array(rises).ravel()[self.linear:].reshape(z_tail.shape) - q_cones[:, 1:]
            x[:self.free] = y
            x[self.free:] = matrix(
                -q_cones[:, 0] - (beta**2 * z_head + (arm * tail).sum(axis=1)) / stretch)
            z_cones = np.hstack([z_head[:, None], z_tail])
            z[:] = matrix(np.concatenate([below[:self.linear], z_cones.ravel()]))
            misc.scale(z, scaling)

        return solve
