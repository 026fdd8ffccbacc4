# SPDX-License-Identifier: BSD-3-Clause
"""Writing OBJ with five decimals."""


def write_obj(path, title, points, loops=(), faces=()):
    """Points of two or three coordinates, and colors if they have six numbers; loops and faces number them from 0. A loop is closed
    by naming its first point again."""
    lines = [f"# {title}"]
    for p in points:
        lines.append("v " + " ".join(number(x) for x in (p if len(p) > 3 else (*p, 0.0)[:3])))
    for loop in loops:
        lines.append("l " + " ".join(str(v + 1) for v in [*loop, loop[0]]))
    for face in faces:
        lines.append("f " + " ".join(str(v + 1) for v in face))
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write("\n".join(lines) + "\n")


def number(x):
    """The shortest text of x rounded to five decimals; no minus sign on zero."""
    text = f"{x:.5f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
