"""``gazelle record``: a run as a film, a picture or a page that replays it, without a display."""

from __future__ import annotations

import argparse
import os
import re
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from gazelle.cli.recorded_runs import USUAL_S, Run, RunProgress, find_run
from gazelle.errors import GazelleError
from gazelle.sensors.film_files import FILM_SUFFIXES, check_film

if TYPE_CHECKING:
    from gazelle.recording import Recording
    from gazelle.video import Camera

__all__ = ["FLAGS", "VALUES", "main"]

FLAGS = frozenset({"--fast", "--unpause", "--no-topics", "-v", "--verbose"})
"""Options without a value."""

VALUES = {
    "--camera": ("auto", "behind", "fixed", "follow", "orbit"),
    "--view": ("back", "bottom", "front", "iso", "left", "right", "side", "top"),
}
"""Options whose values are words."""

_PAGE = ".html"
_PICTURE = ".png"
_SUFFIXES = (_PAGE, *FILM_SUFFIXES, _PICTURE)
_USUAL = "run.html"
_SIZE = re.compile(r"(\d+)x(\d+)")
_INTERRUPTED = 130


def main(argv: list[str]) -> int:
    """Record a run and write it."""
    given = [word for word in argv if ":=" in word and not word.startswith("-")]
    options = _parser().parse_args([word for word in argv if word not in given])
    outputs = [_checked(name) for name in options.output or (_USUAL,)]
    camera = _camera(options)
    # As Ctrl-C: whoever ends it wants what there is.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    run = find_run(
        options.target,
        given,
        is_fast=options.fast,
        is_verbose=options.verbose,
        robot=options.robot,
    )
    recording = _record(run, options)
    if recording.duration_s == 0.0:
        _say("the world stood still all the time: press play in Studio, or add --unpause")
    for path in outputs:
        code = _write(recording, path, camera, options)
        if code:
            return code
    return 0


def _record(run: Run, options: argparse.Namespace) -> Recording:
    seconds = run.usual_s if options.seconds is None else options.seconds
    wanted = options.delay + seconds if seconds else 0.0
    topics = [] if options.no_topics else options.topic or None
    with _progress(f"recording {run.title}", wanted) as told:
        whole = run.record(RunProgress(wanted, topics, told, _say, is_unpausing=options.unpause))
    if whole.duration_s < options.delay:
        raise GazelleError(
            f"the run ended after {whole.duration_s:.1f} s, before the {options.delay:g} s of "
            "--delay were over, so there is nothing to write"
        )
    return whole.part(options.delay, seconds or None)


def _write(
    recording: Recording, path: Path, camera: Camera | None, options: argparse.Namespace
) -> int:
    if path.suffix.lower() == _PAGE:
        from gazelle.studio.replay import write_html

        write_html(recording, path, title=options.title)
        _tell(path, f"{recording.duration_s:.1f} s")
        return 0
    from gazelle.sensors.kernel_warm_up import warm_up
    from gazelle.video import write_picture, write_video

    warm_up(_say)
    size_px = options.size
    if path.suffix.lower() == _PICTURE:
        write_picture(recording, path, camera=camera, size_px=size_px)
        _tell(path, f"{size_px[0]}x{size_px[1]}")
        return 0
    drawn = [0, 0]
    try:
        with _progress(f"drawing {path.name}", 0.0) as told:

            def progress(done: int, of: int) -> None:
                drawn[:] = done, of
                told(done, of)

            write_video(
                recording,
                path,
                camera=camera,
                size_px=size_px,
                fps=options.fps,
                speed=options.speed,
                progress=progress,
            )
    except KeyboardInterrupt:
        if not drawn[0]:
            raise
        _tell(path, f"{drawn[0]} of {drawn[1]} frames, ended early")
        return _INTERRUPTED
    _tell(path, f"{size_px[0]}x{size_px[1]}, {drawn[0]} frames, {drawn[0] / options.fps:.1f} s")
    return 0


def _tell(path: Path, what: str) -> None:
    size = path.stat().st_size
    shown = f"{size / 1e6:.1f} MB" if size >= 1e6 else f"{size / 1e3:.0f} kB"
    print(f"{path}: {what}, {shown}")


def _say(text: str) -> None:
    print(f"gazelle record: {text}", file=sys.stderr)


class _Told(NamedTuple):
    """A bar on the terminal of a person who waits."""

    start: Callable[[], object]
    stop: Callable[[], object]
    update: Callable[[float, float], None]

    def __enter__(self) -> Callable[[float, float], None]:
        self.start()
        return self.update

    def __exit__(self, *exc_info: object) -> None:
        self.stop()


