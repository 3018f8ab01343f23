"""Methods of the panel Setup Assistant."""

from __future__ import annotations

from gazelle.errors import GazelleError
from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params
from gazelle.studio.routing import Method
from gazelle.studio.setup_assistant.edits import edited
from gazelle.studio.setup_assistant.sessions import AssistantSessions, with_pairs
from gazelle.studio.setup_assistant.values import (
    AssistantFile,
    AssistantStart,
    AssistantValue,
    AssistantWritten,
)

__all__ = ["METHODS"]

_MOST_TRIALS = 1_000_000


def start(sessions: AssistantSessions, _params: Params) -> AssistantStart:
    """``setup_assistant.start``: what there is to begin with."""
    return sessions.start()


def load(sessions: AssistantSessions, params: Params) -> AssistantValue:
    """``setup_assistant.load``: a robot's ``file``, or a config ``package``."""
    if "package" in params:
        return sessions.open(params.text("package"))
    version = params.whole("ros_version", 0, most=2)
    return sessions.load(params.text("file"), params.text("xacro_args", ""), version)


def edit(sessions: AssistantSessions, params: Params) -> AssistantValue:
    """``setup_assistant.edit``: another ``value`` of a ``part``."""
    number = params.whole("session")
    session = sessions.session(number)
    value = params.any("value")
    changed = edited(session.config, session.model, params.text("part"), value)
    sessions.renamed(session, changed)
    return sessions.value(number)


def find_pairs(sessions: AssistantSessions, params: Params) -> AssistantValue:
    """``setup_assistant.find_pairs``: look at ``trials`` random configurations."""
    number = params.whole("session")
    trials = params.whole("trials", 10_000, least=1, most=_MOST_TRIALS)
    with_pairs(sessions.session(number), trials)
    return sessions.value(number)


def progress(sessions: AssistantSessions, params: Params) -> float:
    """``setup_assistant.progress``: of the search for pairs, 0 to 1; ``stop`` ends it."""
    session = sessions.session(params.whole("session"))
    session.is_stopped = session.is_stopped or params.flag("stop", False)
    return session.progress


def files(sessions: AssistantSessions, params: Params) -> list[AssistantFile]:
    """``setup_assistant.files``: what would be written."""
    from gazelle.motion.setup_assistant import planned_files

    session = sessions.session(params.whole("session"))
    try:
        planned = planned_files(session.config, session.folder)
    except GazelleError as error:
        raise StudioError(str(error)) from error
    return [{"path": item.path, "state": item.state.value} for item in planned]


def write(sessions: AssistantSessions, params: Params) -> AssistantWritten:
    """``setup_assistant.write``: write the package; edited files only if in ``overwrite``."""
    from gazelle.motion.setup_assistant import FileState, planned_files, write_package
    from gazelle.motion.setup_assistant.next_steps import next_steps

    session = sessions.session(params.whole("session"))
    folder = sessions.writable(session)
    try:
        planned = planned_files(session.config, folder)
        written = write_package(session.config, folder, overwrite=params.texts("overwrite", []))
    except GazelleError as error:
        raise StudioError(str(error)) from error
    paths = [item.path for item in written]
    edited_files = [item.path for item in planned if item.state is FileState.EDITED]
    return {
        "written": paths,
        "kept": [path for path in edited_files if path not in paths],
        "next": next_steps(session.config),
    }


METHODS: dict[str, Method[AssistantSessions]] = {
    "setup_assistant.edit": edit,
    "setup_assistant.files": files,
    "setup_assistant.find_pairs": find_pairs,
    "setup_assistant.load": load,
    "setup_assistant.progress": progress,
    "setup_assistant.start": start,
    "setup_assistant.write": write,
}
