"""``gz sim``, ``ign gazebo``: a world with the options of the new Gazebo."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from gazelle._version import __version__
from gazelle.cli.gz.options import GzError
from gazelle.cli.sdf.sdf_file import say
from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics, did_you_mean, render_text
from gazelle.documents import read_text_limited
from gazelle.workspace import Workspace

__all__ = ["SimStart", "lets_world_go", "read_sim", "run"]

_CONTROL = re.compile(r"(?:lib)?WorldControl(?:\.so)?")
_DECLARATION = re.compile(r"\s*<\?xml.*?\?>", re.DOTALL)
_YES = frozenset({"true", "1"})
_NO = frozenset({"false", "0"})
_HELP = """
Run and manage Gazebo simulations; here with Gazelle's simulator.

  gz sim [options] [file]

Available Options:
  -s                    Run only the server; there is no other here.
  -g                    Run only the GUI: stays alive, there is no window.
  -r                    Run simulation on start. Without it the world starts paused.
  --gui-config arg      A file of the window's plug-ins: without -r and -s, a WorldControl whose
                        <start_paused> is false runs the world. So does one in the world's <gui>.
  --iterations arg      Number of iterations to execute, then end.
  --seed arg            Seed of all noise.
  -v [ --verbose ] arg  Output level from 0 to 4, 3 when it is left out; from 3 on notices are
                        shown too.
  --headless-rendering  Always so here: cameras need no display.
  --version             The version of Gazelle.
  -h [ --help ]         This text.

Options of Gazebo that have no effect here are named when they are given: physics is MuJoCo's,
pictures are ray-traced, time runs by the world's real_time_factor, records are bags (ros2 bag
record)."""
_LOUD = 3
_VALUES = frozenset({"--iterations", "--seed"})
_IDLE_VALUES = frozenset(
    {
        "-z", "--network-role", "--network-secondaries", "--record-path", "--record-topic",
        "--playback", "--physics-engine", "--render-engine", "--initial-sim-time",
        "--render-engine-gui", "--render-engine-server", "--render-engine-gui-api-backend",
        "--render-engine-server-api-backend", "--force-version",
    }
)  # fmt: skip
_IDLE_FLAGS = frozenset(
    {"--levels", "--record", "--record-resources", "--log-overwrite", "--log-compress",
     "--wait-gui", "--same-process"}
)  # fmt: skip
_FLAGS = frozenset({"-s", "-g", "-r", "-h", "--help", "--version", "--versions"})
_SILENT_FLAGS = frozenset({"--headless-rendering"})
_WHY = {
    "--playback": "no state.log is played here; ros2 bag play plays bags",
    "--record": "no state.log is written here; gz log -d 1 and ros2 bag record write bags",
    "--record-path": "no state.log is written here; gz log -d 1 and ros2 bag record write bags",
    "--physics-engine": "MuJoCo does the physics",
    "-z": "the world's real_time_factor and max_step_size say how fast it runs",
}
_CLUSTER = re.compile(r"-(?P<letters>[grs]*v?)(?P<level>(?<=v)[0-4])?")


@dataclass(slots=True)
class SimStart:
    """What the command line asks for.

    Attributes:
        world: a file or a known name; empty for the empty world.
        flags: those of `gz sim` that are given.
        level: of the output.
        values: ``--iterations`` and ``--seed``, whole numbers.
        notes: what has no effect here, and why.
        gui_config: file of the window's plug-ins.
    """

    world: str = ""
    flags: set[str] = field(default_factory=set)
    level: int = 1
    values: dict[str, int] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    gui_config: str = ""

    @property
    def server_words(self) -> list[str]:
        """The same in words of gzserver."""
        options = [self.world] if self.world else []
        options += [] if "-r" in self.flags else ["--pause"]
        options += ["--verbose"] if self.level >= _LOUD else []
        if "--iterations" in self.values:
            options += ["--iters", str(self.values["--iterations"])]
        if "--seed" in self.values:
            options += ["--seed", str(self.values["--seed"])]
        return options


def lets_world_go(world: str, gui_config: str, diagnostics: Diagnostics | None = None) -> bool:
    """Tell whether the window's ``WorldControl`` starts a world without ``-r``.

    It does where ``<start_paused>`` says no. A file of ``--gui-config`` counts in place of the
    world's own ``<gui>``.

    Args:
        world: the world's file, empty for the empty world.
        gui_config: the file that is named, empty for none.
        diagnostics: hears what is wrong in `gui_config`; the world's reader tells of the world.

    Raises:
        OSError, UnicodeDecodeError: `gui_config` cannot be read.
    """
    file = Path(gui_config or world)
    try:
        text = read_text_limited(file) if str(file) != "." else ""
    except (OSError, UnicodeDecodeError):
        if gui_config:
            raise
        return False
    # A configuration has no root of its own.
    inside = _DECLARATION.sub("", text, count=1)
    heard = diagnostics if gui_config and diagnostics is not None else Diagnostics()
    root = parse_xml(f"<gui>{inside}</gui>", str(file), heard)
    if root is None:
        return False
    guis = (root,) if gui_config else (tag for tag in root.walk() if tag.name == "gui")
    return any(_starts(plugin) for gui in guis for plugin in _plugins(gui))


def run(argv: list[str]) -> int:
    """Run a world in this process until Ctrl-C or the last iteration.

    Returns:
        The exit code of the world; 255 for wrong words.
    """
    from gazelle.cli import gzserver

    start = read_sim(argv)
    if start.flags & {"-h", "--help"}:
        print(_HELP)
        return 0
    if start.flags & {"--version", "--versions"}:
        print(f"Gazelle {__version__}")
        return 0
    say(f"gazelle: {note}" for note in start.notes)
    if "-g" in start.flags and "-s" not in start.flags:
        from gazelle.nodes.__main__ import main as run_node

        return run_node(["gazebo_ros/gzclient"])
    start.world = _found_world(start.world)
    if not start.flags & {"-r", "-s"} and _is_let_go(start):
        start.flags.add("-r")
    if "-r" not in start.flags:
        say(["gazelle: the world is paused, as gz sim has it without -r; gz world -p 0 lets it go"])
    return gzserver.main([*start.server_words, "--gz"])


def read_sim(argv: Iterable[str]) -> SimStart:
    """Read the words behind ``gz sim``.

    Raises:
        GzError: an option that is not Gazebo's, or a value that is none.
    """
    start, rest = SimStart(), deque(_parted(argv))
    while rest:
        word = rest.popleft()
        name, equals, value = word.partition("=")
        if not word.startswith("-"):
            _take_world(start, word)
        elif name == "--gui-config":
            start.gui_config = value if equals else _next(rest, name)
        elif name in _VALUES | _IDLE_VALUES:
            value = value if equals else _next(rest, name)
            _take_value(start, name, value)
        elif name in {"-v", "--verbose"}:
            start.level = _level(value, rest)
        elif word in _IDLE_FLAGS:
            start.notes.append(_idle(word))
        elif word in _FLAGS | _SILENT_FLAGS:
            start.flags.add(word)
        else:
            options = _VALUES | _IDLE_VALUES | _IDLE_FLAGS | _FLAGS | _SILENT_FLAGS
            known = sorted({*options, "--gui-config"})
            hint = did_you_mean(word, known) or "see gz sim --help"
            raise GzError(f"gz sim has no option '{word}'; {hint}")
    return start


def _plugins(gui: Tag) -> Iterable[Tag]:
    found = (tag for tag in gui.find_all("plugin"))
    return (tag for tag in found if _CONTROL.fullmatch(tag.attributes.get("filename", "")))


def _starts(control: Tag) -> bool:
    has_buttons = control.text_of("play_pause").lower() in _YES
    return has_buttons and control.text_of("start_paused").lower() in _NO


def _is_let_go(start: SimStart) -> bool:
    """Tell whether the window's configuration starts the world, and what is wrong with it."""
    diagnostics = Diagnostics()
    try:
        lets_go = lets_world_go(start.world, start.gui_config, diagnostics)
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or error
        say([
            f"gazelle: --gui-config {start.gui_config}: {why}; the window has no configuration\n"
            "  fix: name a file that is there, from the folder the command runs in"
        ])  # fmt: skip
        return False
    say(render_text(one) for one in diagnostics)
    return lets_go


