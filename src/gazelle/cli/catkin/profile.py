"""The workspace of catkin tools: where it is, and what was configured in it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from gazelle.documents import read_limited
from gazelle.documents.yaml import YamlError, dump_yaml, load_yaml
from gazelle.workspace.building.catkin_space import CatkinSpaces
from gazelle.workspace.building.packages import BuildError

__all__ = ["Profile", "load_profile", "make_workspace", "save_profile"]

_MARKER = ".catkin_tools"
_CONFIG = "profiles/default/config.yaml"
_MAX_BYTES = 1 << 20
_SPACES = {"source_space": "src", "build_space": "build", "devel_space": "devel",
           "install_space": "install"}  # fmt: skip


class Profile(NamedTuple):
    """A workspace and its configuration.

    Attributes:
        root: the workspace.
        values: what ``catkin config`` stored, with its keys.
    """

    root: Path
    values: Mapping[str, Any]

    @property
    def installs(self) -> bool:
        """``catkin config --install``."""
        return self.values.get("install") is True

    @property
    def spaces(self) -> CatkinSpaces:
        """The folders of the workspace."""
        names = (str(self.values.get(key) or default) for key, default in _SPACES.items())
        return CatkinSpaces(*(self.root / name for name in names))


def load_profile(folder: Path, *, may_make: bool = False) -> Profile:
    """Return the workspace that a folder is in.

    Args:
        folder: in the workspace, or its top.
        may_make: make one of the folder when it has a ``src``, as ``catkin build`` does.

    Raises:
        BuildError: there is none, or its configuration cannot be read.
    """
    here = folder.resolve()
    root = next((item for item in (here, *here.parents) if (item / _MARKER).is_dir()), None)
    if root is None and may_make and (here / "src").is_dir():
        make_workspace(here)
        root = here
    if root is None:
        raise BuildError(
            f"No catkin workspace found that contains '{here}'; run 'catkin init' in its top folder"
        )
    file = root / _MARKER / _CONFIG
    try:
        values = load_yaml(read_limited(file, _MAX_BYTES)) if file.is_file() else {}
    except (OSError, ValueError, YamlError) as error:
        raise BuildError(f"cannot read '{file}': {error}; remove it to start anew") from error
    return Profile(root, values if isinstance(values, dict) else {})


def make_workspace(root: Path) -> bool:
    """Make a folder a workspace; False when it is one already."""
    marker = root / _MARKER
    if marker.is_dir():
        return False
    (marker / "profiles/default").mkdir(parents=True)
    (marker / "CATKIN_IGNORE").touch()
    return True


def save_profile(profile: Profile) -> None:
    """Store the configuration."""
    file = profile.root / _MARKER / _CONFIG
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(dump_yaml(dict(profile.values)), encoding="utf-8")
