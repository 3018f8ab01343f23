"""Everything a robot description or launch file may refer to by name."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, cached_property
from pathlib import Path

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import NotFoundError
from gazelle.workspace import uri_resolver
from gazelle.workspace.environment_paths import (
    BUILTIN,
    PackageSource,
    ResourceFolders,
    demo_sources,
    package_sources,
    resource_folders,
)
from gazelle.workspace.file_lookup import Resolved, nearest_packages
from gazelle.workspace.gazebo_models import fuel_models, is_model_folder, models_in, newest_version
from gazelle.workspace.package import Package, package_from
from gazelle.workspace.package_discovery import FoundPackage
from gazelle.workspace.package_xml import Manifest, ManifestError, read_manifest

__all__ = ["Workspace"]

_NOT_HERE = (
    "the name is not that of a package in this workspace nor one that Gazelle brings along; put "
    "the package's folder into your workspace's src or name its place in ROS_PACKAGE_PATH"
)


class Workspace:
    """Packages, models and worlds by name; found on first use, then remembered.

    Attributes:
        diagnostics: what was wrong with the packages looked at so far.
    """

    def __init__(self, sources: Iterable[PackageSource], folders: ResourceFolders) -> None:
        self.diagnostics = Diagnostics()
        self._sources = tuple(sources)
        self._folders = folders
        self._packages = _Packages(self._sources, self.diagnostics)

    @classmethod
    def discover(
        cls,
        *,
        environ: Mapping[str, str] | None = None,
        cwd: str | os.PathLike[str] | None = None,
        extra: Iterable[str | os.PathLike[str]] = (),
    ) -> Workspace:
        """Look where ROS and Gazebo look; nothing is read before it is asked for.

        Args:
            environ: environment variables; the process's own when None.
            cwd: whose workspace counts besides the environment's; the current folder when None.
            extra: folders with packages (source trees or install prefixes), searched first.
        """
        variables = os.environ if environ is None else environ
        here = (Path.cwd() if cwd is None else Path(cwd)).absolute()
        roots = [Path(root).absolute() for root in extra]
        return cls(package_sources(variables, here, roots), resource_folders(variables))

    @property
    def packages(self) -> Mapping[str, Package]:
        """All packages by name, sorted; the first place found wins, as in ROS.

        A package of a demo is none of them before it is asked for by name and is nowhere else;
        then its workspace's packages are the user's.
        """
        return self._packages

    @property
    def user_packages(self) -> tuple[Package, ...]:
        """Those packages that do not come with Gazelle, whose many manifests stay unread."""
        return self._packages.of_users()

    def user_package(self, name: str) -> Package | None:
        """Return a package that does not come with Gazelle, None when there is none.

        What comes with Gazelle is not even listed for it, which takes longer than most searches.
        """
        return self._packages.of_user(name)

    def package(self, name: str) -> Package:
        """Return a package.

        Raises:
            NotFoundError: there is none of this name; says where it was looked for.
        """
        found = self._packages.get(name)
        if found is None:
            raise NotFoundError(
                "package",
                name,
                searched=self.package_places,
                nearest=nearest_packages(name, self._packages),
                hint=_NOT_HERE,
            )
        return found

    @property
    def package_places(self) -> tuple[str, ...]:
        """The places packages are looked for in, in words."""
        return tuple(source.label for source in self._sources)

    @cached_property
    def model_folders(self) -> tuple[Path, ...]:
        """Folders that hold one folder per model, in order of search.

        Environment (``GAZEBO_MODEL_PATH``, ``GZ_SIM_RESOURCE_PATH`` …), ``~/.gazebo/models``,
        what packages export as ``gazebo_ros`` ``gazebo_model_path`` (or ``gazebo_ros_paths``'
        ``model_path``), Gazelle's own.
        """
        exported = self._exported("gazebo_model_path", "model_path")
        return tuple(dict.fromkeys((*self._folders.models, *exported, BUILTIN / "models")))

    @cached_property
    def resource_folders(self) -> tuple[Path, ...]:
        """Folders that ``worlds/x.world`` and ``file://media/…`` may be relative to."""
        exported = self._exported("gazebo_media_path", "gazebo_resource_path")
        return tuple(dict.fromkeys((*self._folders.resources, *exported, BUILTIN)))

    @property
    def fuel_folders(self) -> tuple[Path, ...]:
        """Roots of the Fuel caches looked at; nothing is ever downloaded."""
        return self._folders.fuel

    @cached_property
    def models(self) -> Mapping[str, Path]:
        """All models by name: folder with ``model.config`` or ``model.sdf``; first one wins."""
        found: dict[str, Path] = {}
        for folder in self.model_folders:
            for name, path in models_in(folder):
                found.setdefault(name, path)
        for root in self._folders.fuel:
            for name, path in fuel_models(root):
                found.setdefault(name, path)
        return dict(sorted(found.items()))

    def model_dir(self, name: str) -> Path | None:
        """Return a model's folder by name, None when there is none."""
        for folder in self.model_folders:
            path = folder / name
            if is_model_folder(path):
                return newest_version(path)
        return self.models.get(name)

    def resolve(self, uri: str, *, base_dir: str | os.PathLike[str] | None = None) -> Resolved:
        """Find the file or folder a URI means; never raises, never goes to the network.

        Args:
            uri: ``package://``, ``model://``, ``file://``, ``$(find pkg)/…``, a Fuel ``https://``
                address that is in a local cache, an absolute or a relative path.
            base_dir: folder of the file that holds the URI, for relative paths.
        """
        return uri_resolver.resolve(self, uri, None if base_dir is None else Path(base_dir))

    def world_file(self, name: str, *, base_dir: str | os.PathLike[str] | None = None) -> Resolved:
        """Find a world file as Gazebo does: a path, or a name on the resource path.

        ``empty``, ``empty.world`` and ``worlds/empty.world`` mean the same.
        """
        return uri_resolver.resolve_world(self, name, None if base_dir is None else Path(base_dir))

    def _exported(self, *attributes: str) -> Iterator[Path]:
        for package in self.user_packages:
            for tag in ("gazebo_ros", "gazebo_ros_paths", "gazebo"):
                for attribute in attributes:
                    yield from package.exported_paths(tag, attribute)


