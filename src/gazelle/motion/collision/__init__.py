"""Collision checking with a second MuJoCo model."""

from __future__ import annotations

from gazelle.motion.collision.building import Owner
from gazelle.motion.collision.checker import CollisionChecker, CollisionContact

__all__ = ["CollisionChecker", "CollisionContact", "Owner"]
