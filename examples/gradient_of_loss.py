# SPDX-License-Identifier: BSD-3-Clause
"""Finds the control points that move a model to given positions, by the gradient of a loss (PyTorch).

gradient_of_loss.py CAGE MODEL POSE   the positions are those of the model in POSE, a posed cage
"""
import sys

import flbc
import torch

cage, pose = flbc.read_cage(sys.argv[1]), flbc.read_cage(sys.argv[3])
vertices, faces = flbc.read_model(sys.argv[2])
binding = flbc.bind(vertices, faces, cage, mesh_vertices=3000)

W = torch.tensor(binding.weights.toarray())  # a row per vertex, a column per control point
target = torch.tensor(binding.deform(pose.points))
c = torch.tensor(cage.points.copy(), requires_grad=True)
optimizer = torch.optim.Adam([c], lr=0.05)
for step in range(301):
    optimizer.zero_grad()
    loss = ((W @ c - target) ** 2).sum(dim=1).mean()
    loss.backward()  # c.grad is W.T @ dJ/d(W @ c)
    optimizer.step()
    if step % 100 == 0:
        print(step, loss.item())
