"""Loads, starts, updates and stops controllers, as ros_control's and ros2_control's manager."""

from __future__ import annotations

from gazelle.control.controller_manager.controller_manager import ControllerManager
from gazelle.control.controller_manager.controller_spec import ControllerRecord, ControllerState

__all__ = ["ControllerManager", "ControllerRecord", "ControllerState"]