class _Packages(Mapping[str, Package]):
    """Names are crawled source by source, manifests parsed one by one, both on demand."""

    def __init__(self, sources: tuple[PackageSource, ...], diagnostics: Diagnostics) -> None:
        self._waiting = list(sources)
        self._demos = list(demo_sources())
        self._diagnostics = diagnostics
        self._found: dict[str, tuple[FoundPackage, bool]] = {}
        self._parsed: dict[str, Package] = {}

    def __getitem__(self, name: str) -> Package:
        while name not in self._found and self._waiting:
            self._crawl_next()
        if name not in self._found:
            self._take_demo_with(name)
        if name not in self._parsed:
            found, is_builtin = self._found[name]
            if is_builtin and found.manifest is not None:
                manifest = _builtin_manifest(found.manifest)
            else:
                manifest = self._manifest(found)
            self._parsed[name] = package_from(found, manifest, is_builtin=is_builtin)
        return self._parsed[name]

    def __iter__(self) -> Iterator[str]:
        while self._waiting:
            self._crawl_next()
        return iter(sorted(self._found))

    def __len__(self) -> int:
        while self._waiting:
            self._crawl_next()
        return len(self._found)

    def of_users(self) -> tuple[Package, ...]:
        """Return the packages that are not built in, sorted by name."""
        return tuple(self[name] for name in self if not self._found[name][1])

    def of_user(self, name: str) -> Package | None:
        """Return a package that is not built in, None when there is none."""
        while name not in self._found and self._waiting and not self._waiting[0].is_builtin:
            self._crawl_next()
        return self[name] if name in self._found and not self._found[name][1] else None

    def _crawl_next(self) -> None:
        source = self._waiting.pop(0)
        own: dict[str, FoundPackage] = {}
        for found in source.crawl():
            first = own.setdefault(found.name, found)
            if first.path != found.path:
                self._report_twice(first, found)
            self._found.setdefault(found.name, (found, source.is_builtin))

    def _take_demo_with(self, name: str) -> None:
        for source in self._demos:
            packages = tuple(source.crawl())
            if any(found.name == name for found in packages):
                self._demos.remove(source)
                for found in packages:
                    self._found.setdefault(found.name, (found, False))
                return

    def _report_twice(self, first: FoundPackage, second: FoundPackage) -> None:
        self._diagnostics.report(
            "workspace.duplicate-package",
            f"package '{first.name}' is in '{first.path}' and in '{second.path}'; "
            "the first one is used",
            SourceSpan(str(second.manifest or second.path)),
        )

    def _manifest(self, found: FoundPackage) -> Manifest:
        if found.manifest is None:
            return Manifest(found.name)
        try:
            manifest = read_manifest(found.manifest)
        except ManifestError as error:
            self._diagnostics.report(
                "workspace.bad-manifest",
                f"cannot read the manifest of package '{found.name}': {error}; "
                "the package is used without its exports",
                SourceSpan(str(found.manifest), error.line, error.column),
            )
            return Manifest(found.name)
        if not manifest.name and manifest.format:
            self._diagnostics.report(
                "workspace.bad-manifest",
                f"the manifest has no <name>; the folder's name '{found.name}' is used",
                SourceSpan(str(found.manifest), 1),
            )
        return manifest


@cache
def _builtin_manifest(path: Path) -> Manifest:
    """Return the manifest of one of Gazelle's own packages, which no process sees change."""
    return read_manifest(path)