def _progress(text: str, total: float) -> _Told:
    """Show how far something is; programs that read are left in peace."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    shown = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.completed:.0f} of {task.total:.0f}" if total else "{task.completed:.0f}"),
        TimeRemainingColumn(),
        console=Console(stderr=True),
        transient=True,
        disable=not sys.stderr.isatty(),
    )
    task = shown.add_task(text, total=total or None)

    def update(done: float, of: float) -> None:
        shown.update(task, completed=done, total=of or None)

    return _Told(shown.start, shown.stop, update)


def _checked(name: str) -> Path:
    """Return where to write; what would fail at the end is told before the run."""
    path = Path(name)
    if path.suffix.lower() not in (_PAGE, _PICTURE):
        check_film(path)
    folder = path.absolute().parent
    if not folder.is_dir():
        raise GazelleError(f"{path} cannot be written: there is no folder {folder}")
    if path.is_dir() or not os.access(path if path.exists() else folder, os.W_OK):
        raise GazelleError(f"{path} cannot be written: it is a folder, or you may not write there")
    return path


def _camera(options: argparse.Namespace) -> Camera | None:
    from gazelle.video import AutomaticCamera, FixedCamera, FollowCamera, SensorCamera

    word, _, model = options.camera.partition(":")
    if options.eye is not None:
        target = None if options.look_at is None else tuple(options.look_at)
        return FixedCamera(tuple(options.eye), target, model=model or None)
    if options.look_at is not None:
        _parser().error("--look-at needs --eye")
    # A sensor's name has colons of its own.
    if model.startswith(":"):
        return SensorCamera(options.camera)
    match word:
        case "auto":
            return AutomaticCamera(view=options.view)
        case "fixed":
            return FixedCamera(view=options.view, model=model or None)
        case "follow":
            return FollowCamera(model or None, view=options.view)
        case "behind":
            return FollowCamera(model or None, turns=True)
        case "orbit":
            return FollowCamera(model or None, view=options.view, orbit_s=options.orbit)
    return SensorCamera(options.camera)


def _parser() -> argparse.ArgumentParser:
    from gazelle.sensors.view_cameras import VIEWS

    parser = argparse.ArgumentParser(
        prog="gazelle record",
        usage="gazelle record [-o OUT] [options] [PACKAGE LAUNCH | FILE | BAG] [name:=value …]",
        description="Record a run: as one HTML file that replays it, as a film or as a picture. "
        "Without a target the world that runs is recorded; a launch file is started, a robot or "
        "world file is simulated here.",
    )
    add = parser.add_argument
    add("target", nargs="*", help="launch file, robot or world; with or without its package")
    add(
        "-o",
        "--output",
        action="append",
        type=_output,
        metavar="OUT",
        help=f"file to write, of {', '.join(_SUFFIXES)}; may be given more than once "
        f"(default: {_USUAL})",
    )
    add(
        "-s",
        "--seconds",
        type=_seconds,
        help=f"simulated seconds, 0 until Ctrl-C (default: {USUAL_S:g}, of a bag all)",
    )
    add("--delay", type=_seconds, default=0.0, help="simulated seconds to leave out before")
    add("--robot", metavar="FILE", help="the robot of a bag (default: its robot_description)")
    add("--fast", action="store_true", help="simulate as fast as possible (launch files)")
    add("--unpause", action="store_true", help="let a world that stands still run")
    add("--topic", action="append", metavar="NAME", help="record this topic (default: all small)")
    add("--no-topics", action="store_true", help="record no topics")
    add("--title", help="of the page (default: the robots' names)")
    add("-v", "--verbose", action="store_true", help="show what the launch prints")
    film = parser.add_argument_group("films and pictures")
    add = film.add_argument
    add(
        "--camera",
        default="auto",
        metavar="CAMERA",
        help="fixed, follow, behind or orbit, each with :MODEL if wanted, or the name of a camera "
        "sensor or link to look from (default: follows a robot that goes far)",
    )
    add("--view", default="iso", choices=VIEWS, help="from where it looks (default: iso)")
    xyz = ("X", "Y", "Z")
    add("--eye", nargs=3, type=float, metavar=xyz, help="where a fixed camera stands, m")
    add("--look-at", nargs=3, type=float, metavar=xyz, help="what it looks at, with --eye")
    add("--orbit", type=_above_zero, default=20.0, metavar="S", help="of one round (default: 20 s)")
    add("--size", type=_size, default=(640, 400), metavar="WxH", help="pixels (default: 640x400)")
    add("--fps", type=_above_zero, default=25.0, help="frames per second (default: 25)")
    add("--speed", type=_above_zero, default=1.0, help="of time in the film (default: 1)")
    return parser


def _output(text: str) -> str:
    suffix = Path(text).suffix.lower()
    if suffix not in _SUFFIXES:
        known = ", ".join(_SUFFIXES)
        what = f"'{suffix}'" if suffix else "a name without an ending"
        raise argparse.ArgumentTypeError(f"'{text}': {what} is not written; end it with {known}")
    return text


def _seconds(text: str) -> float:
    return _number(text, least=0.0)


def _above_zero(text: str) -> float:
    value = _number(text, least=0.0)
    if value == 0.0:
        raise argparse.ArgumentTypeError(f"'{text}' is no number above 0")
    return value


def _number(text: str, *, least: float) -> float:
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not least <= value < float("inf"):
        raise argparse.ArgumentTypeError(f"'{text}' is no number of {least:g} or more")
    return value


def _size(text: str) -> tuple[int, int]:
    found = _SIZE.fullmatch(text)
    if found is None or not all(16 <= int(side) <= 8192 for side in found.groups()):
        raise argparse.ArgumentTypeError(f"'{text}' is no size of 16 to 8192 pixels, as 640x400")
    return int(found[1]), int(found[2])
