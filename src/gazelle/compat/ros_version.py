"""Whether a program wants its messages in the form of ROS 1 or of ROS 2.

One launched process may be either, and its environment cannot tell: one launch starts both. The
first of these that gives an answer counts:

1. the module that imports the messages: does it import ``rclpy`` or ``rospy`` too?
2. which of the two the process has imported already;
3. the program itself (``__main__``), asked as in 1;
4. the ``package.xml`` above the importing module, then above the program: ament or catkin;
5. ``ROS_VERSION``, 1 without it.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from types import FrameType
from typing import Literal

__all__ = ["message_ros_version"]

RosVersion = Literal[1, 2]

_IMPORT = r"^[ \t]*(?:import|from)[ \t]+(?:{})\b"
_ROS1 = re.compile(
    _IMPORT.format("rospy|roslib|rosbag|actionlib|dynamic_reconfigure"), re.MULTILINE
)
_ROS2_MODULES = "rclpy|ament_index_python|launch_ros|rosbag2_py|rosidl_runtime_py|sensor_msgs_py"
_ROS2 = re.compile(_IMPORT.format(_ROS2_MODULES), re.MULTILINE)
_LEVELS = 4
_INSTALLED = ("site-packages", "dist-packages")
_PREFIX_LEVELS = 3


def message_ros_version() -> RosVersion:
    """Return 1 or 2 for the module that is just importing messages."""
    main = getattr(sys.modules.get("__main__"), "__file__", None)
    importer = _importing_file()
    answers: Iterable[RosVersion | None] = (
        _of_text(importer),
        _of_modules(),
        _of_text(main),
        _of_package(importer),
        _of_package(main),
    )
    for answer in answers:
        if answer is not None:
            return answer
    return 2 if os.environ.get("ROS_VERSION", "1") == "2" else 1


def _importing_file() -> str | None:
    """Return the file of the nearest caller that is no part of the import machinery."""
    finder = str(Path(__file__).with_name("import_hooks.py"))
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        name = frame.f_code.co_filename
        if name not in (__file__, finder) and "importlib" not in name:
            return name
        frame = frame.f_back
    return None


def _of_modules() -> RosVersion | None:
    return _either("rospy" in sys.modules, "rclpy" in sys.modules)


@cache
def _of_text(file: str | None) -> RosVersion | None:
    text = _text(file)
    return _either(bool(_ROS1.search(text)), bool(_ROS2.search(text)))


def _text(file: str | None) -> str:
    argv = sys.orig_argv
    if file in (None, "<string>") and "-c" in argv[:-1]:
        return argv[argv.index("-c") + 1]
    if file is None or file.startswith("<"):
        return ""
    try:
        return Path(file).read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


@cache
def _of_package(file: str | None) -> RosVersion | None:
    if file is None or file.startswith("<"):
        return None
    path = Path(file).resolve()
    folders = [*path.parents[:_LEVELS], *_share_folders(path)]
    for folder in folders:
        manifest = folder / "package.xml"
        if manifest.is_file():
            text = manifest.read_text(encoding="utf-8", errors="replace")
            return _either("catkin" in text, "ament" in text)
    return None


def _share_folders(path: Path) -> list[Path]:
    """Return ``PREFIX/share/PACKAGE`` of a module in ``PREFIX/lib/pythonX.Y/site-packages``."""
    parts = path.parts
    index = next((parts.index(name) for name in _INSTALLED if name in parts[:-1]), 0)
    if index < _PREFIX_LEVELS:
        return []
    return [Path(*parts[: index - 2], "share", Path(parts[index + 1]).stem)]


def _either(ros1: bool, ros2: bool) -> RosVersion | None:
    if ros1 == ros2:
        return None
    return 1 if ros1 else 2
