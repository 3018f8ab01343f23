"""Include folders of messages: of all that Gazelle knows, and of a user's package."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from gazelle.cpp.interfaces.ros1_headers import ros1_message_headers, ros1_service_headers
from gazelle.cpp.interfaces.ros2_headers import (
    ros2_action_headers,
    ros2_message_headers,
    ros2_service_headers,
)
from gazelle.documents import read_limited
from gazelle.interfaces import RosVersion, TypeStore, split_name
from gazelle.workspace.package_xml import MANIFEST_BYTES, quick_name

__all__ = ["known_messages", "package_messages", "package_name", "write_headers"]

_ACTION_ENDS = (
    "Action",
    "ActionGoal",
    "ActionResult",
    "ActionFeedback",
    "Goal",
    "Result",
    "Feedback",
)


def known_messages(generation: int, folder: Path | str) -> list[Path]:
    """Write the headers of everything that Gazelle's own data define for one ROS.

    Args:
        generation: 1 or 2.
        folder: becomes an include folder.

    Returns:
        What was written.
    """
    ros_version = RosVersion(generation)
    types = TypeStore()
    return write_headers(Path(folder), _headers(types, _known(types, ros_version), ros_version))


def package_messages(
    package_path: Path,
    generation: int,
    folder: Path,
    files: Sequence[Path],
    others: Sequence[Path] = (),
) -> list[Path]:
    """Write the headers of a user's package.

    Args:
        package_path: the package's folder.
        generation: 1 or 2.
        folder: becomes an include folder; files that are right already stay untouched.
        files: the package's definitions: ``.msg``, ``.srv``, ``.action``.
        others: folders of other packages that may define messages.

    Returns:
        All headers of the package.

    Raises:
        UserFileError: a definition has errors, or names a message that nothing defines.
    """
    types = TypeStore()
    for path in (*others, package_path):
        types.add_package(package_name(path), path)
    package = package_name(package_path)
    wanted = (f"{package}/{file.suffix[1:]}/{file.stem}" for file in files)
    ros_version = RosVersion(generation)
    return write_headers(folder, _headers(types, _derived(wanted, ros_version), ros_version))


def package_name(folder: Path) -> str:
    """Return the name that a package's ``package.xml`` gives it, else its folder's."""
    manifest = folder / "package.xml"
    if not manifest.is_file():
        return folder.name
    return quick_name(read_limited(manifest, MANIFEST_BYTES)) or folder.name


def write_headers(folder: Path, headers: Iterable[tuple[str, str]]) -> list[Path]:
    """Write files that are not there or differ; return all of them.

    Args:
        folder: is made where it is missing.
        headers: paths below it, and texts.
    """
    written: list[Path] = []
    made: set[Path] = set()
    for path, text in headers:
        file = folder / path
        if file.parent not in made:
            file.parent.mkdir(parents=True, exist_ok=True)
            made.add(file.parent)
        data = text.encode()
        if not file.is_file() or file.read_bytes() != data:
            file.write_bytes(data)
        written.append(file)
    return written


def _headers(
    types: TypeStore, wanted: Iterable[str], ros_version: RosVersion
) -> Iterator[tuple[str, str]]:
    for full in wanted:
        part = split_name(full)[1]
        if ros_version is RosVersion.ROS1:
            if part == "msg":
                yield from ros1_message_headers(types, full)
            else:
                yield from ros1_service_headers(types, full)
        elif part == "msg":
            yield from ros2_message_headers(types, full)
        elif part == "srv":
            yield from ros2_service_headers(types, full)
        else:
            yield from ros2_action_headers(types, full)


def _derived(wanted: Iterable[str], ros_version: RosVersion) -> Iterator[str]:
    """Yield types that have headers of their own: ROS 1's actions are seven messages."""
    for full in wanted:
        package, part, name = split_name(full)
        if part == "action" and ros_version is RosVersion.ROS1:
            yield from (f"{package}/msg/{name}{end}" for end in _ACTION_ENDS)
        else:
            yield full


def _known(types: TypeStore, ros_version: RosVersion) -> Iterator[str]:
    """Yield what is defined for one ROS, and what that contains."""
    wanted: dict[str, None] = {}
    for part in ("msg", "srv", "action"):
        for full in types.known_types(part):
            if types.find_source(*split_name(full), ros_version) is not None:
                wanted.update(dict.fromkeys(_derived((full,), ros_version)))
    left = list(wanted)
    while left:
        full = left.pop()
        for piece in _pieces(full, ros_version):
            for item in types.definition(piece, ros_version).fields:
                base = item.type.base
                if item.type.is_message and split_name(base)[1] == "msg" and base not in wanted:
                    wanted[base] = None
                    left.append(base)
    yield from sorted(wanted)


def _pieces(full: str, ros_version: RosVersion) -> tuple[str, ...]:
    part = split_name(full)[1]
    if part == "msg":
        return (full,)
    ends = ("_Request", "_Response") if part == "srv" else ("_Goal", "_Result", "_Feedback")
    return tuple(full + end for end in ends)
