"""rosmsg's and rossrv's functions: lists and texts of definitions."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from gazelle.compat.rospkg import ResourceNotFound, RosPack
from gazelle.diagnostics import did_you_mean
from gazelle.errors import NotFoundError
from gazelle.interfaces import (
    add_package,
    definition,
    find_source,
    known_types,
    md5sum,
    service_md5sum,
    show_message,
    show_service,
)
from gazelle.interfaces.definition import RosVersion

__all__ = [
    "MODE_MSG",
    "MODE_SRV",
    "ROSMsgException",
    "get_msg_text",
    "get_srv_text",
    "iterate_packages",
    "list_msgs",
    "list_srvs",
    "list_types",
    "rosmsg_md5",
    "rosmsg_search",
]

MODE_MSG = ".msg"
MODE_SRV = ".srv"


class ROSMsgException(Exception):  # noqa: N818 - rosmsg's name
    """A type cannot be shown."""


def get_msg_text(type_: str, raw: bool = False, rospack: RosPack | None = None) -> str:
    """Return a message's fields, those of its parts indented; its own text if `raw`.

    Raises:
        ROSMsgException: nothing defines it.
    """
    _add_definitions(type_, rospack)
    try:
        if raw:
            return definition(type_, RosVersion.ROS1).text
        return show_message(type_)
    except NotFoundError as error:
        raise ROSMsgException(f"Unable to load msg [{type_}]: {error}") from error


def get_srv_text(type_: str, raw: bool = False, rospack: RosPack | None = None) -> str:
    """Return the fields of a service's request and response; its own text if `raw`.

    Raises:
        ROSMsgException: nothing defines it.
    """
    _add_definitions(type_, rospack)
    package, _, name = type_.partition("/")
    source = find_source(package, "srv", name, RosVersion.ROS1)
    if source is None:
        known = [_short_type_name(one) for one in known_types("srv")]
        text = f"Unknown srv type [{type_}]; {did_you_mean(type_, known)}"
        raise ROSMsgException(text.rstrip("; "))
    return source.text if raw else show_service(type_)


def list_types(package: str, mode: str = MODE_MSG, rospack: RosPack | None = None) -> list[str]:
    """Return a package's types, as ``pkg/Name``.

    Raises:
        ValueError: the mode is none.
        ResourceNotFound: there is no such package.
    """
    part = _interface_kind(mode)
    _add_definitions(package)
    found = [_short_type_name(one) for one in known_types(part, package)]
    if not found:
        (rospack or RosPack()).get_path(package)
    return sorted(found)


def list_msgs(package: str, rospack: RosPack | None = None) -> list[str]:
    """Return a package's messages, as ``pkg/Name``."""
    return list_types(package, MODE_MSG, rospack)


def list_srvs(package: str, rospack: RosPack | None = None) -> list[str]:
    """Return a package's services, as ``pkg/Name``."""
    return list_types(package, MODE_SRV, rospack)


def iterate_packages(rospack: RosPack | None, mode: str) -> Iterator[tuple[str, str]]:
    """Yield name and folder of each package with messages or services of its own.

    What Gazelle brings has a folder only where the workspace has the package too; it is empty
    otherwise.

    Raises:
        ValueError: the mode is none.
    """
    part = _interface_kind(mode)
    packs = rospack or RosPack()
    folders = {name: Path(packs.get_path(name)) for name in packs.list()}
    for name, folder in folders.items():
        if (folder / part).is_dir():
            add_package(name, folder)
    for name in sorted({one.partition("/")[0] for one in known_types(part)}):
        folder = folders.get(name, Path()) / part
        yield name, str(folder) if folder.is_dir() else ""


def rosmsg_search(rospack: RosPack | None, mode: str, base_type: str) -> Iterator[str]:
    """Yield ``pkg/Name`` of the types of one name in all packages.

    Raises:
        ValueError: the mode is none.
    """
    for name, _ in iterate_packages(rospack, mode):
        for one in known_types(_interface_kind(mode), name):
            if one.rpartition("/")[2] == base_type:
                yield _short_type_name(one)


def rosmsg_md5(mode: str, type_: str) -> str:
    """Return the MD5 sum of a type.

    Raises:
        ValueError: the mode is none.
        ROSMsgException: nothing defines it.
    """
    of_part: Any = {"msg": md5sum, "srv": service_md5sum}[_interface_kind(mode)]
    _add_definitions(type_)
    try:
        return str(of_part(type_))
    except NotFoundError as error:
        raise ROSMsgException(f"Unable to load {mode[1:]} [{type_}]: {error}") from error


def _interface_kind(mode: str) -> str:
    if mode not in (MODE_MSG, MODE_SRV):
        raise ValueError(f"Unknown mode for iterate_packages: {mode}")
    return mode[1:]


def _add_definitions(type_or_package: str, rospack: RosPack | None = None) -> None:
    """Take the definitions of a package into account, of the workspace unless it is told where."""
    package = type_or_package.partition("/")[0]
    try:
        folder = Path((rospack or RosPack()).get_path(package))
    except ResourceNotFound:
        return
    if (folder / "msg").is_dir() or (folder / "srv").is_dir():
        add_package(package, folder)


def _short_type_name(name: str) -> str:
    return f"{name.partition('/')[0]}/{name.rpartition('/')[2]}"
