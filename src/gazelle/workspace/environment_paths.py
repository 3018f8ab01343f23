"""Where to look for packages, models and worlds: environment, current folder, built-ins."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from gazelle.workspace.package_discovery import (
    FoundPackage,
    crawl_prefix,
    crawl_source,
    manifest_in,
)

__all__ = [
    "BUILTIN",
    "PackageSource",
    "ResourceFolders",
    "builtin_package_names",
    "demo_folder",
    "demo_sources",
    "package_sources",
    "resource_folders",
]

BUILTIN = Path(__file__).parent / "builtin"
_INSTALLED_DEMOS = Path(__file__).parents[1] / "demo" / "workspaces"
_DEMOS_IN_SOURCES = Path(__file__).parents[3] / "examples"
_PREFIX_VARIABLES = ("AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "COLCON_PREFIX_PATH")
_MODEL_VARIABLES = (
    "GAZEBO_MODEL_PATH",
    "GZ_SIM_RESOURCE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH",
    "SDF_PATH",
)
_RESOURCE_VARIABLES = (
    "GAZEBO_RESOURCE_PATH",
    "GZ_SIM_RESOURCE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH",
)
_WORKSPACE_MARKERS = frozenset({".catkin_workspace", ".catkin_tools", "devel", "install", "build"})


@dataclass(frozen=True, slots=True)
class PackageSource:
    """A place where packages may be.

    Attributes:
        label: how messages name it, such as ``ROS_PACKAGE_PATH: /home/me/ws/src``.
        crawl: yields the packages there; called at most once.
        is_builtin: True for Gazelle's own packages.
    """

    label: str
    crawl: Callable[[], Iterable[FoundPackage]]
    is_builtin: bool = False


@dataclass(frozen=True, slots=True)
class ResourceFolders:
    """Folders of models and of other resources, in order of search.

    Attributes:
        models: each holds one folder per model.
        fuel: roots of Fuel caches (``<server>/<owner>/models/<name>/<version>``).
        resources: what ``worlds/x.world`` and ``file://media/…`` are relative to.
    """

    models: tuple[Path, ...]
    fuel: tuple[Path, ...]
    resources: tuple[Path, ...]


def package_sources(
    environ: Mapping[str, str], cwd: Path, extra: Iterable[Path]
) -> tuple[PackageSource, ...]:
    """Return the places to look for packages, first match wins.

    Order: `extra`, ``ROS_PACKAGE_PATH``, ``AMENT_PREFIX_PATH``, ``CMAKE_PREFIX_PATH``,
    ``COLCON_PREFIX_PATH``, the workspace around the current folder, Gazelle's own packages.
    """
    sources = [_tree("given", root) for root in extra]
    sources += [_tree("ROS_PACKAGE_PATH", root) for root in _paths(environ, "ROS_PACKAGE_PATH")]
    seen: set[Path] = set()
    for variable in _PREFIX_VARIABLES:
        for prefix in _paths(environ, variable):
            if prefix not in seen:
                seen.add(prefix)
                sources.append(
                    PackageSource(f"{variable}: {prefix}", partial(crawl_prefix, prefix))
                )
    sources.extend(_around(cwd))
    sources.append(PackageSource("packages of Gazelle", _builtin_packages, True))
    return tuple(sources)


def resource_folders(environ: Mapping[str, str]) -> ResourceFolders:
    """Return the folders for models and resources that the environment names.

    ``~/.gazebo/models`` and the Fuel caches follow; Gazelle's own models and the folders that
    packages export are added by `Workspace`.
    """
    home = Path(environ.get("HOME") or environ.get("USERPROFILE") or os.path.expanduser("~"))  # noqa: PTH111
    models = [path for name in _MODEL_VARIABLES for path in _paths(environ, name)]
    models.append(home / ".gazebo" / "models")
    fuel = [_fuel_root(environ, home, name) for name in ("GZ", "IGN")]
    resources = [path for name in _RESOURCE_VARIABLES for path in _paths(environ, name)]
    return ResourceFolders(
        tuple(dict.fromkeys(models)), tuple(fuel), tuple(dict.fromkeys(resources))
    )


@cache
def demo_folder() -> Path:
    """Return the folder of the demos' workspaces: in the wheel, or in the tree it is made from."""
    return _INSTALLED_DEMOS if _INSTALLED_DEMOS.is_dir() else _DEMOS_IN_SOURCES


@cache
def demo_sources() -> tuple[PackageSource, ...]:
    """Return the demos' workspaces, where a name is looked up that is nowhere else.

    So what a demo prints to be typed works in every folder, and no package of anybody is hidden.
    """
    return tuple(
        PackageSource(f"demo: {folder}", cache(partial(_packages_below, folder)))
        for folder in sorted(demo_folder().glob("*_ws"))
    )


@cache
def builtin_package_names() -> frozenset[str]:
    """Return the names of Gazelle's own packages, which are those of their folders."""
    return frozenset(path.name for path in (BUILTIN / "packages").iterdir() if path.is_dir())


@cache
def _builtin_packages() -> tuple[FoundPackage, ...]:
    """Gazelle's own packages stay what they are while a process runs."""
    return tuple(crawl_source(BUILTIN / "packages"))


def _packages_below(folder: Path) -> tuple[FoundPackage, ...]:
    return tuple(crawl_source(folder))


def _fuel_root(environ: Mapping[str, str], home: Path, brand: str) -> Path:
    chosen = environ.get(f"{brand}_FUEL_CACHE_PATH")
    if chosen:
        return Path(chosen)
    return home / (".gz" if brand == "GZ" else ".ignition") / "fuel"


def _paths(environ: Mapping[str, str], variable: str) -> list[Path]:
    parts = environ.get(variable, "").split(os.pathsep)
    return [Path(part).absolute() for part in parts if part.strip()]


def _tree(label: str, root: Path) -> PackageSource:
    """A source tree, an install prefix, or the share folder of one."""

    def crawl() -> Iterator[FoundPackage]:
        if root.name == "share":
            # As in ROS_PACKAGE_PATH=/opt/ros/noetic/share: executables lie beside it, in lib.
            yield from crawl_prefix(root.parent)
        if (root / "share").is_dir() and manifest_in(root) is None:
            yield from crawl_prefix(root)
        yield from crawl_source(root)

    return PackageSource(f"{label}: {root}", crawl)


def _around(cwd: Path) -> Iterator[PackageSource]:
    """The workspace the current folder is in, or the package and its neighbours."""
    yielded = False
    for folder in (cwd, *cwd.parents):
        if manifest_in(folder) is not None:
            neighbours = partial(crawl_source, folder.parent, deepest=1)
            yield PackageSource(f"package around: {folder}", partial(crawl_source, folder))
            yield PackageSource(f"beside it: {folder.parent}", neighbours)
            yielded = True
        elif _is_workspace(folder, cwd):
            yield PackageSource(
                f"workspace: {folder / 'src'}", partial(crawl_source, folder / "src")
            )
            return
    if not yielded and cwd != Path(cwd.anchor):
        yield PackageSource(f"current folder: {cwd}", partial(crawl_source, cwd, deepest=2))


def _is_workspace(folder: Path, cwd: Path) -> bool:
    source = folder / "src"
    if folder == Path(folder.anchor) or not source.is_dir():
        return False
    if cwd in {folder, source} or source in cwd.parents:
        return True
    return any((folder / name).exists() for name in _WORKSPACE_MARKERS)
