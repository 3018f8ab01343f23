"""``ign sdf``, and ``gz sdf`` of the new Gazebo: options and output of sdformat 12 and 14."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from getopt import GetoptError, gnu_getopt
from pathlib import Path

from gazelle.cli.sdf.sdf_file import read_for, report_findings, say, take_quiet
from gazelle.description.sdformat_emulation.gz_sdf_command import Document, to_text
from gazelle.description.sdformat_emulation.gz_sdf_command.checks import load, name_problems
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.frame_attached_to_graph import (
    attached_graph,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.pose_relative_to_graph import (
    relative_graph,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Code, SdfError, error_line
from gazelle.description.sdformat_emulation.gz_sdf_command.inertial_stats import inertial_stats
from gazelle.description.sdformat_emulation.gz_sdf_command.printer import (
    Snap,
    described_specification,
    with_angles_in_degrees,
    with_includes,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.specification import specification
from gazelle.description.sdformat_emulation.release import Release

__all__ = ["run_sdf", "usage", "version_of"]

_VERSIONS = {Release.V12: "12.3.0", Release.V14: "14.8.0"}
_FAILED = 255
_SNAP_LIMIT_DEG = 360
_USAGE = """Utilities for SDF files.

  ign sdf [options]

Options:

  -k [ --check ] arg                Check if an SDFormat file is valid.
  -d [ --describe ] [SPEC VERSION]  Print the aggregated SDFormat spec description. Default version (1.9).
  -g [ --graph ] <pose, frame> arg  Print the PoseRelativeTo or FrameAttachedTo graph. (WARNING: This is for advanced
                                    use only and the output may change without any promise of stability)
  -p [ --print ] arg                Print converted arg.
      -i [ --preserve-includes ]    Preserve included tags when printing converted arg (does not preserve merge-includes).
      --degrees                     Pose rotation angles are printed in degrees.
      --snap-to-degrees arg         Snap pose rotation angles to this specified interval in degrees. This value must be
                                    larger than 0, less than or equal to 360, and larger than the defined snap tolerance.
      --snap-tolerance arg          Used in conjunction with --snap-to-degrees, specifies the tolerance at which snapping
                                    occurs. This value must be larger than 0, less than 360, and less than the defined
                                    degrees value to snap to. If unspecified, its default value is 0.01.
  --inertial-stats  arg             Prints moment of inertia, centre of mass, and total mass from a model sdf file.
  --no-findings                     Gazelle: leave out its own findings behind the output.
  -h [ --help ]                     Print this help message.
  --force-version <VERSION>         Use a specific library version.
  --versions                        Show the available versions."""  # noqa: E501
_SHORT = "hk:dpg:i"
_LONG = [
    "help", "check=", "describe", "print", "graph=", "preserve-includes", "degrees",
    "snap-to-degrees=", "snap-tolerance=", "inertial-stats=",
]  # fmt: skip
_NAMES = {"-k": "check", "-d": "describe", "-p": "print", "-g": "graph", "-i": "preserve-includes"}


def version_of(release: Release) -> str:
    """Return the version that a release of the new Gazebo's sdformat tells."""
    return _VERSIONS[release]


def run_sdf(argv: list[str], tool: str = "ign", release: Release = Release.V12) -> int:
    """Run ``ign sdf``, which gz calls ``gz sdf``, with the words behind ``sdf``.

    Returns:
        The exit code.
    """
    argv, is_quiet = take_quiet(argv)
    if "--versions" in argv:
        print(version_of(release))
        return 0
    try:
        pairs, rest = gnu_getopt(argv, _SHORT, _LONG)
    except GetoptError:
        return _usage(tool, release)
    options = {_NAMES.get(name, name.lstrip("-")): value for name, value in pairs}
    if "h" in options or "help" in options:
        print(usage(tool, release))
        return 0
    if "check" in options:
        return _told(lambda word: _check(word, release), options["check"], is_quiet=is_quiet)
    if "inertial-stats" in options:
        file = options["inertial-stats"]
        return _told(lambda word: _print_stats(word, release), file, is_quiet=is_quiet)
    if "describe" in options:
        return _describe(rest[0] if rest else release.spec_text, tool, release)
    if "print" in options and rest:
        return _print(rest[-1], options, release, is_quiet=is_quiet)
    if "graph" in options and rest:
        kind = options["graph"]
        return _told(lambda word: _print_graph(kind, word, release), rest[0], is_quiet=is_quiet)
    return _usage(tool, release)


def usage(tool: str, release: Release = Release.V12) -> str:
    """Return the options as ``ign help sdf`` or ``gz help sdf`` shows them."""
    text = _USAGE.replace("(1.9)", f"({release.spec_text})")
    return text.replace("ign sdf", f"{tool} sdf")


