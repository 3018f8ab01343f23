"""Where the files of a source package lie that its CMakeLists.txt installs to other places.

``install(DIRECTORY description/urdf DESTINATION share/${PROJECT_NAME})`` makes
``$(find pkg)/urdf`` of what is ``description/urdf`` in the source folder. In a workspace that
was never built such addresses lead nowhere without reading that line.
"""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from gazelle.limits.names import exists, is_file

__all__ = ["installed_source"]

_LISTS = "CMakeLists.txt"
_MANIFESTS = ("package.xml", "manifest.xml")
_COMMENT = re.compile(r"#[^\n]*")
_INSTALL = re.compile(r"\binstall\s*\(([^()]*)\)", re.IGNORECASE)
_AMENT_AUTO = re.compile(r"\bament_auto_package\s*\(([^()]*)\)", re.IGNORECASE)
_PROJECT = re.compile(r"\bproject\s*\(\s*([\w.+-]+)", re.IGNORECASE)
_FOLDERS, _FILES, _TO_SHARE = "DIRECTORY", ("FILES", "PROGRAMS"), "INSTALL_TO_SHARE"
_KEYWORD = re.compile(r"[A-Z_]{3,}")


class _Rule(NamedTuple):
    """What lies at `target` of the share folder when the package is installed."""

    target: str
    source: str


def installed_source(path: Path) -> Path | None:
    """Return the source of a file that installing would put at `path`, None when nothing would.

    Args:
        path: absolute, in a folder of a source package as if it were its share folder.
    """
    package = next((item for item in path.parents if _is_package(item)), None)
    if package is None:
        return None
    inside = path.relative_to(package).as_posix()
    for rule in _rules(package / _LISTS):
        if inside == rule.target:
            found = package / rule.source
        elif not rule.target or inside.startswith(rule.target + "/"):
            found = package / rule.source / inside[len(rule.target) :].lstrip("/")
        else:
            continue
        if found != path and exists(found):
            return found
    return None


def _is_package(folder: Path) -> bool:
    return is_file(folder / _LISTS) and any(is_file(folder / name) for name in _MANIFESTS)


@lru_cache(maxsize=256)
def _rules(lists: Path) -> tuple[_Rule, ...]:
    """Return the rules of a file whose places in the source and in the share folder differ."""
    text = _COMMENT.sub("", lists.read_text(encoding="utf-8", errors="replace"))
    project = _PROJECT.search(text)
    name = project.group(1) if project else lists.parent.name
    for variable in ("${PROJECT_NAME}", "${CMAKE_PROJECT_NAME}"):
        text = text.replace(variable, name)
    text = text.replace("${CATKIN_PACKAGE_SHARE_DESTINATION}", f"share/{name}")
    text = text.replace("${CMAKE_CURRENT_SOURCE_DIR}/", "").replace("${PROJECT_SOURCE_DIR}/", "")
    found: list[_Rule] = []
    for command in _INSTALL.finditer(text):
        found.extend(_rules_of(command.group(1).replace('"', " ").split(), f"share/{name}"))
    for command in _AMENT_AUTO.finditer(text):
        words = command.group(1).replace('"', " ").split()
        if _TO_SHARE in words:
            found.extend(_placed(_values(words, _TO_SHARE), ""))
    return tuple(rule for rule in found if rule.target != rule.source)


def _rules_of(words: list[str], share: str) -> list[_Rule]:
    destination = next(iter(_values(words, "DESTINATION")), "").rstrip("/")
    if destination != share and not destination.startswith(share + "/"):
        return []
    target = destination[len(share) :].lstrip("/")
    if words[0] == _FOLDERS:
        return _placed(_values(words, _FOLDERS), target)
    if words[0] not in _FILES:
        return []
    renamed = next(iter(_values(words, "RENAME")), "")
    sources = _values(words, words[0])
    return [_Rule(_joined(target, renamed or Path(item).name), item) for item in sources]


def _placed(folders: list[str], target: str) -> list[_Rule]:
    """Return where folders go: with a slash at the end their contents, else they themselves."""
    return [
        _Rule(target if item.endswith("/") else _joined(target, Path(item).name), item.rstrip("/"))
        for item in folders
    ]


def _values(words: list[str], keyword: str) -> list[str]:
    """Return the words after a keyword, up to the next one."""
    if keyword not in words:
        return []
    rest = words[words.index(keyword) + 1 :]
    end = next((place for place, word in enumerate(rest) if _KEYWORD.fullmatch(word)), len(rest))
    return rest[:end]


def _joined(folder: str, name: str) -> str:
    return f"{folder}/{name}" if folder else name
