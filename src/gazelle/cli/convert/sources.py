"""What is converted: any description that Gazelle reads, and MuJoCo's files."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from gazelle.description.loader import load_world
from gazelle.description.model import World
from gazelle.description.writers import Beside
from gazelle.diagnostics import Diagnostics
from gazelle.errors import UserFileError
from gazelle.workspace import Workspace

__all__ = ["is_source_mjcf", "located", "read_source_world"]


def located(word: str, workspace: Workspace) -> Path | None:
    """Return the file or folder that a path, URI or model's name means; None for none."""
    path = Path(word)
    if path.exists():
        return path
    found = workspace.resolve(word).path or workspace.world_file(word).path
    return found if found is not None else workspace.model_dir(word)


def is_source_mjcf(path: Path | None) -> bool:
    """Tell whether a file is MuJoCo's."""
    if path is None or not path.is_file():
        return False
    # MuJoCo takes a tenth of a second to import, which other conversions need not wait for.
    if b"<mujoco" not in path.read_bytes():
        return False
    from gazelle.engine.mjcf import is_mjcf

    return is_mjcf(path)


def read_source_world(
    word: str,
    path: Path | None,
    workspace: Workspace,
    diagnostics: Diagnostics,
    mappings: Mapping[str, str],
    beside: Beside,
) -> World:
    """Read a source.

    Args:
        word: as it was given.
        path: where it is.
        workspace: finds packages, models and meshes.
        diagnostics: receives every finding.
        mappings: values of ``<xacro:arg>``.
        beside: takes meshes that only MuJoCo can read.

    Raises:
        UserFileError: there is nothing to convert; holds all findings.
    """
    if path is not None and is_source_mjcf(path):
        from gazelle.engine.mjcf import read_mjcf

        world = read_mjcf(path, diagnostics=diagnostics, beside=beside)
        if world is None:
            raise UserFileError(tuple(diagnostics))
        return world
    source = str(path) if path is not None else word
    return load_world(source, workspace=workspace, diagnostics=diagnostics, mappings=mappings)