def _parted(argv: Iterable[str]) -> Iterable[str]:
    """Letters may stand together: ``-sr``, ``-rv4``."""
    for word in argv:
        found = _CLUSTER.fullmatch(word)
        if found:
            yield from (f"-{letter}" for letter in found["letters"])
            yield from (found["level"],) if found["level"] else ()
        else:
            yield word


def _level(value: str, rest: deque[str]) -> int:
    """The level may be left out."""
    if not value and rest and rest[0] in {"0", "1", "2", "3", "4"}:
        value = rest.popleft()
    return int(value) if value.isdigit() else _LOUD


def _take_world(start: SimStart, word: str) -> None:
    if start.world:
        raise GzError(f"a world is named already ('{start.world}'); what is '{word}'?")
    start.world = word


def _take_value(start: SimStart, name: str, value: str) -> None:
    if name in _IDLE_VALUES:
        start.notes.append(_idle(f"{name} {value}"))
    elif value.isdigit():
        start.values[name] = int(value)
    else:
        raise GzError(f"{name} needs a whole number, not '{value}'")


def _next(rest: deque[str], name: str) -> str:
    if not rest:
        raise GzError(f"{name} needs a value")
    return rest.popleft()


def _idle(option: str) -> str:
    why = _WHY.get(option.split(maxsplit=1)[0], "")
    return f"{option} has no effect here" + (f": {why}" if why else "")


def _found_world(word: str) -> str:
    """Return a world's file: a path, a name that Gazebo ships, a URL of a file or a package.

    Raises:
        GzError: a folder, or what is not on this machine.
    """
    if not word:
        return word
    if Path(word).is_dir():
        raise GzError(f"'{word}' is a folder; gz sim wants a file of SDF with a world")
    found = Workspace.discover().world_file(word)
    if found.path is None:
        raise GzError(f"Unable to find or download file {word}: {found.explain(word)}")
    return str(found.path)
