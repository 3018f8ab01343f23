"""Controllers of ros_control and ros2_control, their hardware, and your own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.control.python_controllers.pid import Pid

__all__ = ["Pid"]


def __getattr__(name: str) -> Any:
    if name == "Pid":
        from gazelle.control.python_controllers.pid import Pid

        return Pid
    raise AttributeError(f"module 'gazelle.control' has no attribute '{name}'")
