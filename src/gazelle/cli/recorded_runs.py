"""What ``gazelle record`` records: a world that runs, a launch that it starts, a file."""

from __future__ import annotations

import math
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from gazelle.diagnostics import nearest_names, render
from gazelle.errors import GazelleError, NotFoundError

if TYPE_CHECKING:
    from gazelle.graph import Graph
    from gazelle.recording import GraphRecorder, Recording
    from gazelle.testing.process_tree import ProcessTree

__all__ = ["USUAL_S", "Run", "RunProgress", "find_run"]

USUAL_S = 20.0
"""How much is recorded of what would go on for ever, simulated seconds."""

_ROS2_ENDINGS = ("launch.py", "launch.xml", "launch.yaml", "launch.yml")
_ROBOT_ENDINGS = (".urdf", ".xacro", ".sdf", ".world")
_BAG_ENDINGS = (".bag", ".mcap", ".db3", ".zstd")
_POLL_S = 0.1
_SLICE_S = 0.25
# A simulator that has to make convex parts of meshes for the first time takes its time.
_WORLD_S = 120.0
_PATIENCE_S = 5.0
_LONG_S = 15.0
_LAST_LINES = 30


class RunProgress(NamedTuple):
    """How a run is recorded.

    Attributes:
        seconds: simulated ones; 0 until Ctrl-C.
        topics: which; None for all but pictures and clouds.
        told: called with the seconds that are done, and those wanted.
        say: tells the person something.
        is_unpausing: let a world that stands still run.
    """

    seconds: float
    topics: Sequence[str] | None
    told: Callable[[float, float], None]
    say: Callable[[str], None]
    is_unpausing: bool = False

    @property
    def limit_s(self) -> float:
        """Simulated seconds, infinite until Ctrl-C."""
        return self.seconds or math.inf


class Run(Protocol):
    """Something that can be recorded."""

    @property
    def title(self) -> str:
        """What it is, for people."""
        ...

    @property
    def usual_s(self) -> float:
        """How many simulated seconds are recorded where nobody says; 0 for all."""
        ...

    def record(self, progress: RunProgress) -> Recording:
        """Record until time is up, it ends, or Ctrl-C, which is no failure."""
        ...


def find_run(
    target: Sequence[str],
    arguments: Sequence[str],
    *,
    is_fast: bool = False,
    is_verbose: bool = False,
    robot: str | None = None,
) -> Run:
    """Return what the words of a command line mean.

    Args:
        target: nothing, a file, or a package and a file's name.
        arguments: ``name:=value`` of a launch or xacro file.
        is_fast: simulate a launch as fast as possible.
        is_verbose: pass on what a launch prints.
        robot: the robot of a bag.

    Raises:
        GazelleError: there are too many words.
        NotFoundError: there is no such file.
    """
    if len(target) > 2:
        raise GazelleError(
            f"'{' '.join(target)}': name one file, or a package and a file in it; options stand "
            "before or behind, arguments are written name:=value"
        )
    if not target:
        return _RunningWorld()
    name = target[-1]
    is_ros2 = name.endswith(_ROS2_ENDINGS)
    if is_ros2 or name.endswith((".launch", ".test")):
        if len(target) == 1 and not Path(name).is_file():
            raise _no_file("launch file", name, (".launch", *_ROS2_ENDINGS))
        fast = ["--fast"] if is_fast else []
        words = ["ros2", "launch", *target] if is_ros2 else ["roslaunch", *fast, *target]
        if is_ros2 and is_fast:
            raise GazelleError("--fast works with roslaunch's files; ros2 launch has no such word")
        return _Launch((*words, *arguments), is_verbose)
    if len(target) == 1 and _is_bag(Path(name)):
        return _Bag(name, robot)
    mappings = dict(word.split(":=", 1) for word in arguments)
    return _File(_robot_file(target), mappings)


def _is_bag(path: Path) -> bool:
    return path.name.endswith(_BAG_ENDINGS) or (path / "metadata.yaml").is_file()


def _robot_file(target: Sequence[str]) -> str:
    if len(target) == 1:
        name = target[0]
        if name.endswith(_ROBOT_ENDINGS) and "://" not in name and not Path(name).exists():
            from gazelle.workspace import Workspace

            if Workspace.discover().world_file(name).path is None:
                raise _no_file("robot or world", name, _ROBOT_ENDINGS)
        return name
    from gazelle.workspace import Workspace

    package = Workspace.discover().package(target[0])
    found = sorted(package.path.rglob(Path(target[1]).name))
    if found:
        return str(found[0])
    names = sorted(path.name for path in package.path.rglob("*") if path.suffix in _ROBOT_ENDINGS)
    raise NotFoundError(
        "file",
        target[1],
        searched=[str(package.path)],
        nearest=nearest_names(target[1], names),
        hint=f"robots and worlds there: {', '.join(names) or 'none'}",
    )


def _no_file(kind: str, name: str, endings: tuple[str, ...]) -> NotFoundError:
    folder = Path(name).parent
    there = [
        str(one) for one in (sorted(folder.iterdir()) if folder.is_dir() else ())
        if one.name.endswith(endings)
    ]  # fmt: skip
    hint = "" if folder.name else f"in a package? gazelle record -o OUT PACKAGE {name}"
    nearest = nearest_names(name, there)
    return NotFoundError(kind, name, searched=[str(folder.absolute())], nearest=nearest, hint=hint)


