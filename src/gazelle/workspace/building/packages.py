"""The packages of a workspace, in the order in which they have to be built."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.errors import GazelleError
from gazelle.workspace.package_discovery import FoundPackage, crawl_source
from gazelle.workspace.package_xml import Manifest, ManifestError, read_manifest

__all__ = [
    "BuildError",
    "Selection",
    "SourcePackage",
    "find_packages",
    "in_order",
    "needed_by",
    "select",
]


_BUILD = frozenset({"build_depend", "buildtool_depend", "depend"})

_RUN = frozenset(
    {"buildtool_export_depend", "build_export_depend", "depend", "exec_depend", "run_depend"}
)

_TEST = frozenset({"test_depend"})


class BuildError(GazelleError):
    """A workspace cannot be built at all; says why and what to do."""


@dataclass(frozen=True, slots=True)
class SourcePackage:
    """A package with its sources.

    Attributes:
        name: of the package.
        path: its folder, absolute.
        manifest: its ``package.xml``.
    """

    name: str
    path: Path
    manifest: Manifest

    @property
    def build_type(self) -> str:
        """``ament_cmake``, ``ament_python``, ``catkin``, ``cmake`` or another word."""
        return self.manifest.build_type

    def depends(self, role: str = "") -> frozenset[str]:
        """Return the names it needs for one role, for all of them when `role` is empty.

        Args:
            role: ``build``, ``run`` or ``test``; which tags count for which is colcon's rule.
        """
        kinds = {"build": _BUILD, "run": _RUN, "test": _TEST}.get(role, _BUILD | _RUN | _TEST)
        return frozenset(item.name for item in self.manifest.dependencies if item.kind in kinds)


def find_packages(folders: Iterable[Path], diagnostics: Diagnostics) -> tuple[SourcePackage, ...]:
    """Return the packages below these folders, sorted by name.

    Args:
        folders: where to look; hidden folders, build products and those with ``COLCON_IGNORE``,
            ``AMENT_IGNORE`` or ``CATKIN_IGNORE`` are left out.
        diagnostics: receives ``workspace.bad-manifest``; such a package is left out.

    Raises:
        BuildError: two packages have the same name, or there is no such folder.
    """
    found: dict[Path, FoundPackage] = {}
    for folder in folders:
        if not folder.is_dir():
            raise BuildError(f"the specified base path '{folder}' is not a folder")
        for item in crawl_source(folder.absolute()):
            found.setdefault(item.path.resolve(), item)
    read = [_read(item, diagnostics) for item in found.values()]
    packages = [item for item in read if item is not None]
    _refuse_twins(packages)
    return tuple(sorted(packages, key=lambda item: item.name))


def in_order(packages: Sequence[SourcePackage]) -> tuple[SourcePackage, ...]:
    """Return packages so that each follows what it needs, else by name.

    Raises:
        BuildError: packages need each other in a circle; the circle is named.
    """
    waiting = {item.name: item for item in packages}
    needs = {name: set(item.depends() & waiting.keys()) - {name} for name, item in waiting.items()}
    ordered: list[SourcePackage] = []
    while waiting:
        free = sorted(name for name in waiting if not needs[name] & waiting.keys())
        if not free:
            circle = " -> ".join(_circle(needs, set(waiting)))
            raise BuildError(
                f"Unable to order packages topologically: {circle}: each of these needs the next "
                "one; remove one of the dependencies from its package.xml"
            )
        ordered.append(waiting.pop(free[0]))
    return tuple(ordered)


def needed_by(names: Iterable[str], packages: Sequence[SourcePackage]) -> frozenset[str]:
    """Return these names and all packages of the workspace that they need, directly or not."""
    by_name = {item.name: item for item in packages}
    found: set[str] = set()
    waiting = [name for name in names if name in by_name]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.add(name)
            waiting += [item for item in by_name[name].depends() if item in by_name]
    return frozenset(found)


def _read(found: FoundPackage, diagnostics: Diagnostics) -> SourcePackage | None:
    if found.manifest is None or found.manifest.name != "package.xml":
        return None
    try:
        manifest = read_manifest(found.manifest)
    except ManifestError as error:
        text = f"cannot read the manifest of '{found.path.name}': {error}; it is not built"
        span = SourceSpan(str(found.manifest), error.line, error.column)
        diagnostics.report("workspace.bad-manifest", text, span)
        return None
    return SourcePackage(manifest.name or found.name, found.path, manifest)


def _refuse_twins(packages: Iterable[SourcePackage]) -> None:
    places: dict[str, list[str]] = {}
    for item in packages:
        places.setdefault(item.name, []).append(str(item.path))
    lines = []
    for name, paths in sorted(places.items()):
        if len(paths) > 1:
            lines += [f"- {name}:", *(f"  - {path}" for path in sorted(paths))]
    if lines:
        listed = "\n".join(["Duplicate package names not supported:", *lines])
        raise BuildError(f"{listed}\nput a file COLCON_IGNORE into the folder of all but one")


def _circle(needs: dict[str, set[str]], waiting: set[str]) -> list[str]:
    way = [min(waiting)]
    while way.count(way[-1]) == 1:
        way.append(min(needs[way[-1]] & waiting))
    return way[way.index(way[-1]) :]


@dataclass(frozen=True, slots=True)
class Selection:
    """The options of colcon that choose packages; empty ones choose nothing away.

    Attributes:
        only: ``--packages-select``.
        up_to: ``--packages-up-to``: these and what they need.
        above: ``--packages-above``: these and what needs them.
        skip: ``--packages-skip``.
        ignore: ``--packages-ignore``: as if they were not there.
    """

    only: tuple[str, ...] = ()
    up_to: tuple[str, ...] = ()
    above: tuple[str, ...] = ()
    skip: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()


def select(
    packages: Sequence[SourcePackage], selection: Selection
) -> tuple[tuple[SourcePackage, ...], tuple[str, ...]]:
    """Return the packages chosen, in the given order, and what to warn of.

    Args:
        packages: all of the workspace.
        selection: what the command line says.
    """
    here = [item for item in packages if item.name not in selection.ignore]
    names = {item.name for item in here}
    if selection.only:
        names &= set(selection.only)
    if selection.up_to:
        names &= needed_by(selection.up_to, here)
    if selection.above:
        wanted = set(selection.above)
        names &= {item.name for item in here if needed_by([item.name], here) & wanted}
    names -= set(selection.skip)
    return tuple(item for item in here if item.name in names), _unknown(packages, selection)


def _unknown(packages: Sequence[SourcePackage], selection: Selection) -> tuple[str, ...]:
    known = [item.name for item in packages]
    warnings = []
    for option, names in (
        ("--packages-select", selection.only),
        ("--packages-up-to", selection.up_to),
        ("--packages-above", selection.above),
        ("--packages-skip", selection.skip),
        ("--packages-ignore", selection.ignore),
    ):
        for name in names:
            if name not in known:
                hint = did_you_mean(name, known)
                text = f"ignoring unknown package '{name}' in {option}"
                warnings.append(f"{text}; {hint}" if hint else text)
    return tuple(warnings)