def _usage(tool: str, release: Release) -> int:
    print(usage(tool, release))
    return _FAILED


def _told(action: Callable[[str], int], word: str, *, is_quiet: bool) -> int:
    code = action(word)
    if not is_quiet:
        report_findings(word)
    return code


def _check(word: str, release: Release) -> int:
    path = str(Path(word).absolute())
    document = read_for(path, release)
    say(document.console.lines)
    if document.root is None:
        unread = SdfError(Code.FILE_READ, f"Unable to read file:{path}")
        _say([*document.errors, unread], release)
        return _FAILED
    loaded = load(document)
    say(loaded.console.lines)
    errors = [*document.errors, *loaded.errors]
    problems = [] if errors else name_problems(document)
    _say([*errors, *problems], release)
    if not errors:
        # The file is read a second time and says everything again.
        say(document.console.lines)
    if errors or problems:
        return _FAILED
    print("Valid.")
    return 0


def _print(word: str, options: dict[str, str], release: Release, *, is_quiet: bool) -> int:
    try:
        snap = _snap_of(options)
    except ValueError as error:
        print(error)
        return _FAILED
    document = _existing(word, release)
    if document is None:
        return _FAILED
    say(_said(document))
    if document.root is None:
        say(["Error: SDF parsing the xml failed."])
        return _told(lambda _word: _FAILED, word, is_quiet=is_quiet)
    root = with_includes(document) if "preserve-includes" in options else document.root
    if snap is not None or "degrees" in options:
        root = with_angles_in_degrees(root, specification(release), snap)
    sys.stdout.write(to_text(root, release))
    return _told(lambda _word: 0, word, is_quiet=is_quiet)


def _snap_of(options: dict[str, str]) -> Snap | None:
    """Return how angles are snapped.

    Raises:
        ValueError: in the words of the program.
    """
    if "snap-to-degrees" not in options:
        return None
    interval = _number(options["snap-to-degrees"])
    tolerance = _number(options.get("snap-tolerance", "0.01"))
    if not 0 < interval <= _SNAP_LIMIT_DEG or interval != int(interval):
        raise ValueError(
            "Degree interval to snap to must be more than 0, and less than or equal to 360."
        )
    if not 0 <= tolerance <= _SNAP_LIMIT_DEG:
        raise ValueError("Rotation snapping tolerance must be more than 0, and less than 360.")
    if interval < tolerance:
        raise ValueError("Rotation snapping tolerance must be larger than the snapping tolerance.")
    return Snap(int(interval), tolerance)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return -1.0


def _existing(word: str, release: Release) -> Document | None:
    path = Path(word).absolute()
    if not path.exists():
        say([f"Error: File [{path}] does not exist."])
        return None
    return read_for(str(path), release)


def _say(lines: Iterable[str | SdfError], release: Release) -> None:
    say(error_line(one, release) if isinstance(one, SdfError) else one for one in lines)


def _said(document: Document) -> list[str]:
    return [
        *document.console.lines,
        *(error_line(one, document.console.release) for one in document.errors),
    ]


def _print_graph(kind: str, word: str, release: Release) -> int:
    document = _existing(word, release)
    if document is None:
        return _FAILED
    say(document.console.lines)
    loaded = load(document) if document.root is not None else None
    if loaded is not None:
        _say([*loaded.console.lines, *document.errors, *loaded.errors], release)
    if kind not in ("pose", "frame"):
        say(['Only "pose" and "frame" graph types are supported'])
        return 0
    subject = None if loaded is None else loaded.worlds[0] if loaded.worlds else loaded.model
    if subject is None:
        print("digraph {\n}\n")
        return 0
    errors: list[SdfError] = []
    build = relative_graph if kind == "pose" else attached_graph
    dot = build(subject, errors).graph.to_dot()
    _say(errors, release)
    print(dot)
    return 0


def _print_stats(word: str, release: Release) -> int:
    document = _existing(word, release)
    if document is None or document.root is None:
        say([] if document is None else _said(document))
        return _FAILED
    loaded = load(document)
    _say([*document.console.lines, *loaded.console.lines], release)
    _say([*document.errors, *loaded.errors], release)
    if loaded.worlds:
        say(["Error: Expected a model file but received a world file."])
        return _FAILED
    if loaded.model is None:
        say(["Error: Could not find the model."])
        return _FAILED
    sys.stdout.write(inertial_stats(loaded.model))
    return 0


def _describe(version: str, tool: str, release: Release) -> int:
    if version != release.spec_text:
        text = f"gazelle: {tool} sdf describes SDF {release.spec_text} here, not {version}"
        say([f"{text}; others: gz sdf -d with ROS_DISTRO=noetic (1.7), humble (1.9), jazzy (1.11)"])
        return _FAILED
    sys.stdout.write(described_specification(release))
    return 0
