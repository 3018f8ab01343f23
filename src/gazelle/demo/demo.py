"""What a demo is: a launch, what belongs to the show, what is seen, what to try next."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

__all__ = ["Demo", "Panel", "Step"]


@dataclass(frozen=True, slots=True)
class Step:
    """Something to try while the demo runs.

    Attributes:
        what: one line of what it does.
        command: as it is typed in another terminal, whatever folder that is in.
    """

    what: str
    command: str


@dataclass(frozen=True, slots=True)
class Panel:
    """A panel of the page that shows the demo.

    Attributes:
        kind: by its command's name: ``gazebo``, ``rviz``, ``rqt_plot``.
        params: what it is opened with.
        file: of the demo's workspace, a ``.rviz`` file; empty when there is none.
    """

    kind: str
    params: Mapping[str, Any] = field(default_factory=dict)
    file: str = ""


@dataclass(frozen=True, slots=True)
class Demo:
    """A demo; its commands are words behind ``gazelle``.

    Attributes:
        name: what is typed: ``gazelle demo NAME``.
        title: a few words.
        summary: a sentence.
        ros_version: whose commands and packages it shows, 1 or 2.
        workspace: its folder's name.
        packages: names of the packages there.
        launch: the command that stays until the demo is over.
        sign: a topic that is published as soon as there is something to see.
        seen: lines that say what there is to see.
        try_next: what to try while it runs.
        programs: commands that belong to the show and wait for what they need.
        panels: what the page shows, the main panel first.
    """

    name: str
    title: str
    summary: str
    ros_version: int
    workspace: str
    packages: tuple[str, ...]
    launch: tuple[str, ...]
    sign: str
    seen: tuple[str, ...]
    try_next: tuple[Step, ...]
    programs: tuple[tuple[str, ...], ...] = ()
    panels: tuple[Panel, ...] = (Panel("gazebo"),)
