"""What the kernels of matching are given, as records that they take whole."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["FieldCells", "LineTerms", "Lines", "Toward", "Window"]


class FieldCells(NamedTuple):
    """The cells of a likelihood field.

    Attributes:
        values: float32 (height, width) within [0, 1], row 0 lowest y.
        x_m, y_m: lower left corner.
        cell_m: side of a cell.
    """

    values: NDArray[np.float32]
    x_m: float
    y_m: float
    cell_m: float


class Lines(NamedTuple):
    """What lines walls are, from sums of the surfaces' points, see `line_kernels`.

    Attributes:
        places: int32 (height, width), which row of the sums is a cell's.
        sums: (n, 6).
        x_m, y_m: lower left corner.
        cell_m: side of a cell.
    """

    places: NDArray[np.int32]
    sums: NDArray[np.float64]
    x_m: float
    y_m: float
    cell_m: float


class Window(NamedTuple):
    """A lattice of poses around a guess.

    Attributes:
        reach_m: half side.
        step_m: between neighbours.
        reach_rad: half side of turns.
        step_rad: between neighbouring turns.
    """

    reach_m: float
    step_m: float
    reach_rad: float
    step_rad: float


class Toward(NamedTuple):
    """The pose that is expected, and what a departure from it costs.

    Attributes:
        x_m, y_m, yaw_rad: the pose.
        per_m2: costs of a place.
        per_rad2: costs of a turn.
    """

    x_m: float
    y_m: float
    yaw_rad: float
    per_m2: float
    per_rad2: float


class LineTerms(NamedTuple):
    """Which points lie on which lines.

    Attributes:
        sigma_m: standard deviation of a point's distance from its line.
        farthest_m: points farther from a line are not its own.
        fewest: so many points make a line.
        widest_m: what scatters more across, standard deviation, is no line.
    """

    sigma_m: float
    farthest_m: float
    fewest: float
    widest_m: float
