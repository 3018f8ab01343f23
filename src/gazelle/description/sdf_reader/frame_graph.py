"""Named frames: what a pose is relative to and what a frame is attached to.

SDF keeps two graphs per model or world (sdformat's "frame semantics", SDF 1.7): `relative_to`
gives every frame its place, `attached_to` the link it moves with. Both must be trees.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gazelle.description.read_context import ReadContext
from gazelle.diagnostics import Severity, SourceSpan, did_you_mean
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["MODEL_FRAME", "WORLD_FRAME", "FrameGraph", "FramePoint"]

MODEL_FRAME = "__model__"
WORLD_FRAME = "world"


@dataclass(frozen=True, slots=True)
class FramePoint:
    """One named frame as written.

    Attributes:
        what: the kind of thing it belongs to, for messages: ``link``, ``joint`` …
        name: its name in this scope.
        relative_to: name of the frame that `pose` starts from, empty for the scope's own.
        pose: pose in `relative_to`.
        attached_to: name it moves with; its own name for links, empty for the scope's default.
        span: where it stands.
    """

    what: str
    name: str
    relative_to: str
    pose: Pose
    attached_to: str
    span: SourceSpan


class FrameGraph:
    """The frames of one model or world, placed in that scope's own frame.

    Args:
        points: every frame by name; nested ones as ``nested::name``.
        context: hears of unknown names and circles.
        scope: the scope, for messages, such as ``model 'arm'``.
        root: name of the scope's own frame.
        default_attached: what the scope's own frame moves with.
    """

    def __init__(
        self,
        points: Mapping[str, FramePoint],
        context: ReadContext,
        *,
        scope: str,
        root: str = MODEL_FRAME,
        default_attached: str = "",
    ) -> None:
        self._points = points
        self._diagnostics = context.diagnostics
        # Up to SDF 1.6 Gazebo read the word and did nothing with it.
        old = context.version < (1, 7)
        self._unknown_severity = Severity.WARNING if old else Severity.ERROR
        self._scope = scope
        self._root = root
        self._default_attached = default_attached
        self._poses: dict[str, Pose] = {}

    def __contains__(self, name: str) -> bool:
        return name == self._root or name in self._points

    @property
    def names(self) -> tuple[str, ...]:
        """Every name that a pose may be relative to."""
        return (self._root, *self._points)

    def pose(self, name: str) -> Pose:
        """Return a frame's pose in the scope's own frame; identity for the scope's own."""
        if name in ("", self._root):
            return IDENTITY_POSE
        if name not in self._poses:
            self._place(name)
        return self._poses[name]

    def placed(self, pose: Pose, relative_to: str, *, default: str, user: FramePoint) -> Pose:
        """Return the pose of a link's child in the scope's own frame.

        Gazebo resolves these poses late and goes on with the default when there is no such frame.

        Args:
            pose: as written, in `relative_to`.
            relative_to: the frame's name; `default` when empty or (reported) unknown.
            default: the link's name.
            user: the child, for the message.
        """
        known = self._known(relative_to, default, user, severity=Severity.WARNING)
        return self.pose(known) @ pose

    def known_frame(self, name: str, default: str, *, user: FramePoint, word: str) -> str:
        """Return `name`, or `default` after reporting that there is no such frame."""
        return self._known(name, default, user, word)

    def attached_link(self, name: str) -> str:
        """Return the link a frame moves with; empty (reported) when there is none."""
        seen: list[str] = []
        current = name
        while True:
            if current in ("", self._root):
                return self._default_attached
            point = self._points.get(current)
            if point is None:
                return ""
            if point.attached_to == current:
                return current
            if current in seen:
                self._report_circle([*seen, current], point, "attached_to")
                return self._default_attached
            seen.append(current)
            if point.attached_to and point.attached_to not in self:
                self._report_unknown(point.attached_to, point, "attached_to")
                return self._default_attached
            current = point.attached_to

    def _place(self, name: str) -> None:
        """Place a frame and all it depends on, iteratively so that long chains are no problem."""
        chain: list[str] = []
        current = name
        while current not in self._poses and current != self._root:
            if current in chain:
                point = self._points[chain[-1]]
                self._report_circle([*chain[chain.index(current) :], current], point, "relative_to")
                break
            chain.append(current)
            point = self._points[current]
            current = self._known(point.relative_to, self._root, point)
        # Where a circle closes the last frame counts from the scope's own.
        pose = self._poses.get(current, IDENTITY_POSE)
        for item in reversed(chain):
            pose = pose @ self._points[item].pose
            self._poses[item] = pose

    def _known(
        self,
        name: str,
        default: str,
        user: FramePoint,
        word: str = "relative_to",
        *,
        severity: Severity | None = None,
    ) -> str:
        if not name:
            return default
        if name in self:
            return name
        self._report_unknown(name, user, word, severity)
        return default

    def _report_unknown(
        self, name: str, user: FramePoint, word: str, severity: Severity | None = None
    ) -> None:
        message = (
            f"{word}='{name}' of {user.what} '{user.name}' is no link, joint, frame or nested "
            f"model of {self._scope}; the default frame is used"
        )
        fix = did_you_mean(name, self.names) or "write one of: " + ", ".join(self.names[:12])
        self._diagnostics.report(
            "sdf.unknown-frame",
            message,
            user.span,
            fix=fix,
            severity=severity or self._unknown_severity,
        )

    def _report_circle(self, names: list[str], point: FramePoint, word: str) -> None:
        message = f"{word} goes in a circle in {self._scope}: " + " → ".join(names)
        self._diagnostics.report("sdf.frame-cycle", message, point.span)
