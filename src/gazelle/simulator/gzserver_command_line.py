"""The command line of gzserver, gazebo and their ROS wrappers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.simulator.wall_clock import Mode

__all__ = ["HELP", "ServerOptions", "read_server_options"]

HELP = """\
Usage: gzserver [options] <world_file>

Options:
  -h, --help               this text
  -v, --version            the version
  --verbose                tell more, on the console
  -u, --pause              start in a paused state
  -s, --server-plugin LIB  library of ROS 2's gazebo_ros whose services are wanted
  -e, --physics ENGINE     named for compatibility; MuJoCo does the physics
  --seed N                 seed of all noise
  --iters N                stop after N steps
  --fast                   as fast as possible; late camera frames are dropped
  --gz                     as gz sim: the graph has no names of ROS 1's gazebo_ros
  --lockstep               as fast as possible; every camera frame is finished first
"""

# Options of Gazebo that take a value and have no meaning here, then those without a value.
_IDLE_VALUES = frozenset(
    {
        "-p", "--play", "--record_encoding", "--record_path", "--record_period",
        "--record_filter", "-o", "--profile", "--gui-client-plugin", "-g", "--gui-plugin",
        "--params-file", "--render-engine", "--physics-engine",
    }
)  # fmt: skip
_IDLE_FLAGS = frozenset({"-r", "--record", "--record_resources", "--minimal_comms", "-q"})
_VALUES = frozenset({"-s", "--server-plugin", "-e", "--physics", "--seed", "--iters"})
_FLAGS = frozenset(
    {
        "-h",
        "--help",
        "-v",
        "--version",
        "--verbose",
        "-u",
        "--pause",
        "--fast",
        "--lockstep",
        "--gz",
    }
)


@dataclass(frozen=True, slots=True)
class ServerOptions:
    """What the command line asks for.

    Attributes:
        world: a file or a known name; empty for the empty world.
        iterations: stop after so many steps, 0 for never.
        plugins: server plug-ins named with ``-s``.
        is_gz: ``gz sim`` was asked for (``--gz``), not Gazebo Classic.
    """

    world: str = ""
    paused: bool = False
    mode: Mode = Mode.REAL_TIME
    seed: int = 0
    iterations: int = 0
    verbose: bool = False
    plugins: tuple[str, ...] = ()
    is_gz: bool = False
    shows_help: bool = False
    shows_version: bool = False


def read_server_options(argv: Sequence[str], diagnostics: Diagnostics) -> ServerOptions:
    """Read the words left after ROS's own; unknown ones are reported and dropped."""
    options, rest = ServerOptions(), list(argv)
    while rest:
        word = rest.pop(0)
        name, equals, value = word.partition("=")
        if not word.startswith("-"):
            options = _with_world(options, word, diagnostics)
        elif name in _VALUES | _IDLE_VALUES:
            if not equals:
                value = rest.pop(0) if rest else ""
            options = _with_value(options, name, value, diagnostics)
        elif word in _FLAGS:
            options = _with_flag(options, word)
        elif word in _IDLE_FLAGS:
            _report_idle(word, diagnostics)
        else:
            text = f"gzserver has no option '{word}'; it is dropped"
            known = sorted(_VALUES | _FLAGS | _IDLE_VALUES | _IDLE_FLAGS)
            diagnostics.report("simulator.unknown-argument", text, fix=did_you_mean(word, known))
    return options


def _with_world(options: ServerOptions, word: str, diagnostics: Diagnostics) -> ServerOptions:
    if not options.world:
        return replace(options, world=word)
    text = f"a world is named already ('{options.world}'); '{word}' is dropped"
    diagnostics.report("simulator.unknown-argument", text)
    return options


def _with_value(
    options: ServerOptions, name: str, value: str, diagnostics: Diagnostics
) -> ServerOptions:
    if name in {"-s", "--server-plugin"}:
        return replace(options, plugins=(*options.plugins, value))
    if name in {"--seed", "--iters"}:
        if not value.isdigit():
            text = f"{name} needs a whole number, not '{value}'; it is dropped"
            diagnostics.report("simulator.unknown-argument", text)
            return options
        if name == "--seed":
            return replace(options, seed=int(value))
        return replace(options, iterations=int(value))
    if name not in {"-e", "--physics"}:
        _report_idle(name, diagnostics)
    return options


def _with_flag(options: ServerOptions, word: str) -> ServerOptions:
    match word:
        case "-u" | "--pause":
            return replace(options, paused=True)
        case "--fast":
            return replace(options, mode=Mode.FAST)
        case "--lockstep":
            return replace(options, mode=Mode.LOCKSTEP)
        case "--gz":
            return replace(options, is_gz=True)
        case "--verbose":
            return replace(options, verbose=True)
        case "-v" | "--version":
            return replace(options, shows_version=True)
        case _:
            return replace(options, shows_help=True)


def _report_idle(word: str, diagnostics: Diagnostics) -> None:
    text = f"option '{word}' of Gazebo has no effect here"
    diagnostics.report("simulator.unknown-argument", text)
