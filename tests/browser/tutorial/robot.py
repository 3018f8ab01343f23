"""A document's robot: its launch file, what is typed beside it, and what the simulation says."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

__all__ = ["Robot", "choose_panel"]

_STARTING_S = 90.0


class Robot:
    """A launch file that runs until its module's tests have ended.

    Attributes:
        launched: the launch file.
        url: of the page, which the launch itself prints.
    """

    def __init__(
        self, run: Callable[..., Any], package: str, file: str, *, port: int, cwd: Path
    ) -> None:
        self._run, self._cwd = run, cwd
        self.launched = run("roslaunch", package, file, port=port, cwd=cwd)
        self.launched.wait_for_line(r"Spawn status: SpawnModel: Successfully", _STARTING_S)
        self.url = _address(self.launched.wait_for_line(r"^gazebo: http://", _STARTING_S))

    def type(self, *words: str) -> str:
        """Type the command of a window in a second terminal; returns the address it prints."""
        other = self._run(*words, port=self.launched.port, cwd=self._cwd)
        return _address(other.wait_for_line(r"^\w+: http://", _STARTING_S))

    def eventually(self, condition: Callable[[], Any]) -> Any:
        """Return what a condition gives as soon as that is true."""
        return self.launched.eventually(condition)

    def message(self, topic: str) -> Any:
        """Return a topic's next message."""
        return self.launched.messages({topic: 1})[topic][0]

    def model_pose(self, name: str) -> Any:
        """Where the simulation has a model."""
        kind = "gazebo_msgs/srv/GetModelState"
        state = self.launched.call("/gazebo/get_model_state", kind, model_name=name)
        assert state.success
        return state.pose

    def link_pose(self, name: str) -> Any:
        """Where the simulation has a link: ``mira::base_link``."""
        kind = "gazebo_msgs/srv/GetLinkState"
        found = self.launched.call("/gazebo/get_link_state", kind, link_name=name)
        assert found.success
        return found.link_state.pose

    def joint(self, name: str) -> float:
        """Where the simulation has a joint, rad or m."""
        kind = "gazebo_msgs/srv/GetJointProperties"
        found = self.launched.call("/gazebo/get_joint_properties", kind, joint_name=name)
        assert found.success
        return float(found.position[0])

    def sim_time_s(self) -> float:
        """The simulation's clock."""
        kind = "gazebo_msgs/srv/GetWorldProperties"
        return float(self.launched.call("/gazebo/get_world_properties", kind).sim_time)


def choose_panel(seen: Any, title: str) -> Any:
    """Choose a panel from the menu Panels."""
    seen.page.get_by_role("button", name="Panels", exact=True).click()
    menu = seen.page.get_by_role("menu", name="Panels")
    menu.get_by_role("menuitem").filter(has_text=title).first.click()


def _address(line: str) -> str:
    return line.split(": ", 1)[1].strip()
