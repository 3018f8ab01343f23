"""moveit_commander, on Gazelle's graph."""

import sys as _sys

from gazelle.compat.moveit.commander import *  # noqa: F403
from gazelle.compat.moveit.commander import conversions
from gazelle.compat.moveit.commander import exception as _exception
from gazelle.compat.moveit.commander import move_group as _move_group
from gazelle.compat.moveit.commander import robot as _robot
from gazelle.compat.moveit.commander import scene as _scene
from gazelle.compat.moveit.commander import roscpp_initializer as _roscpp_initializer

# Programs also import from moveit_commander's inner modules.
for _name, _module in {
    "conversions": conversions,
    "exception": _exception,
    "move_group": _move_group,
    "planning_scene_interface": _scene,
    "robot": _robot,
    "roscpp_initializer": _roscpp_initializer,
}.items():
    _sys.modules[f"{__name__}.{_name}"] = globals()[_name] = _module
