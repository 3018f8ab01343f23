"""Planning scenes: a robot, what is around it and what it carries."""

from __future__ import annotations

from gazelle.motion.scene.planning_scene import (
    AllowedCollisions,
    AttachedBody,
    PlacedShape,
    PlanningScene,
    SceneMesh,
    SceneShape,
    WorldObject,
)

__all__ = [
    "AllowedCollisions",
    "AttachedBody",
    "PlacedShape",
    "PlanningScene",
    "SceneMesh",
    "SceneShape",
    "WorldObject",
]
