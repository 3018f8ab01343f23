"""What C++ of a package needs that is not here: headers and packages, told without a compiler.

Also where a header that the compiler missed would come from.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from gazelle.cpp.provided_packages import provided, refusal
from gazelle.cpp.runtime_libraries import include_roots
from gazelle.diagnostics import SourceSpan, did_you_mean
from gazelle.documents.files import is_file
from gazelle.workspace import Package

__all__ = ["Missing", "header_advice", "missing", "package_advice", "refused_header"]

_INCLUDE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*([<\"])([^>\"]+)[>\"]")
_CONDITION = re.compile(r"^[ \t]*#[ \t]*(if|ifdef|ifndef|else|elif|endif)\b")
_SUFFIXES = frozenset({".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".hxx"})
_LARGEST_SOURCE = 4 << 20

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


@dataclass(frozen=True, slots=True)
class Missing:
    """Something that C++ needs and that is not here.

    Attributes:
        kind: what it is.
        name: the header's path or the package's name.
        span: where it is asked for.
        text: what is the matter, in one line.
        fix: what to do about it, empty where there is nothing.
    """

    kind: Literal["header", "package", "refused"]
    name: str
    span: SourceSpan
    text: str
    fix: str = ""


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
    if folder in _SYSTEM and _SYSTEM[folder]:
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


def package_advice(name: str, generation: int) -> tuple[str, str]:
    """Return what to say of a package that ``find_package`` does not find, and what to do."""
    if why := refusal(name, generation):
        return f"'{name}' is left out: {why}", ""
    other = 2 if generation == 1 else 1
    if name in provided(other):
        return f"'{name}' is a package of ROS {other}, and this package is one of ROS {generation}", ""
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


def missing(package: Package, others: Iterable[Package] = ()) -> list[Missing]:
    """Return what C++ of a source package needs that is not here, without a compiler.

    Args:
        package: whose files are read.
        others: packages of the workspace, whose headers count as there.
    """
    generation = package.ros_version or 0
    found: list[Missing] = []
    tops = [package.path, *(other.path for other in others)]
    seen: set[str] = set()
    for file in _sources(package.path):
        for header, span in _included(file):
            if header in seen or _is_there(header, file, tops, generation):
                continue
            seen.add(header)
            text, fix = header_advice(header, generation)
            kind: Literal["header", "refused"] = (
                "refused" if refused_header(header, generation) else "header"
            )
            found.append(Missing(kind, header, span, text, fix))
    return found


def _sources(top: Path) -> Iterator[Path]:
    for folder in ("include", "src", ""):
        files = (top / folder).rglob("*") if folder else top.glob("*")
        for file in sorted(files):
            if file.suffix in _SUFFIXES and is_file(file):
                yield file


def _included(file: Path) -> Iterator[tuple[str, SourceSpan]]:
    """Yield the headers that a file includes whatever the compiler's macros say."""
    if file.stat().st_size > _LARGEST_SOURCE:
        return
    depth, is_guard = 0, True
    for number, line in enumerate(file.read_text("utf-8", errors="replace").splitlines(), 1):
        if condition := _CONDITION.match(line):
            if condition[1] in ("if", "ifdef", "ifndef"):
                # An include guard is no condition.
                depth += 0 if is_guard and condition[1] == "ifndef" else 1
                is_guard = False
            elif condition[1] == "endif":
                depth = max(0, depth - 1)
        elif not depth and (match := _INCLUDE.match(line)):
            span = SourceSpan(str(file), number, match.start(2) + 1, len(match[2]))
            yield match[2], span


@functools.cache
def _system_folders() -> tuple[Path, ...]:
    from gazelle.cpp.toolchain import NoToolchainError, find_toolchain

    folders = [Path("/usr/local/include"), Path("/usr/include")]
    folders += sorted(Path("/usr/include").glob("*-linux-gnu*"))
    folders += [Path("/usr/include/eigen3"), Path("/usr/include/opencv4")]
    folders += sorted(Path("/usr/include").glob("pcl-*"))
    try:
        toolchain = find_toolchain()
        folders += [folder for folder in (toolchain.boost, toolchain.eigen) if folder]
    except NoToolchainError:
        # Then that is what is told, and nothing of headers.
        folders += []
    return tuple(folders)


def _is_there(header: str, file: Path, tops: Iterable[Path], generation: int) -> bool:
    if "/" not in header and not header.endswith((".h", ".hpp", ".hh")):
        # The C++ library's own.
        return True
    if is_file(file.parent / header) or header in _own_headers(generation):
        return True
    roots = [top / folder for top in tops for folder in ("include", "src", "")]
    if any(is_file(root / header) for root in (*roots, *_system_folders())):
        return True
    if _is_generated(header, generation):
        return True
    return "/" not in header and (_is_below(header, tops) or _is_of_compiler(header))


def _is_below(header: str, tops: Iterable[Path]) -> bool:
    return any(next(top.rglob(header), None) is not None for top in tops)


def _is_of_compiler(header: str) -> bool:
    places = Path("/usr/lib").glob(f"gcc/*/*/include/{header}")
    return next(places, None) is not None


def _is_generated(header: str, generation: int) -> bool:
    """Tell whether a header is made of a message, a service, an action or a .cfg file."""
    from gazelle.cpp.build_messages import known_messages

    if generation and is_file(known_messages(generation) / header):
        return True
    parts = header.split("/")
    if generation == 2 and len(parts) > 2:
        return parts[1] in ("msg", "srv", "action")
    return generation == 1 and len(parts) == 2 and parts[1][:1].isupper()
