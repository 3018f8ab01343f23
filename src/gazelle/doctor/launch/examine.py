"""A launch file, expanded and checked."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gazelle.doctor.examination import Examination
from gazelle.launch.roslaunch import LaunchOptions, find_executables
from gazelle.launch.xml1.loader import load_launch_files

__all__ = ["examine_launch"]


def examine_launch(files: Sequence[Path], examination: Examination) -> None:
    """Expand launch files that are started together, and check what they would start."""
    config = load_launch_files(
        files,
        examination.options.arguments,
        workspace=examination.workspace,
        diagnostics=examination.diagnostics,
        environ=examination.options.environ,
    )
    for file in (*config.files, *config.text_files):
        examination.see(Path(file))
    find_executables(config, examination.workspace, examination.diagnostics, LaunchOptions())
