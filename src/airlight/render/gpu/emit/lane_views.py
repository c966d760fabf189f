"""Replacement of lane views by their arrays, whose elements are texels of all lanes in a shader."""

from __future__ import annotations

import ast
from typing import Any

from airlight.kernel.lanes import lane_view
from airlight.render.gpu.emit.scope import SubsetError


class LaneViews(ast.NodeTransformer):
    """Replacement of ``lane_view(array, at)``, and of names assigned to one, by the array.

    Parameters
    ----------
    scope : dict
        Globals of the function.
    """

    def __init__(self, scope: dict[str, Any]) -> None:
        self.calls = {name for name, value in scope.items() if value is lane_view}
        self.arrays: dict[str, ast.expr] = {}

    def visit_Call(self, node: ast.Call) -> ast.expr:
        """Replace the call of a view."""
        self.generic_visit(node)
        return node.args[0] if self._is_view(node) else node

    def visit_Assign(self, node: ast.Assign) -> ast.AST:
        """Record the names of views, and remove their assignment."""
        targets, values = [node.targets[0]], [node.value]
        if isinstance(targets[0], ast.Tuple) and isinstance(values[0], ast.Tuple):
            targets, values = targets[0].elts, values[0].elts
        if not all(self._is_view(one) for one in values):
            return self.generic_visit(node)
        for target, view in zip(targets, values, strict=True):
            array = self.visit(view)
            if not isinstance(target, ast.Name) or isinstance(array, ast.Call):
                return self.generic_visit(node)
            if ast.dump(self.arrays.setdefault(target.id, array)) != ast.dump(array):
                raise SubsetError(f"{target.id}: is assigned views of several arrays")
        return ast.copy_location(ast.Pass(), node)

    def visit_Name(self, node: ast.Name) -> ast.expr:
        """Replace the name of a view."""
        return self.arrays.get(node.id, node) if isinstance(node.ctx, ast.Load) else node

    def _is_view(self, node: ast.expr) -> bool:
        called = node.func if isinstance(node, ast.Call) else None
        return isinstance(called, ast.Name) and called.id in self.calls
