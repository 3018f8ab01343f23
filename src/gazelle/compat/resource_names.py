"""Names of messages and services, ``package/Name``, as `roslib.names` takes them apart."""

from __future__ import annotations

import re

from gazelle.compat.rosgraph.names import is_legal_base_name

__all__ = [
    "BASE_RESOURCE_NAME_LEGAL_CHARS_P",
    "PRN_SEPARATOR",
    "RESOURCE_NAME_LEGAL_CHARS_P",
    "TYPE_SEPARATOR",
    "is_legal_resource_base_name",
    "is_legal_resource_name",
    "package_resource_name",
    "resource_name",
    "resource_name_base",
    "resource_name_package",
]

PRN_SEPARATOR = TYPE_SEPARATOR = "/"
RESOURCE_NAME_LEGAL_CHARS_P = re.compile(r"^[A-Za-z][\w/]*$")
BASE_RESOURCE_NAME_LEGAL_CHARS_P = re.compile(r"^[A-Za-z]\w*$")
is_legal_resource_base_name = is_legal_base_name


def is_legal_resource_name(name: str | None) -> bool:
    """Tell whether a name may be a resource's: letters, digits, ``_`` and single slashes."""
    if name is None or "//" in name:
        return False
    return RESOURCE_NAME_LEGAL_CHARS_P.fullmatch(name) is not None


def resource_name(res_pkg_name: str, name: str, my_pkg: str | None = None) -> str:
    """Return ``package/Name``, only the name inside of the package itself."""
    return name if res_pkg_name == my_pkg else f"{res_pkg_name}/{name}"


def resource_name_base(name: str) -> str:
    """Return the name without its package."""
    return name.rpartition("/")[2]


def resource_name_package(name: str) -> str | None:
    """Return the package of a name, None without one."""
    return name.partition("/")[0] if "/" in name else None


def package_resource_name(name: str) -> tuple[str, str]:
    """Return package and name; the package is empty without one.

    Raises:
        ValueError: the name has more than one slash.
    """
    package, _, base = name.rpartition("/")
    if "/" in package:
        raise ValueError(f"invalid name [{name}]")
    return package, base
