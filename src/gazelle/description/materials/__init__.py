"""Looks of surfaces: Gazebo's named materials and OGRE's material scripts."""

from __future__ import annotations

from gazelle.description.materials.gazebo_materials import (
    GAZEBO_MATERIAL_NAMES,
    gazebo_material,
    picture_colour,
)
from gazelle.description.materials.script_lookup import material_from_scripts

__all__ = ["GAZEBO_MATERIAL_NAMES", "gazebo_material", "material_from_scripts", "picture_colour"]
