"""Planning scenes: a robot, what is around it and what it carries."""

from __future__ import annotations

from gazelle.motion.scene.matrix import AllowedCollisions
from gazelle.motion.scene.objects import (
    AttachedBody,
    PlacedShape,
    SceneMesh,
    SceneShape,
    WorldObject,
)
from gazelle.motion.scene.planning_scene import PlanningScene

__all__ = [
    "AllowedCollisions",
    "AttachedBody",
    "PlacedShape",
    "PlanningScene",
    "SceneMesh",
    "SceneShape",
    "WorldObject",
]
