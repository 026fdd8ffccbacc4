# SPDX-License-Identifier: BSD-3-Clause
"""The page of the Python module: signatures and docstrings of all exported names, without importing it."""
import ast
import inspect
import pathlib

SOURCES = pathlib.Path(__file__).resolve().parents[2] / "python" / "flbc"


def signature(node):
    """As written, without self and the body."""
    if isinstance(node, ast.ClassDef):
        bases = ", ".join(map(ast.unparse, node.bases))
        return f"class {node.name}({bases})" if bases else f"class {node.name}"
    arguments = ast.unparse(node.args).removeprefix("self, ").removeprefix("self")
    result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{node.name}({arguments}){result}"


def entry(node, level):
    """A title, the signature, the docstring, and the same of public methods."""
    text = (ast.get_docstring(node) or "").replace("{options}", "Those of `SolverOptions`.")
    lines = [f"{'#' * level} {node.name}", "", "```python", signature(node), "```", ""]
    lines += ["```text", inspect.cleandoc(text), "```", ""] if text else []
    if isinstance(node, ast.ClassDef):
        for method in node.body:
            if isinstance(method, ast.FunctionDef) and not method.name.startswith("_") and ast.get_docstring(method):
                lines += entry(method, level + 1)
    return lines


def page():
    nodes = {node.name: node for path in sorted(SOURCES.glob("*.py")) for node in ast.parse(path.read_text()).body
             if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
    names = next(ast.literal_eval(node.value) for node in ast.parse((SOURCES / "__init__.py").read_text()).body
                 if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
    lines = ["# Python module", "", "All functions and classes of `flbc`. `help()` prints the same texts.", ""]
    for name in sorted(names, key=str.lower):
        lines += entry(nodes[name], 2) if name in nodes else []
    return "\n".join(lines)