@dataclass(frozen=True)
class _File:
    """A robot or a world, simulated in this process: the same each time."""

    source: str
    mappings: dict[str, str]
    usual_s: float = USUAL_S

    @property
    def title(self) -> str:
        return Path(self.source).name

    def record(self, progress: RunProgress) -> Recording:
        from gazelle.recording import record
        from gazelle.simulator import Simulation

        with Simulation.load(self.source, mappings=self.mappings) as sim:
            # Meshes that were not found, and the like.
            render(sim.diagnostics)
            recorder = record(sim, topics=progress.topics)
            with suppress(KeyboardInterrupt):
                while (left_s := progress.limit_s - sim.time_s) > sim.step_s / 2:
                    sim.run(seconds=min(left_s, _SLICE_S))
                    progress.told(sim.time_s, progress.seconds)
            return recorder.stop()


@dataclass(frozen=True)
class _Bag:
    """What was recorded before, whole."""

    path: str
    robot: str | None
    usual_s: float = 0.0

    @property
    def title(self) -> str:
        return Path(self.path).name

    def record(self, progress: RunProgress) -> Recording:
        from gazelle.diagnostics import Diagnostics
        from gazelle.recording import bag_recording

        found = Diagnostics()
        whole = bag_recording(self.path, robot=self.robot, diagnostics=found)
        render(found)
        progress.told(whole.duration_s, whole.duration_s)
        return whole


class _RunningWorld:
    """The world of the graph that runs."""

    title = "the running world"
    usual_s = USUAL_S

    def record(self, progress: RunProgress) -> Recording:
        from gazelle.graph import Graph
        from gazelle.recording import GraphRecorder

        with Graph.open(role="client") as graph, _recorder(graph, progress) as recorder:
            assert isinstance(recorder, GraphRecorder)
            if recorder.wait_for_world(_PATIENCE_S):
                with _until_interrupt(recorder):
                    _follow(recorder, graph, progress, lambda: "")
            return recorder.recording()


@dataclass(frozen=True)
class _Launch:
    """A launch on a graph of its own."""

    words: tuple[str, ...]
    is_verbose: bool
    usual_s: float = USUAL_S

    @property
    def title(self) -> str:
        return " ".join(self.words)

    def record(self, progress: RunProgress) -> Recording:
        from gazelle.graph.isolated_graph import open_graph
        from gazelle.testing.process_tree import ProcessTree, launch_environment

        with ExitStack() as stack:
            graph = stack.enter_context(open_graph())
            home = Path(stack.enter_context(_folder()))
            printed = _Printed(is_shown=self.is_verbose)
            tree = ProcessTree(
                self.words,
                cwd=Path.cwd(),
                environment=launch_environment(graph.port, home, {}),
                on_change=lambda: printed.look(tree),
            )
            stack.callback(tree.stop)
            recorder = stack.enter_context(_recorder(graph, progress))
            with _until_interrupt(recorder):
                _await_world(recorder, tree, progress.say)
                _follow(recorder, graph, progress, tree.ended)
            return recorder.recording()


class _Printed:
    """What a launch prints, passed on."""

    def __init__(self, *, is_shown: bool) -> None:
        self._is_shown = is_shown
        self._count = 0

    def look(self, tree: ProcessTree) -> None:
        if self._is_shown:
            lines = tree.lines
            for line in lines[self._count :]:
                print(line, file=sys.stderr)
            self._count = len(lines)


@contextmanager
def _until_interrupt(recorder: GraphRecorder) -> Iterator[None]:
    """Let Ctrl-C end a recording, but the command where there is nothing to write yet."""
    try:
        yield
    except KeyboardInterrupt:
        if not recorder.has_begun:
            raise


def _recorder(graph: Graph, progress: RunProgress) -> GraphRecorder:
    from gazelle.recording import GraphRecorder

    return GraphRecorder(graph, topics=progress.topics)


def _folder() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory(ignore_cleanup_errors=True)


def _await_world(recorder: GraphRecorder, tree: ProcessTree, say: Callable[[str], None]) -> None:
    begun_s, has_told = time.monotonic(), False
    end_s = begun_s + _WORLD_S
    while not recorder.wait_for_world(_POLL_S):
        if not has_told and time.monotonic() - begun_s > _LONG_S:
            has_told = True
            say(f"no world yet; waiting for one, {_WORLD_S:g} s at most")
        ended = tree.ended()
        if ended or time.monotonic() > end_s:
            why = ended or (
                f"it has shown no world within {_WORLD_S:g} s; does it start a simulator? One that "
                "runs already is recorded without a launch file: gazelle record -o OUT"
            )
            lines = "\n  ".join(tree.lines[-_LAST_LINES:])
            raise GazelleError(f"{tree.title}: {why}\n  what it printed last:\n  {lines}")


def _follow(
    recorder: GraphRecorder, graph: Graph, progress: RunProgress, ended: Callable[[], str]
) -> None:
    """Record until time is up or the run has ended."""
    still_since_s, seconds, has_told = time.monotonic(), recorder.seconds, False
    if progress.is_unpausing:
        _play(graph)
    while recorder.seconds < progress.limit_s and not ended():
        recorder.poll(_POLL_S)
        progress.told(recorder.seconds, progress.seconds)
        if recorder.seconds > seconds:
            still_since_s, seconds = time.monotonic(), recorder.seconds
        elif time.monotonic() - still_since_s > _PATIENCE_S and not has_told:
            has_told = True
            progress.say("the world stands still; press play in Studio, or add --unpause")


def _play(graph: Graph) -> None:
    """Let the world run, as Studio's button does."""
    from gazelle.graph.gazebo_names import SHOWN_SPACE, offered_name
    from gazelle.interfaces import service_type

    node = graph.create_node("_record_play", anonymous=True, rosout=False, is_ros2=True)
    kind: Any = service_type("std_srvs/Empty")
    client = node.create_client(offered_name(graph, f"{SHOWN_SPACE}/unpause_physics"), kind)
    client.call(kind.Request(), timeout_s=_PATIENCE_S)
    node.shutdown()
