"""Where a model's shapes are: points of every link in the model's frame."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.checks.inertia_shapes import shape_points_m
from gazelle.description.model import Collision, Link, Model, Shape
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose

__all__ = ["Outline", "Outlines"]

Array = NDArray[np.float64]

# Beyond it double precision loses millimetres and qhull its way.
_FARTHEST_M = 1e9


class Outline(NamedTuple):
    """A shape in the model's frame with all joints at zero.

    Attributes:
        link, collision: what it belongs to; no collision for a visual.
        points_m: (n, 3), their hull holds the shape.
    """

    link: Link
    collision: Collision | None
    points_m: Array

    @property
    def low_m(self) -> Array:
        """Lower corner of the bounding box, (3,)."""
        return np.asarray(self.points_m.min(axis=0))

    @property
    def high_m(self) -> Array:
        """Upper corner of the bounding box, (3,)."""
        return np.asarray(self.points_m.max(axis=0))


class Outlines:
    """All shapes of a model, meshes loaded once; files that cannot be read have no points."""

    def __init__(self, model: Model) -> None:
        self._model = model
        self._unheard = Diagnostics()

    @cached_property
    def collisions(self) -> tuple[Outline, ...]:
        """Of all links."""
        return tuple(
            outline
            for link in self._model.links
            for item in link.collisions
            for outline in self._outline(link, item.shape, item.T_link_collision, item)
        )

    @cached_property
    def visuals(self) -> tuple[Outline, ...]:
        """Of all links."""
        return tuple(
            outline
            for link in self._model.links
            for item in link.visuals
            for outline in self._outline(link, item.shape, item.T_link_visual, None)
        )

    def _outline(
        self, link: Link, shape: Shape, T_link_shape: Pose, collision: Collision | None
    ) -> Iterable[Outline]:
        points = shape_points_m(shape, self._unheard)
        pose = link.T_model_link @ T_link_shape
        if len(points):
            placed = np.asarray(pose.transform(points))
            if np.abs(placed).max() < _FARTHEST_M:  # false for what is no number, too
                yield Outline(link, collision, placed)
