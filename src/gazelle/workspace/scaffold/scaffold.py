"""Writing a new package from templates."""

from __future__ import annotations

import keyword
import re
from pathlib import Path
from typing import Literal

from gazelle.errors import GazelleError
from gazelle.workspace.scaffold.file_lists import FILES

__all__ = ["KINDS", "ScaffoldError", "check_package_name", "create_package"]

KINDS = ("robot", "world", "package")
"""What can be created."""

_TEMPLATES = Path(__file__).parent / "templates"
_NAME = re.compile(r"[a-z][a-z0-9]*(_[a-z0-9]+)*")
_MOST_LISTED = 20


class ScaffoldError(GazelleError):
    """A package cannot be created: its name is not fit, or its place is taken."""


def create_package(
    kind: Literal["robot", "world", "package"],
    name: str,
    parent: Path,
    *,
    generation: Literal[1, 2] = 1,
) -> tuple[Path, ...]:
    """Write a package into a folder of its name, with manifest, build and launch files.

    ``robot`` has a differential drive with lidar, camera and IMU as xacro, a world and a node
    that drives it; ``world`` a world; ``package`` a node. Everything is written or nothing.

    Args:
        kind: one of `KINDS`.
        name: of the package and of what is in it.
        parent: where the package's folder is made; made itself when it is not there.
        generation: 1 writes catkin (manifest format 2), 2 ament_python (format 3).

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
        for target, template in FILES[kind, generation].items()
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
        listed = "\n".join(f"    {file}" for file in files[:_MOST_LISTED])
        rest = f"\n    … and {len(files) - _MOST_LISTED} more" if len(files) > _MOST_LISTED else ""
        raise ScaffoldError(f"{folder} is there already; nothing was written:\n{listed}{rest}")


def _filled(template: str, name: str) -> str:
    text = (_TEMPLATES / f"{template}.in").read_text(encoding="utf-8")
    return text.replace("@name@", name)
