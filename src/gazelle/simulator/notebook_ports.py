"""What a `Simulation` knows of the views and plots that the layers above make of it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from gazelle.simulator.run_history import Samples

__all__ = ["LiveWorldPort", "PlotPort", "ViewPort"]


class PlotPort(Protocol):
    """Curves over a run, see `Simulation.plot`."""

    @property
    def data(self) -> Mapping[str, Samples]:
        """Times (``times_s``) and values (``values``) of each curve, as arrays."""
        ...

    def save(self, path: str | Path) -> Path:
        """Write it to a file: ``.svg``, ``.png``, ``.pdf`` or ``.csv``."""
        ...


class ViewPort(Protocol):
    """A live view of a simulation, see `Simulation.view`."""

    @property
    def url(self) -> str:
        """The page's address, for a browser on this machine; whoever has it gets in."""
        ...

    @property
    def watchers(self) -> int:
        """How many pages look at the simulation."""
        ...

    def replay(self) -> str:
        """Return the run since the view was opened as one HTML document."""
        ...

    def close(self) -> None:
        """End the view; its cell keeps a replay of what it showed."""
        ...


class LiveWorldPort(Protocol):
    """What all views of a simulation share."""

    def run(self, steps: int, real_time_factor: float | None) -> None:
        """Take steps, while somebody looks not faster than so many times real time."""
        ...

    def close(self) -> None:
        """End it."""
        ...
