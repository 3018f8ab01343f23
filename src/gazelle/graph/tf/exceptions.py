"""Why a transform cannot be had, in tf2's texts, and whose job it would be (REP 105)."""

from __future__ import annotations

from gazelle.errors import GraphError

__all__ = [
    "ConnectivityError",
    "ExtrapolationError",
    "InvalidFrameError",
    "TransformError",
    "UnknownFrameError",
    "gap_text",
]

_BASES = frozenset({"base_footprint", "base_link", "base"})
_MAPS = frozenset({"map", "earth", "world"})
_LOCALISERS = "localisation or SLAM (amcl, gmapping, slam_toolbox)"
_DRIVES = (
    "the drive (plug-in: <publishOdomTF>, publish_odom_tf; diff_drive_controller: enable_odom_tf) "
    "or robot_localization"
)
_JOINTS = (
    "robot_state_publisher, which wants every joint in /joint_states, or a "
    "static_transform_publisher"
)


def gap_text(first: str, second: str) -> str:
    """Return a sentence about the transform that would join two trees.

    Args:
        first: root of one tree.
        second: root of the other.
    """
    parent, child = _ordered(first, second)
    return (
        f"nobody publishes a transform from the tree of '{parent}' to '{child}'; that is the job "
        f"of {_owner(parent, child)}"
    )


class TransformError(GraphError):
    """A transform cannot be had."""


class UnknownFrameError(TransformError):
    """A frame does not exist, or the frames form a loop (tf2: ``LookupException``)."""


class ConnectivityError(TransformError):
    """The frames are in two trees."""


class ExtrapolationError(TransformError):
    """The time asked for is outside what is known.

    Attributes:
        is_past: it lies before everything that is known, so waiting does not help.
    """

    def __init__(self, text: str, *, is_past: bool = False) -> None:
        """Say why."""
        super().__init__(text)
        self.is_past = is_past


class InvalidFrameError(TransformError):
    """A frame's name cannot be one."""


def _ordered(first: str, second: str) -> tuple[str, str]:
    """Return the frame that is above by REP 105 first: map, odom, base_link."""
    return (first, second) if _rank(first) <= _rank(second) else (second, first)


def _rank(frame: str) -> int:
    bare = frame.rpartition("/")[2]
    if bare in _MAPS:
        return 0
    if bare == "odom":
        return 1
    return 2 if bare in _BASES else 3


def _owner(parent: str, child: str) -> str:
    above, below = _rank(parent), _rank(child)
    if above == 0 and below == 1:
        return _LOCALISERS
    if above == 1 and below in {2, 3}:
        return _DRIVES
    return _JOINTS
