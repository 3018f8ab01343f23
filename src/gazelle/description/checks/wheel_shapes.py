"""Shapes that do not roll."""

from __future__ import annotations

from gazelle.description.checks.wheel_axles import wheels_of
from gazelle.description.model import Box, Model
from gazelle.diagnostics import Diagnostics

__all__ = ["check_wheel_shapes"]


def check_wheel_shapes(model: Model, diagnostics: Diagnostics) -> None:
    """Report wheels whose collisions are boxes."""
    for wheel in wheels_of(model):
        shapes = [item.shape for item in wheel.link.collisions]
        boxes = [shape for shape in shapes if isinstance(shape, Box)]
        if not boxes or len(boxes) < len(shapes):
            continue
        across = sorted(boxes[0].size_m)[1:]
        text = (
            f"the collision of wheel '{wheel.link.name}' is a box: the robot stands on its sides "
            "and bumps over its edges instead of rolling"
        )
        sizes = f'radius="{max(across) / 2:.4g}" length="{min(boxes[0].size_m):.4g}"'
        place = wheel.link.collisions[0].span or wheel.link.span
        diagnostics.report("robot.wheel-box", text, place, fix=f"use <cylinder {sizes}/>")
