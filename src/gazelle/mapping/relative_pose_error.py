"""How good a trajectory is, by relations between pairs of poses.

R. Kümmerle, B. Steder, C. Dornhege, M. Ruhnke, G. Grisetti, C. Stachniss, A. Kleiner: "On measuring
the accuracy of SLAM algorithms", Autonomous Robots 27, 2009. People measured where the robot was at
one time as seen from where it was at another; the error of a trajectory is how its own relative
poses differ from those. It does not depend on the frame, nor does one error early on count ever
after.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.mapping.se2 import Poses, between, transform_points

__all__ = [
    "RelationErrors",
    "Relations",
    "absolute_error_m",
    "align",
    "alignment",
    "read_relations",
    "relation_errors",
]

_COLUMNS = 8
_YAW = 7


class Relations(NamedTuple):
    """Relative poses that are known.

    Attributes:
        first_s: times of the first poses, (m,).
        second_s: times of the second ones, (m,).
        relative: the second pose in the frame of the first, (m, 3).
    """

    first_s: NDArray[np.float64]
    second_s: NDArray[np.float64]
    relative: Poses


@dataclass(frozen=True, slots=True)
class RelationErrors:
    """What a trajectory's relative poses are off by.

    Attributes:
        translation_m: (m,).
        rotation_rad: (m,).
    """

    translation_m: NDArray[np.float64]
    rotation_rad: NDArray[np.float64]

    def __str__(self) -> str:
        shift, turn = self.translation_m, np.degrees(self.rotation_rad)
        return (
            f"{len(shift)} relations: translation {shift.mean():.3f} ± {shift.std():.3f} m, "
            f"median {np.median(shift):.3f} m; rotation {turn.mean():.2f} ± {turn.std():.2f}°, "
            f"median {np.median(turn):.2f}°"
        )


def read_relations(path: Path, diagnostics: Diagnostics) -> Relations:
    """Read a file of relations: time, time, x, y, z, roll, pitch, yaw in every line.

    Lines that are none are reported and left out; ``#`` begins a comment.
    """
    rows = []
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        fields = line.partition("#")[0].split()
        if fields:
            row = _numbers(fields)
            if row is None:
                _report(diagnostics, SourceSpan(str(path), number), line)
            else:
                rows.append(row)
    table = np.array(rows).reshape(-1, _COLUMNS)
    return Relations(table[:, 0], table[:, 1], table[:, [2, 3, _YAW]])


def _numbers(fields: list[str]) -> list[float] | None:
    try:
        row = [float(word) for word in fields]
    except ValueError:
        return None
    return row if len(row) == _COLUMNS and bool(np.isfinite(row).all()) else None


def _report(diagnostics: Diagnostics, span: SourceSpan, line: str) -> None:
    diagnostics.report(
        "mapping.bad-line",
        f"'{line[:80]}' is no relation: eight numbers are expected, time, time, x, y, z, roll, "
        "pitch, yaw; the line is left out",
        span,
    )


def relation_errors(
    trajectory: Poses, first: ArrayLike, second: ArrayLike, relative: ArrayLike
) -> RelationErrors:
    """Return how far relative poses of a trajectory are from known ones.

    Args:
        trajectory: poses, (n, 3).
        first: indices of the first poses, (m,).
        second: indices of the second poses, (m,).
        relative: the second as seen from the first, (m, 3).
    """
    own = between(trajectory[np.asarray(first)], trajectory[np.asarray(second)])
    error = between(np.asarray(relative, dtype=float), own)
    return RelationErrors(np.hypot(error[:, 0], error[:, 1]), np.abs(error[:, 2]))


def align(
    relations: Relations, stamps_s: ArrayLike, tolerance_s: float = 0.05
) -> tuple[NDArray[np.int64], NDArray[np.int64], Poses]:
    """Return the indices of two poses and the relation, for relations whose times are both known.

    Args:
        relations: as read.
        stamps_s: times of the poses, ascending, (n,).
        tolerance_s: times that differ more are not the same.
    """
    stamps = np.asarray(stamps_s, dtype=float)
    (i, near_i), (j, near_j) = (
        _nearest(stamps, times, tolerance_s) for times in (relations.first_s, relations.second_s)
    )
    keep = near_i & near_j
    return i[keep], j[keep], relations.relative[keep]


def _nearest(
    stamps: NDArray[np.float64], times: NDArray[np.float64], tolerance_s: float
) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
    if not len(stamps):
        return np.zeros(len(times), np.int64), np.zeros(len(times), bool)
    after = np.clip(np.searchsorted(stamps, times), 1, max(1, len(stamps) - 1))
    after = np.minimum(after, len(stamps) - 1)
    before = np.maximum(after - 1, 0)
    closer = np.abs(stamps[before] - times) <= np.abs(stamps[after] - times)
    index = np.where(closer, before, after)
    return index, np.abs(stamps[index] - times) <= tolerance_s


def absolute_error_m(trajectory: Poses, truth: Poses) -> float:
    """Return the root mean square distance after the best rigid alignment, metres.

    Both are poses (n, 3): x, y (m) and yaw (rad), each in a frame of its own.
    """
    moved = transform_points(alignment(trajectory, truth), trajectory[:, :2])
    return float(np.sqrt(((moved - truth[:, :2]) ** 2).sum(axis=1).mean()))


def alignment(trajectory: Poses, truth: Poses) -> Poses:
    """Return the pose of one trajectory's frame in another's that brings them closest (Horn 1987).

    Args:
        trajectory: (n, 3).
        truth: the same poses in another frame, (n, 3).
    """
    middle_a, middle_b = trajectory[:, :2].mean(axis=0), truth[:, :2].mean(axis=0)
    a, b = trajectory[:, :2] - middle_a, truth[:, :2] - middle_b
    turn = np.arctan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum())
    x, y = middle_b - transform_points(np.array([0.0, 0.0, turn]), middle_a[None])[0]
    return np.array([x, y, turn])
