"""Parameters of ``joy_node``, of both generations.

| ROS 1, joy_linux | ROS 2 | default | meaning |
| --- | --- | --- | --- |
| ~dev | | /dev/input/js0 | the device |
| ~dev_name | ~device_name | "" | the first device of this name in its place |
| | ~device_id | 0 | ROS 2: the n-th device |
| ~deadzone | ~deadzone | 0.05 | share of full deflection that counts as none |
| ~autorepeat_rate | ~autorepeat_rate | 0, ROS 2: 20 | Hz at which the state is sent again |
| ~coalesce_interval | ~coalesce_interval_ms | 1 ms | events of axes within it become one message |
| ~default_trig_val | | false | take what axes say at the opening, else they begin at 0 |
| ~sticky_buttons | ~sticky_buttons | false | a press toggles |
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from gazelle.diagnostics import Diagnostics
from gazelle.nodes.parameters import node_reader
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.reader import ParameterReader

__all__ = ["PARAMETERS", "JoyOptions", "read_options"]

_FULL = 32767.0
_MAX_DEADZONE = 0.9
_ROWS = (
    Parameter("dev", "text", "/dev/input/js0", "the device"),
    Parameter("device_name", "text", "", "the first device of this name", aliases=("dev_name",)),
    Parameter("device_id", "integer", 0, "the n-th device", low=0),
    Parameter("deadzone", "number", 0.05, "share of full deflection that counts as none"),
    Parameter("autorepeat_rate", "number", 0.0, "the state is sent again so often", "Hz", 0, 1000),
    Parameter("coalesce_interval", "number", 0.001, "events of axes become one message", "s", 0),
    Parameter("coalesce_interval_ms", "number", 1.0, "the same, ROS 2's name", "ms", 0),
    Parameter("default_trig_val", "flag", False, "take what axes say at the opening"),
    Parameter("sticky_buttons", "flag", False, "a press toggles"),
    *refused("the joystick is not shaken here", "dev_ff"),
)
PARAMETERS = ParameterTable("joy_node", "a joystick of the Linux kernel", ("joy/joy_node",), _ROWS)


@dataclass(frozen=True, slots=True)
class JoyOptions:
    """What the parameters come to.

    Attributes:
        path: device, where it is given by path or number.
        device_name: device by name, empty for by path.
        deadzone: 0 to 0.9.
        repeat_s, coalesce_s: seconds; `repeat_s` is 0 for never.
        takes_initial: axes begin as the device says.
        sticky_buttons: a press toggles.
        frame_id: of the messages.
    """

    path: Path
    device_name: str
    deadzone: float
    repeat_s: float
    coalesce_s: float
    takes_initial: bool
    sticky_buttons: bool
    frame_id: str


def read_options(
    tree: Mapping[str, Any], name: str, ros_version: Literal[1, 2], found: Diagnostics
) -> JoyOptions:
    """Read the parameters of a node.

    Args:
        tree: the parameters.
        name: of the node.
        ros_version: of ROS.
        found: receives what is wrong.
    """
    settings = node_reader(PARAMETERS, tree, name, found)
    is_ros2 = ros_version == 2
    path = Path(settings.text("dev"))
    if is_ros2 and not settings.has("dev"):
        path = Path(f"/dev/input/js{settings.integer('device_id')}")
    rate = settings.number("autorepeat_rate", 20.0 if is_ros2 else 0.0)
    coalesce_s = settings.number("coalesce_interval")
    if settings.has("coalesce_interval_ms"):
        coalesce_s = settings.number("coalesce_interval_ms") / 1000
    if rate > 0 and coalesce_s > 0 and rate > 1 / coalesce_s:
        text = f"autorepeat_rate ({rate:g} Hz) > 1/coalesce_interval ({1 / coalesce_s:g} Hz) "
        settings.report("parameter.bad-value", f"{text}does not make sense")
    # The file that ROS 2 ships writes "''" for no name.
    device_name = settings.text("device_name").strip().strip("'")
    settings.report_unknown()
    return JoyOptions(
        path,
        device_name,
        _deadzone(settings),
        1 / rate if rate > 0 else 0.0,
        coalesce_s,
        is_ros2 or settings.flag("default_trig_val"),
        settings.flag("sticky_buttons"),
        "joy" if is_ros2 else str(path),
    )


def _deadzone(settings: ParameterReader) -> float:
    value = settings.number("deadzone")
    used = value / _FULL if value >= 1 else value
    used = min(max(used, 0.0), _MAX_DEADZONE)
    if used != value:
        text = f"deadzone {value:g} is not a share from 0 to {_MAX_DEADZONE}; {used:g} is used"
        settings.report("parameter.bad-value", text, "write a share of full deflection")
    return used
