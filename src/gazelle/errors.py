"""The one tree of errors that Gazelle raises on purpose.

Problems in a user's files travel as `gazelle.diagnostics.Diagnostic` values; `UserFileError`
carries all of them at once. Everything else raised here is a mistake in a call or in the
environment, and says what to do about it in its message. Errors that one subpackage raises are
defined there:

    GazelleError
        BagError
        BodyError
        BuildError
        CalibrationError
        CodedError
            MoveGroupError
            PlanningError
        ComponentError
        ControllerError
        CppBuildError
        EmbreeError
        EngineError
            SimulationDivergedError
        ExtensionError
        FilmError
        GraphError
            FrameError
            GoalStateError
            IllegalNameError
            NoGraphError
            PortTakenError
            RemoteError
                RemoteRefusedError
            ServiceCallError
            ServiceRefusedError
            ServiceTimeoutError
            ServiceUnavailableError
            TimeJumpError
            TransformError
                ConnectivityError
                ExtrapolationError
                InvalidFrameError
                UnknownFrameError
        GzError
        InputRefusedError
        InterfaceError
        LaunchError
            InvalidNamespaceError
            InvalidNodeNameError
        LimitError
            ExpansionLimitError
        MapWriteError
        MassError
        MeshError
        NoToolchainError
        NoWorldError
        NotFoundError
        ReconfigureError
        RosArgumentError
        SavedGraphError
        ScaffoldError
        ScriptError
        SetupAssistantError
        SpawnUsageError
        StudioError
        ToolError
            FieldError
        TreeError
        UnknownVerbError
        UserFileError
"""

from __future__ import annotations

import errno
import os
from collections.abc import Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gazelle.diagnostics.diagnostic import Diagnostic

__all__ = [
    "EngineError",
    "GazelleError",
    "GraphError",
    "InterfaceError",
    "LaunchError",
    "NotFoundError",
    "SimulationDivergedError",
    "UserFileError",
    "file_refusal_text",
]

_NO_ROOM = {getattr(errno, name, 0) for name in ("EDQUOT", "EFBIG", "ENOSPC")}
_NO_RIGHT = {errno.EACCES, errno.EPERM}
_SHOWN = 60
_MAX_BYTES = 255


class GazelleError(Exception):
    """Base of every error that Gazelle raises on purpose."""


class UserFileError(GazelleError):
    """One or more errors in the user's files, all of them at once.

    Attributes:
        diagnostics: every diagnostic collected, warnings included, in the order found.
    """

    def __init__(self, diagnostics: Sequence[Diagnostic]) -> None:
        self.diagnostics = tuple(diagnostics)
        super().__init__("\n".join(str(item) for item in self.diagnostics))


class NotFoundError(GazelleError):
    """A name that was asked for does not exist.

    Attributes:
        kind: what was looked for, such as ``"package"`` or ``"joint"``.
        name: the name asked for.
        searched: the places looked at.
        nearest: existing names most like it, best first.
    """

    def __init__(
        self,
        kind: str,
        name: str,
        *,
        searched: Sequence[str] = (),
        nearest: Sequence[str] = (),
        hint: str = "",
    ) -> None:
        self.kind = kind
        self.name = name
        self.searched = tuple(searched)
        self.nearest = tuple(nearest)
        super().__init__(_not_found_text(kind, name, searched, nearest, hint))


class EngineError(GazelleError):
    """The physics engine cannot do what was asked."""


class SimulationDivergedError(EngineError):
    """The state became non-finite; the message names the link and its source line.

    Attributes:
        link: ``model::link`` that went wrong first.
    """

    def __init__(self, message: str, *, link: str) -> None:
        self.link = link
        super().__init__(message)


class InterfaceError(GazelleError):
    """A message, service or action definition or value is not usable."""


class GraphError(GazelleError):
    """A topic, service, parameter or transport operation failed."""


class LaunchError(GazelleError):
    """A launch cannot start or go on."""


def file_refusal_text(error: OSError) -> str:
    """Return what to tell of a file system that refuses, with a fix; empty for other errors."""
    if error.errno in _NO_ROOM:
        fix = "make some room there, or name another place"
    elif error.errno == errno.EROFS and error.filename is not None:
        fix = "name a place that you may write to (ls -ld shows whose one is)"
    elif error.errno in _NO_RIGHT and error.filename is not None:
        fix = "give yourself the right to it (ls -ld shows whose it is), or name another place"
    elif error.errno == errno.ENAMETOOLONG and error.filename is not None:
        whole = os.fsdecode(error.filename)
        part = max(PurePath(whole).parts, key=len)
        name = part if len(os.fsencode(part)) > _MAX_BYTES else whole
        return f"{name[:_SHOWN]}…: {error.strerror}\n  fix: shorten it from {len(name)} characters"
    else:
        return ""
    place = f"{error.filename}: " if error.filename is not None else ""
    return (
        f"{place}{error.strerror}\n  fix: {fix}; "
        "logs go below ROS_LOG_DIR or ROS_HOME, what is kept for next time below XDG_CACHE_HOME"
    )


def _not_found_text(
    kind: str, name: str, searched: Sequence[str], nearest: Sequence[str], hint: str
) -> str:
    text = f"{kind} '{name}' not found"
    if nearest:
        text += "; did you mean " + " or ".join(f"'{item}'" for item in nearest) + "?"
    if searched:
        text += "\n  looked in:\n" + "\n".join(f"    {place}" for place in searched)
    if hint:
        text += f"\n  {hint}"
    return text
