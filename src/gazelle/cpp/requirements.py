"""What is said of a header or a package that C++ asks for and that is not here."""

from __future__ import annotations

import functools
from collections.abc import Iterable

from gazelle.cpp.provided_packages import provided, refusal
from gazelle.cpp.runtime_libraries import include_roots
from gazelle.diagnostics import did_you_mean

__all__ = ["header_advice", "library_advice", "package_advice", "refused_header"]

_REFUSED_FOLDERS = {
    "gazebo": "gazebo", "gazebo_plugins": "gazebo_plugins", "gazebo_ros": "gazebo_ros",
    "gazebo_ros_control": "gazebo_ros_control", "sdf": "sdformat", "ignition": "ignition-gazebo",
    "gz": "gz-sim", "ros_gz_bridge": "ros_gz_bridge",
    "rviz": "rviz", "rviz_common": "rviz_common", "rviz_rendering": "rviz_rendering",
    "rviz_default_plugins": "rviz_default_plugins", "rqt_gui_cpp": "rqt_gui_cpp",
    "nav_core": "nav_core", "nav2_core": "nav2_core", "costmap_2d": "costmap_2d",
    "nav2_costmap_2d": "nav2_costmap_2d", "base_local_planner": "base_local_planner",
    "nav2_util": "nav2_util", "nav2_behavior_tree": "nav2_behavior_tree",
}  # fmt: skip
_REFUSED_FOLDERS_OF_ROS2 = {
    name: name for name in ("controller_interface", "hardware_interface", "controller_manager")
}

_SYSTEM = {
    "opencv2": "OpenCV (apt install libopencv-dev)",
    "pcl": "PCL (apt install libpcl-dev)",
    "Eigen": "Eigen (pip install 'gazelle-sim[cpp]')",
    "boost": "Boost (pip install 'gazelle-sim[cpp]')",
    "yaml-cpp": "yaml-cpp (apt install libyaml-cpp-dev)",
    "tinyxml.h": "TinyXML (apt install libtinyxml-dev)",
    "tinyxml2.h": "TinyXML 2 (apt install libtinyxml2-dev)",
    "curses.h": "ncurses (apt install libncurses-dev)",
    "ncurses.h": "ncurses (apt install libncurses-dev)",
    "QApplication": "Qt (apt install qtbase5-dev)",
    "SDL": "SDL (apt install libsdl1.2-dev)",
    "fcl": "FCL (apt install libfcl-dev)",
    "assimp": "Assimp (apt install libassimp-dev)",
    "nlohmann": "JSON for C++ (apt install nlohmann-json3-dev)",
    "fmt": "fmt (apt install libfmt-dev)",
    "sensor_msgs/image_encodings.h": "",
}
"""The library of the system that a folder of headers belongs to, and how it is installed."""


_COMPILED_BOOST = (
    "filesystem", "iostreams", "locale", "log", "program_options", "regex", "serialization",
    "timer",
)  # fmt: skip
"""Libraries of Boost that are more than headers, and that Gazelle does not bring."""


def refused_header(header: str, generation: int) -> str:
    """Return the refused package that a header belongs to, empty for others."""
    folder = header.partition("/")[0]
    if "/" not in header:
        return ""
    if folder in _REFUSED_FOLDERS:
        return _REFUSED_FOLDERS[folder]
    # The light interfaces of ROS 1's controllers are there; those of ROS 2 are not.
    return _REFUSED_FOLDERS_OF_ROS2.get(folder, "") if generation == 2 else ""


def header_advice(header: str, generation: int) -> tuple[str, str]:
    """Return what to say of a header that is nowhere, and what to do.

    Args:
        header: as it is included.
        generation: of ROS.
    """
    if name := refused_header(header, generation):
        return f"'{header}' is of '{name}': {refusal(name, generation)}", ""
    folder = header.partition("/")[0]
    if _SYSTEM.get(folder):
        library, _, how = _SYSTEM[folder].partition(" (")
        return f"'{header}' is of {library}, which is not installed here", how.removesuffix(")")
    near = did_you_mean(header, _own_headers(generation))
    if folder in provided(generation) or any(
        name.startswith(f"{folder}/") for name in _own_headers(generation)
    ):
        return f"Gazelle's C++ headers of '{folder}' have no '{header}'", near
    if "/" in header:
        text = f"'{header}' is of no package of the workspace, of Gazelle or of this system"
        return text, near or f"put the package '{folder}' into the workspace, or install it"
    return f"'{header}' is nowhere", near


def library_advice(symbols: Iterable[str]) -> tuple[str, str]:
    """Return what to say of functions that are in no library, and what to do; empty for nothing.

    Args:
        symbols: as the linker names them.
    """
    for symbol in symbols:
        part = next((part for part in _COMPILED_BOOST if f"boost::{part}::" in symbol), "")
        if part:
            text = f"Boost's library '{part}' is not installed here; its headers alone do not do"
            return text, f"apt install libboost-{part.replace('_', '-')}-dev"
    return "", ""


def package_advice(name: str, generation: int) -> tuple[str, str]:
    """Return what to say of a package that ``find_package`` does not find, and what to do."""
    if why := refusal(name, generation):
        return f"'{name}' is left out: {why}", ""
    other = 2 if generation == 1 else 1
    if name in provided(other):
        return (
            f"'{name}' is a package of ROS {other}, and this package is one of ROS {generation}",
            "",
        )
    near = did_you_mean(name, provided(generation))
    text = f"there is no package '{name}' in the workspace, and Gazelle has no C++ of one"
    return text, near or f"put '{name}' into the workspace, or install it on this system"


@functools.cache
def _own_headers(generation: int) -> frozenset[str]:
    return frozenset(
        file.relative_to(root).as_posix()
        for root in include_roots(generation)
        for file in root.rglob("*")
        if file.is_file()
    )
