"""Controllers of your own: Python classes found by the ``type`` name in the YAML."""

from __future__ import annotations

from gazelle.control.python_controllers.adapter import PythonController
from gazelle.control.python_controllers.controller_api import UserJoint, UserNode, UserRobot
from gazelle.control.python_controllers.finder import (
    find_installed_controller,
    find_python_controller,
)
from gazelle.control.python_controllers.pid import Pid

__all__ = [
    "Pid",
    "PythonController",
    "UserJoint",
    "UserNode",
    "UserRobot",
    "find_installed_controller",
    "find_python_controller",
]
