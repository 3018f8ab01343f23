"""What each rosdep key comes to: brought by Gazelle, not needed, Python's, compiled, unknown."""

from __future__ import annotations

import enum
from collections.abc import Iterable
from functools import cache
from importlib.util import find_spec
from typing import NamedTuple

from gazelle.control.controllers.registry import known_types as controller_types
from gazelle.cpp.provided_packages import PROVIDED
from gazelle.diagnostics import nearest_names
from gazelle.doctor.packages.dependency_checks import is_ros_package, is_slip, known_packages
from gazelle.interfaces import known_types as message_types
from gazelle.launch.environment import drop_in_folder
from gazelle.node_specs.registry import builtin_packages
from gazelle.workspace import Workspace

__all__ = ["Answer", "Kind", "judge"]

_BUILD_ONLY = frozenset(
    {
        "catkin", "cmake", "cmake_modules", "eigen", "eigen3_cmake_module", "gtest",
        "message_generation", "message_runtime", "pkg-config", "pluginlib", "pybind11_vendor",
        "python_cmake_module", "roslint", "rostest", "rosunit",
    }
)  # fmt: skip
_BUILD_PREFIXES = ("ament_", "rosidl_", "libgtest", "google-mock")
# What they are for is done by Gazelle's own commands, engine, page and readers.
_REPLACED = frozenset(
    {
        "gazebo_dev", "joint_limits_interface", "liburdfdom-dev", "liburdfdom-tools",
        "libgazebo-dev", "ros2cli", "ros2launch", "ros2run", "ros_control", "ros_controllers",
        "ros_gz", "rosbash", "transmission_interface", "urdfdom", "urdfdom_headers",
    }
)  # fmt: skip
# Python keys whose module has another name; the others are named as their key says.
_MODULES = {
    "opencv": "cv2", "pil": "PIL", "pillow": "PIL", "scikit-image": "skimage", "serial": "serial",
    "scikit-learn": "sklearn", "yaml": "yaml", "tk": "tkinter", "opengl": "OpenGL",
}  # fmt: skip
_PIP_NAMES = {
    "opencv": "opencv-python", "pil": "pillow", "yaml": "pyyaml", "serial": "pyserial",
    "opengl": "PyOpenGL",
}  # fmt: skip
_PYTHON_PREFIXES = ("python3-", "python-")


class Kind(enum.Enum):
    """What a key comes to."""

    SOURCE = "is in the workspace"
    BROUGHT = "comes with Gazelle"
    BUILD_ONLY = "needed by compilers and build tools only"
    PYTHON = "Python modules that are installed"
    PYTHON_MISSING = "Python module that is not installed"
    COMPILED = "third-party package, mostly compiled"
    UNKNOWN = "no package of ROS that Gazelle knows"


class Answer(NamedTuple):
    """What is said of a key.

    Attributes:
        key: as the manifest has it.
        kind: what it comes to.
        advice: what a person can do, empty when there is nothing to do.
    """

    key: str
    kind: Kind
    advice: str = ""

    @property
    def is_met(self) -> bool:
        """Nothing is missing for it."""
        return self.kind in {Kind.SOURCE, Kind.BROUGHT, Kind.BUILD_ONLY, Kind.PYTHON}


def judge(key: str, workspace: Workspace, own: Iterable[str]) -> Answer:
    """Return what a key comes to.

    Args:
        key: name in a ``package.xml``.
        workspace: finds packages that are installed or built in.
        own: names of the packages looked at.
    """
    if key in set(own):
        return Answer(key, Kind.SOURCE)
    package = workspace.packages.get(key)
    if package is not None and not package.is_builtin:
        return Answer(key, Kind.SOURCE, f"at {package.path}")
    if package is not None or key in _brought():
        return Answer(key, Kind.BROUGHT)
    if key in _BUILD_ONLY or key.startswith(_BUILD_PREFIXES):
        return Answer(key, Kind.BUILD_ONLY)
    if any(row.name == key for row in PROVIDED):
        return Answer(key, Kind.BROUGHT)
    if key.startswith(_PYTHON_PREFIXES):
        return _python(key)
    if is_ros_package(key):
        return Answer(key, Kind.COMPILED, "put its sources into src: its nodes are compiled here")
    near = nearest_names(key, [*own, *known_packages()], count=1)
    if near and is_slip(key, near[0]):
        return Answer(key, Kind.UNKNOWN, f"did you mean '{near[0]}'?")
    return Answer(key, Kind.UNKNOWN, "a library of the system? the nodes that need it will say so")


@cache
def _brought() -> frozenset[str]:
    """Return packages with nodes, modules, messages or controllers that Gazelle has itself."""
    modules = {path.name for path in drop_in_folder().iterdir() if path.is_dir()}
    typed = {name.partition("/")[0] for name in (*message_types(), *controller_types())}
    return frozenset(builtin_packages() | modules | typed | _REPLACED)


def _python(key: str) -> Answer:
    name = key.removeprefix("python3-").removeprefix("python-").removesuffix("-pip").lower()
    module = _MODULES.get(name, name.replace("-", "_"))
    if find_spec(module) is not None:
        return Answer(key, Kind.PYTHON)
    return Answer(key, Kind.PYTHON_MISSING, f"pip install {_PIP_NAMES.get(name, name)}")
