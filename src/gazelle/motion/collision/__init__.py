"""Collision checking with a second MuJoCo model."""

from __future__ import annotations

from gazelle.motion.collision.checker import CollisionChecker
from gazelle.motion.collision.collision_model import Owner
from gazelle.motion.collision.contacts import CollisionContact

__all__ = ["CollisionChecker", "CollisionContact", "Owner"]
