"""Writing a new package from templates."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable
from pathlib import Path
from typing import Literal

from gazelle.errors import GazelleError

__all__ = [
    "FILES",
    "KINDS",
    "PackageWriter",
    "ScaffoldError",
    "check_package_name",
    "create_package",
]


_ROBOT = {
    "urdf/inertia.xacro": "robot/inertia.xacro",
    "urdf/@name@.urdf.xacro": "robot/robot.urdf.xacro",
    "worlds/@name@.world": "world/world.sdf",
}

_WORLD = {"worlds/@name@.world": "world/world.sdf"}

_PYTHON = {
    "setup.cfg": "ros2/setup.cfg",
    "resource/@name@": "ros2/empty",
    "@name@/__init__.py": "ros2/empty",
}

FILES: dict[tuple[str, int], dict[str, str]] = {
    ("robot", 1): {
        "package.xml": "ros1/package_robot.xml",
        "CMakeLists.txt": "ros1/CMakeLists_robot.txt",
        "config/@name@.yaml": "ros1/robot.yaml",
        "launch/@name@.launch": "ros1/robot.launch",
        "scripts/wander.py": "ros1/wander.py",
        "urdf/gazebo.xacro": "ros1/gazebo.xacro",
        **_ROBOT,
    },
    ("robot", 2): {
        "package.xml": "ros2/package_robot.xml",
        "setup.py": "ros2/setup_robot.py",
        "config/@name@.yaml": "ros2/robot.yaml",
        "launch/@name@.launch.py": "ros2/robot.launch.py",
        "@name@/wander.py": "ros2/wander.py",
        "urdf/gazebo.xacro": "ros2/gazebo.xacro",
        **_PYTHON,
        **_ROBOT,
    },
    ("world", 1): {
        "package.xml": "ros1/package_world.xml",
        "CMakeLists.txt": "ros1/CMakeLists_world.txt",
        "launch/@name@.launch": "ros1/world.launch",
        **_WORLD,
    },
    ("world", 2): {
        "package.xml": "ros2/package_world.xml",
        "setup.py": "ros2/setup_world.py",
        "launch/@name@.launch.py": "ros2/world.launch.py",
        **_PYTHON,
        **_WORLD,
    },
    ("package", 1): {
        "package.xml": "ros1/package_package.xml",
        "CMakeLists.txt": "ros1/CMakeLists_package.txt",
        "config/@name@.yaml": "ros1/package.yaml",
        "launch/@name@.launch": "ros1/package.launch",
        "scripts/hello.py": "ros1/hello.py",
    },
    ("package", 2): {
        "package.xml": "ros2/package_package.xml",
        "setup.py": "ros2/setup_package.py",
        "config/@name@.yaml": "ros2/package.yaml",
        "launch/@name@.launch.py": "ros2/package.launch.py",
        "@name@/hello.py": "ros2/hello.py",
        **_PYTHON,
    },
}

"""Path in the package → template, by kind and generation of ROS; ``@name@`` is the package."""

KINDS = ("robot", "world", "package")

"""What can be created."""

_TEMPLATES = Path(__file__).parent / "templates"

_NAME = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")

_MAX_LISTED = 20


class ScaffoldError(GazelleError):
    """A package cannot be created: its name is not fit, or its place is taken."""


def create_package(
    kind: Literal["robot", "world", "package"],
    name: str,
    parent: Path,
    *,
    ros_version: Literal[1, 2] = 1,
) -> tuple[Path, ...]:
    """Write a package into a folder of its name, with manifest, build and launch files.

    ``robot`` has a differential drive with lidar, camera and IMU as xacro, a world and a node
    that drives it; ``world`` a world; ``package`` a node. Everything is written or nothing.

    Args:
        kind: one of `KINDS`.
        name: of the package and of what is in it.
        parent: where the package's folder is made; made itself when it is not there.
        ros_version: 1 writes catkin (manifest format 2), 2 ament_python (format 3).

    Returns:
        The files written, sorted.

    Raises:
        ScaffoldError: the name is not fit, or something is there already.
    """
    check_package_name(name)
    folder = parent / name
    _check_free(folder)
    texts = {
        folder / target.replace("@name@", name): _filled(template, name)
        for target, template in FILES[kind, ros_version].items()
    }
    for path, text in texts.items():
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8", newline="\n")
        except OSError as error:
            raise ScaffoldError(f"cannot write {path}: {error.strerror}") from error
        if text.startswith("#!"):
            path.chmod(0o755)
    return tuple(sorted(texts))


def check_package_name(name: str) -> None:
    """Accept what REP 144 does, as far as it is also the name of a Python module.

    Raises:
        ScaffoldError: says what is wrong and what would do.
    """
    if _NAME.fullmatch(name) and len(name) > 1 and not keyword.iskeyword(name):
        return
    fitting = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_").lstrip("0123456789_")
    fits = len(fitting) > 1 and not keyword.iskeyword(fitting)
    hint = f"; '{fitting}' would do" if fits else ""
    if keyword.iskeyword(name):
        raise ScaffoldError(f"'{name}' is a word of Python's, no name for a package")
    raise ScaffoldError(
        f"'{name}' is no name for a package: at least two lower-case letters, digits and single "
        f"underscores, a letter first (REP 144){hint}"
    )


def _check_free(folder: Path) -> None:
    if folder.is_file():
        raise ScaffoldError(f"{folder} is a file; nothing was written")
    there = sorted(folder.rglob("*")) if folder.is_dir() else []
    files = [str(path.relative_to(folder)) for path in there if path.is_file()]
    if files:
        listed = "\n".join(f"    {file}" for file in files[:_MAX_LISTED])
        rest = f"\n    … and {len(files) - _MAX_LISTED} more" if len(files) > _MAX_LISTED else ""
        raise ScaffoldError(f"{folder} is there already; nothing was written:\n{listed}{rest}")


def _filled(template: str, name: str) -> str:
    text = (_TEMPLATES / f"{template}.in").read_text(encoding="utf-8")
    return text.replace("@name@", name)


class PackageWriter:
    """Makes folders and files; tells each to `say`.

    Args:
        say: takes one line.
        folder_words: what a folder's line begins with.
        file_words: what a file's line begins with.
    """

    def __init__(self, say: Callable[[str], None], folder_words: str, file_words: str) -> None:
        self.say = say
        self._folder_words = folder_words
        self._file_words = file_words

    def folder(self, path: Path | str) -> Path:
        """Make a folder.

        Raises:
            ScaffoldError: that is not possible.
        """
        self.say(f"{self._folder_words} {path}")
        made = Path(path)
        try:
            made.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise ScaffoldError(f"unable to create folder: {path}: {error.strerror}") from error
        return made

    def file(self, path: Path | str, text: str) -> None:
        """Write a file.

        Raises:
            ScaffoldError: that is not possible.
        """
        self.say(f"{self._file_words} {path}")
        try:
            Path(path).write_text(text, encoding="utf-8", newline="\n")
        except OSError as error:
            raise ScaffoldError(f"cannot write {path}: {error.strerror}") from error
