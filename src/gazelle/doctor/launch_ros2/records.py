"""What was read of a launch file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.diagnostics import SourceSpan
from gazelle.doctor.report import Section

__all__ = ["LaunchReading", "RobotSource"]


@dataclass(frozen=True, slots=True)
class RobotSource:
    """A robot description that a launch file reads or expands.

    Attributes:
        path: URDF, xacro or SDF file.
        mappings: values given to xacro, those only that are known without running anything.
        span: where the launch file names it.
    """

    path: Path
    mappings: Mapping[str, str] = field(default_factory=dict)
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class LaunchReading:
    """The files a launch names, for further checks, and the tables of the report.

    Attributes:
        robots: descriptions, each once.
        worlds: world files that a simulator is started with.
        parameter_files: YAML files that nodes get.
        launch_files: the file itself and every file it includes, of both generations.
        sections: table ``nodes``.
    """

    robots: tuple[RobotSource, ...] = ()
    worlds: tuple[Path, ...] = ()
    parameter_files: tuple[Path, ...] = ()
    launch_files: tuple[Path, ...] = ()
    sections: tuple[Section, ...] = ()
