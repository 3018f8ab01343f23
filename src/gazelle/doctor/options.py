"""What the caller of an examination may choose."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field

__all__ = ["Options"]


@dataclass(frozen=True, slots=True)
class Options:
    """Choices of one examination.

    Attributes:
        arguments: ``name:=value`` words: arguments of a launch file or of a xacro file.
        probe: let short simulations run as well.
        world: world that a robot on its own is put into for the dry start and the probes.
        environ: environment that launch files and the search for a ROS see.
    """

    arguments: Mapping[str, str] = field(default_factory=dict)
    probe: bool = False
    world: str = "empty"
    environ: Mapping[str, str] = field(default_factory=lambda: dict(os.environ))
