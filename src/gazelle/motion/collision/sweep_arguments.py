"""What the kernels of collision are given, as records that they take whole."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.motion.joint_space import BoolArray, FloatArray
from gazelle.motion.kinematics.chain import LinkTree

__all__ = [
    "PASSING",
    "Bodies",
    "Carried",
    "GroupVariables",
    "Motions",
    "PlacedSolids",
    "SweepArguments",
]

IntArray = NDArray[np.int64]

PASSING: np.dtype[Any] = np.dtype(
    [
        ("changed_m", np.float64),
        ("way_m", np.float64, 3),
        ("turns_rad", np.float64, (2, 3)),
        ("radii_m", np.float64, 2),
        ("centres_m", np.float64, (2, 3)),
        ("offsets_m", np.float64, (2, 3)),
    ]
)
"""How two links or things pass each other on a piece of a motion, all in the robot's frame.

By how much the change of speed brings them together, infinite where that is not known; the way of
one centre from the other; of each the turn, as a vector, how far points of the solid that is looked
at are from its centre at most, the centre, and from there the solid's centre.
"""


class PlacedSolids(NamedTuple):
    """Solids, and where they are.

    Attributes:
        rows: (s, 24), see `convex_rows.ConvexRows`.
        kinds: (s, 4) likewise.
        vertices_m: (3, v), of all hulls, each in its solid's frame.
        rotations: (f, 3, 3), of the frames in the robot's; those of links that move are written.
        positions_m: (f, 3) likewise.
    """

    rows: FloatArray
    kinds: IntArray
    vertices_m: FloatArray
    rotations: FloatArray
    positions_m: FloatArray


class Bodies(NamedTuple):
    """Links and things, and which of them must not touch.

    Attributes:
        members: (bodies, 3), of each the solid around all of it, its first solid, and their number.
        pairs: (pairs, 2), numbers of links or things that must not touch.
        apart: (pairs, j) whether a joint moves one of both, and not both.
        axes: (pairs, 4), directions in which pairs were apart last; written.
        order: (pairs,), those that met last first; written.
    """

    members: IntArray
    pairs: IntArray
    apart: BoolArray
    axes: FloatArray
    order: IntArray


class GroupVariables(NamedTuple):
    """Where a group's configuration goes among the positions of a robot.

    Attributes:
        positions: (v,), of the whole robot, rad or m; the group's part is written.
        indices: (n,), places of the group in it.
        followers: (m,), places of what mimics.
        leaders: (m,), places in the group of what is mimicked.
        rules: (m, 2), factor and offset of each.
    """

    positions: FloatArray
    indices: IntArray
    followers: IntArray
    leaders: IntArray
    rules: FloatArray


class Motions(NamedTuple):
    """Which joints move, and how far they carry links and things at most.

    Attributes:
        joints: (j,), number of the frame each moves with, -1 where it does not turn.
        lines: (j, 6), axis and a point of it in that frame.
        turns: (j, n) how far each turns for one rad of a variable.
        moves: (bodies, j, n) how far it carries a link or thing at most, m, for one rad or m.
        above: (bodies, j) whether it moves it.
    """

    joints: IntArray
    lines: FloatArray
    turns: FloatArray
    moves: FloatArray
    above: BoolArray


class Carried(NamedTuple):
    """How joints carry links and things on one way; all of it is written.

    Attributes:
        rates_rad: (j,) how far each turns on the whole way.
        bounds_m: (bodies, j, 2) how far each carries a link or thing on it at most, and how far
            the joints behind it carry the same.
        lines: (j, 6) its axis where it is now, and a point of it, m, in the robot's frame.
        carried_m: (bodies, j) how far it carries a link or thing from where that is now.
        centres_m: (bodies, 3) of boxes along the robot's axes around links and things.
        halves_m: (bodies, 3) half sizes of these boxes.
    """

    rates_rad: FloatArray
    bounds_m: FloatArray
    lines: FloatArray
    carried_m: FloatArray
    centres_m: FloatArray
    halves_m: FloatArray


class SweepArguments(NamedTuple):
    """All that `sweep_kernels.sweep` knows of a robot and its surroundings.

    Attributes:
        links: those that move.
        group: the variables.
        motions: the joints.
        bodies: links and things.
        solids: of them; the frames of the links that move come first.
        work: scratch of (10, 4).
        doubts: (d,), takes the parts of a way, 0 to 1, of states that are not decided.
    """

    links: LinkTree
    group: GroupVariables
    motions: Motions
    bodies: Bodies
    solids: PlacedSolids
    work: FloatArray
    doubts: FloatArray
