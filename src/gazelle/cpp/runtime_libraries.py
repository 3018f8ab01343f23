"""The libraries of C++ that come with Gazelle as sources, a row for each.

``core`` and the client library of the ROS in question are part of every node; the others are
compiled when a package first links them. Names of the originals' libraries and targets lead here by
`gazelle.cpp.provided_packages`.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

__all__ = ["HERE", "LIBRARIES", "RuntimeLibrary", "include_roots", "with_needs"]

HERE = Path(__file__).parent


@dataclass(frozen=True, slots=True)
class RuntimeLibrary:
    """A library that is compiled from sources of ours.

    Attributes:
        name: ``tf2`` for ``libgazelle_tf2.so``.
        needs: the libraries it is linked with, by name.
        generation: 1 or 2 for headers of that ROS, 0 where it includes none.
        folder: of its sources below ``runtime``; its name where empty.
        system: libraries of the system it is linked with.
    """

    name: str
    needs: tuple[str, ...] = ()
    generation: int = 0
    folder: str = ""
    system: tuple[str, ...] = ()

    @property
    def sources(self) -> tuple[Path, ...]:
        """Its files of C and C++, sorted."""
        folder = HERE / "runtime" / (self.folder or self.name)
        files = (*folder.rglob("*.cpp"), *folder.rglob("*.c"))
        return tuple(sorted(file for file in files if file.name != "node_start.c"))

    @property
    def file_name(self) -> str:
        """``libgazelle_tf2.so``."""
        return f"libgazelle_{self.name}.so"


LIBRARIES: dict[str, RuntimeLibrary] = {
    row.name: row
    for row in (
        RuntimeLibrary("core", system=("dl", "pthread")),
        RuntimeLibrary("boost_thread", system=("pthread",)),
        RuntimeLibrary("roscpp", ("core",), 1),
        RuntimeLibrary("rclcpp", ("core",), 2),
        RuntimeLibrary("rclcpp_action", ("rclcpp",), 2),
        RuntimeLibrary("rclcpp_lifecycle", ("rclcpp",), 2),
        RuntimeLibrary("rclcpp_components", ("rclcpp", "class_loader"), 2),
        RuntimeLibrary("class_loader", ("core",)),
        RuntimeLibrary("dynamic_reconfigure", ("roscpp",), 1),
        RuntimeLibrary("nodelet", ("roscpp", "class_loader"), 1),
        RuntimeLibrary("nodelet_program", ("nodelet",), 1),
        RuntimeLibrary("image_transport", ("roscpp", "class_loader"), 1),
        RuntimeLibrary("camera_info_manager", ("image_transport",), 1),
        RuntimeLibrary("rosbag", ("roscpp",), 1),
        RuntimeLibrary("urdf", ("core",)),
        RuntimeLibrary("control", ("roscpp", "class_loader", "urdf"), 1),
        RuntimeLibrary("moveit_core", ("core",)),
        RuntimeLibrary("moveit1", ("moveit_core", "roscpp"), 1),
        RuntimeLibrary("moveit2", ("moveit_core", "rclcpp", "rclcpp_action"), 2),
        RuntimeLibrary("tf2", ("core",)),
        RuntimeLibrary("tf2_ros1", ("tf2", "roscpp"), 1),
        RuntimeLibrary("tf2_ros2", ("tf2", "rclcpp"), 2),
        RuntimeLibrary("tf", ("tf2_ros1",), 1),
        RuntimeLibrary("kdl", ("core",)),
    )
}


def include_roots(generation: int) -> tuple[Path, ...]:
    """Return the folders of our headers, most special first."""
    top = HERE / "include"
    special = (top / f"ros{generation}",) if generation else ()
    return (*special, top / "common")


def with_needs(names: tuple[str, ...] | list[str]) -> tuple[RuntimeLibrary, ...]:
    """Return libraries and all that they need, needed ones first."""
    found: dict[str, RuntimeLibrary] = {}

    def add(name: str) -> None:
        if name in found:
            return
        row = LIBRARIES[name]
        for need in row.needs:
            add(need)
        found[name] = row

    for name in names:
        add(name)
    return tuple(found.values())
