"""The declarative part of ``setup.cfg``, as arguments of ``setup()``."""

from __future__ import annotations

import configparser
from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.documents.names import names_matching

__all__ = ["cfg_arguments"]

_LISTS = {"py_modules", "scripts", "install_requires"}


def cfg_arguments(folder: Path, find: Callable[..., Any]) -> dict[str, Any]:
    """Return what ``[metadata]`` and ``[options…]`` of a package's ``setup.cfg`` say.

    Args:
        folder: of the package.
        find: setuptools' ``find_packages``.
    """
    parser = configparser.ConfigParser(interpolation=None)
    parser.optionxform = str  # type: ignore[assignment,method-assign]
    try:
        parser.read(folder / "setup.cfg", encoding="utf-8")
    except (configparser.Error, UnicodeDecodeError):
        return {}
    found: dict[str, Any] = {}
    for key in ("name", "version"):
        value = parser.get("metadata", key, fallback="")
        # "attr:" and "file:" name places that are not read here.
        if value and ":" not in value:
            found[key] = value
    if not parser.has_section("options"):
        return found
    for key, value in parser.items("options"):
        if key in _LISTS:
            found[key] = _lines(value)
        elif key == "packages":
            is_search = value.strip() in {"find:", "find_namespace:"}
            where = parser.get("options.packages.find", "where", fallback=".").strip()
            exclude = _lines(parser.get("options.packages.find", "exclude", fallback=""))
            found[key] = find(where, exclude) if is_search else _lines(value)
        elif key == "package_dir":
            pairs = (line.partition("=") for line in _lines(value))
            found[key] = {name.strip(): place.strip() for name, _, place in pairs}
    for section, key in (("options.package_data", "package_data"),
                         ("options.entry_points", "entry_points")):  # fmt: skip
        if parser.has_section(section):
            rows = parser.items(section)
            found[key] = {name.replace("*", ""): _lines(value) for name, value in rows}
    if parser.has_section("options.data_files"):
        rows = parser.items("options.data_files")
        found["data_files"] = [(name, _files(folder, value)) for name, value in rows]
    return found


def _files(folder: Path, value: str) -> list[str]:
    found = []
    for line in _lines(value):
        names = names_matching(line, folder) if "*" in line else []
        found += names or [line]
    return found


def _lines(value: str) -> list[str]:
    parts = value.splitlines() if "\n" in value.strip() else value.split(",")
    return [part.strip() for part in parts if part.strip()]
