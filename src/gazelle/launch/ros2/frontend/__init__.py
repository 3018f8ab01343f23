"""launch.frontend: elements of XML and YAML launch files as actions and substitutions."""

from __future__ import annotations

from gazelle.launch.ros2.frontend import expose, type_utils
from gazelle.launch.ros2.frontend.entity import Entity
from gazelle.launch.ros2.frontend.expose import expose_action, expose_substitution
from gazelle.launch.ros2.frontend.parser import InvalidFrontendLaunchFileError, Parser

__all__ = [
    "Entity",
    "InvalidFrontendLaunchFileError",
    "Parser",
    "expose",
    "expose_action",
    "expose_substitution",
    "type_utils",
]
