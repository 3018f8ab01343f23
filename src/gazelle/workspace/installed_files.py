"""Where the files of a source package lie that its build files install to other places.

``install(DIRECTORY description/urdf DESTINATION share/${PROJECT_NAME})`` makes
``$(find pkg)/urdf`` of what is ``description/urdf`` in the source folder, and a row of
``data_files`` in ``setup.py`` may do the same. In a workspace that was never built such addresses
lead nowhere without reading those lines.
"""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path

from gazelle.documents import read_limited
from gazelle.documents.files import exists, is_file, is_folder
from gazelle.workspace.building.cmake_lists import read_cmake_lists
from gazelle.workspace.building.install_rules import InstallRule, cmake_rules
from gazelle.workspace.building.plan import Plan, add_rules
from gazelle.workspace.building.setup_py import read_setup
from gazelle.workspace.package_discovery import manifest_in
from gazelle.workspace.package_xml import (
    MANIFEST_BYTES,
    ManifestError,
    quick_name,
    read_manifest,
)

__all__ = ["install_rules", "installed_files", "installed_source", "made_texts"]

_BUILD_FILES = ("CMakeLists.txt", "setup.py")


def install_rules(folder: Path, name: str) -> tuple[InstallRule, ...]:
    """Return the rules of a source package whose places are known, read once.

    Args:
        folder: of the package.
        name: of the package.
    """
    return _rules(folder, name)


def installed_files(folder: Path, name: str) -> Mapping[str, Path]:
    """Return the files that installing puts below the prefix, their sources by their places."""
    plan = Plan()
    rules = (rule for rule in install_rules(folder, name) if exists(folder / rule.source))
    add_rules(plan, folder, rules, "{path}")
    return {item.target: item.source for item in plan.items.values() if item.source is not None}


def made_texts(folder: Path, name: str) -> Mapping[str, str]:
    """Return the texts that the build file writes, by their places in the share folder.

    ``configure_file(arm.urdf.xacro.in …)`` makes a file that no source folder has. One that a
    build has left in the source folder is not made again.

    Args:
        folder: of the package.
        name: of the package.
    """
    made = _made(folder, name)
    start = f"share/{name}/"
    found = {target: text for target, text in made.items() if not target.startswith("${")}
    for rule in _rules(folder, name):
        for target, text in rule.texts(made).items():
            if target.startswith(start):
                found[target.removeprefix(start)] = text
    return {target: text for target, text in found.items() if not exists(folder / target)}


def installed_source(path: Path) -> Path | None:
    """Return the source of a file that installing would put at `path`, None when nothing would.

    Args:
        path: absolute, in a folder of a source package as if it were its share folder.
    """
    package = next((item for item in path.parents if _is_package(item)), None)
    if package is None:
        return None
    inside = path.relative_to(package).as_posix()
    name = _name_of(package)
    found = _sources(install_rules(package, name), f"share/{name}/{inside}")
    candidates = (Path(posixpath.normpath(package / source)) for source in found)
    return next((one for one in candidates if one != path and exists(one)), None)


def _sources(rules: Iterable[InstallRule], target: str) -> Iterable[str]:
    """Yield the sources that rules put at a place, a folder's place included."""
    for rule in rules:
        destination = posixpath.normpath(rule.destination.lstrip("/"))
        if not rule.is_folder:
            if target == f"{destination}/{rule.renamed or posixpath.basename(rule.source)}":
                yield rule.source
            continue
        top = f"{destination}/{posixpath.basename(rule.source)}" if rule.keeps_name else destination
        if target == top:
            yield rule.source
        elif target.startswith(top + "/"):
            source = posixpath.normpath(f"{rule.source}{target[len(top) :]}")
            if not rule.matching or posixpath.normpath(rule.target(source) or "") == target:
                yield source


@lru_cache(maxsize=1024)
def _is_package(folder: Path) -> bool:
    return manifest_in(folder) is not None and any(is_file(folder / name) for name in _BUILD_FILES)


@lru_cache(maxsize=256)
def _name_of(folder: Path) -> str:
    manifest = manifest_in(folder)
    if manifest is None or manifest.name != "package.xml":
        return folder.name
    try:
        return quick_name(read_limited(manifest, MANIFEST_BYTES)) or folder.name
    except OSError:
        return folder.name


@lru_cache(maxsize=256)
def _made(folder: Path, name: str) -> Mapping[str, str]:
    try:
        lists = read_cmake_lists(folder, name) if is_folder(folder) else None
    except OSError:
        return {}
    return {} if lists is None else lists.made


@lru_cache(maxsize=256)
def _rules(folder: Path, name: str) -> tuple[InstallRule, ...]:
    if not is_folder(folder):
        return ()
    try:
        lists, setup = read_cmake_lists(folder, name), read_setup(folder)
    except OSError:
        return ()
    by_cmake = () if lists is None else cmake_rules(lists, f"share/{name}").rules
    by_setup = () if setup is None else tuple(setup.rules)
    build_type = _build_type(folder)
    if build_type == "ament_python":
        found = by_cmake if setup is None else by_setup
    elif build_type:
        found = by_setup if lists is None else by_cmake
    elif setup is not None and (not by_cmake or setup.is_for_ament):
        found = (*by_cmake, *by_setup)
    else:
        found = by_cmake
    made = {} if lists is None else lists.made
    return tuple(
        rule for rule in found if "$<" not in rule.source and (rule.is_known or rule.texts(made))
    )


def _build_type(folder: Path) -> str:
    """Return the type that alone says which of the two build files counts, as for colcon.

    Empty where none is known, and for a package of ROS 1 and ROS 2 at once, both of whose files
    count, each for its own.
    """
    file = manifest_in(folder)
    try:
        manifest = None if file is None else read_manifest(file)
    except ManifestError:
        return ""
    if manifest is None:
        return ""
    types = [item for item in manifest.exports if item.name == "build_type"]
    tools = {item.name for item in manifest.dependencies if item.kind == "buildtool_depend"}
    both = "catkin" in tools and any(one.startswith("ament") for one in tools)
    if len(types) > 1 or any(item.get("condition") for item in types) or (both and not types):
        return ""
    return manifest.build_type
