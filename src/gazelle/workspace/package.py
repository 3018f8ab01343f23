"""A ROS package on disk."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from gazelle.documents.files import exists
from gazelle.workspace.executables import executable_names, executables_named
from gazelle.workspace.package_discovery import FoundPackage
from gazelle.workspace.package_xml import Export, Manifest
from gazelle.workspace.share_folder import share_folder

__all__ = ["Package", "package_from"]


@dataclass(frozen=True, slots=True)
class Package:
    """A package: its manifest and where its files are.

    Attributes:
        name: package name.
        path: the folder `$(find …)` and `package://` mean: the source folder in a source tree
            (share folder and source folder are the same there), ``share/<name>`` in an install
            tree.
        version: as written in the manifest.
        format: manifest format 1–3, 0 for rosbuild.
        build_type: ``catkin``, ``ament_cmake``, ``ament_python``, ``rosbuild``, ``cmake``.
        depends: names of all dependencies, sorted.
        description: one line.
        exports: elements of ``<export>``.
        prefix: install prefix, None in source trees.
        is_builtin: True for the packages that come with Gazelle.
    """

    name: str
    path: Path
    version: str = ""
    format: int = 1
    build_type: str = ""
    depends: tuple[str, ...] = ()
    description: str = ""
    exports: tuple[Export, ...] = ()
    prefix: Path | None = None
    is_builtin: bool = False

    @property
    def ros_version(self) -> int | None:
        """1 for catkin and rosbuild packages, 2 for ament ones, None for others."""
        if self.build_type in {"catkin", "rosbuild"}:
            return 1
        return 2 if self.build_type.startswith("ament") else None

    @property
    def note_on_files(self) -> str:
        """What to say of a file that it has not: the original may, where this one stands in."""
        if not self.is_builtin:
            return ""
        return (
            f"this '{self.name}' is Gazelle's and stands in for the original; put the original's "
            "folder into your workspace's src for its other files"
        )

    @property
    def share(self) -> Path:
        """The folder that look-ups of the user's code get: files lie where installing puts them.

        `path` itself where that moves nothing.
        """
        if self.prefix is not None or self.is_builtin:
            return self.path
        return share_folder(self.path, self.name, has_devel_space=self.ros_version == 1)

    def find_file(self, relative: str) -> Path | None:
        """Return a file or folder of the package by its path inside, None when absent."""
        path = self.path / relative
        return path if exists(path) else None

    def find_executables(self, type_name: str) -> tuple[Path, ...]:
        """Return the files that ``rosrun <package> <type_name>`` could mean, best first.

        Source trees: ``scripts``, ``nodes``, ``bin``, ``src``, ``test``, the package's Python
        module, its root, then anywhere below; a ``console_scripts`` entry point of ``setup.py`` or
        ``setup.cfg`` gives the module's file. Install trees: ``lib/<package>``.
        """
        return executables_named(self.name, self.path, self.prefix, type_name)

    @property
    def executable_names(self) -> tuple[str, ...]:
        """The names ``rosrun`` offers for this package, sorted."""
        return executable_names(self.name, self.path, self.prefix)

    def exported_paths(self, tag: str, attribute: str) -> tuple[Path, ...]:
        """Return the folders an export names, ``${prefix}`` replaced, such as model paths.

        Args:
            tag: export tag, such as ``gazebo_ros``.
            attribute: its attribute, such as ``gazebo_model_path``; may hold several paths.
        """
        found = []
        for export in self.exports:
            value = export.get(attribute) if export.name == tag else None
            for part in (value or "").split(":"):
                if part.strip():
                    found.append(Path(part.strip().replace("${prefix}", str(self.share))))
        return tuple(found)


def package_from(found: FoundPackage, manifest: Manifest, *, is_builtin: bool) -> Package:
    """Build a package from what was seen on disk and its parsed manifest."""
    return Package(
        name=found.name,
        path=found.path,
        version=manifest.version,
        format=manifest.format,
        build_type=manifest.build_type,
        depends=manifest.depends,
        description=manifest.description,
        exports=manifest.exports,
        prefix=found.prefix,
        is_builtin=is_builtin,
    )
