"""``rosbag compress``, ``decompress`` and ``reindex``: bags in place of themselves."""

from __future__ import annotations

import shutil
import sys
import time
from optparse import OptionParser, Values
from pathlib import Path

from gazelle.bag import BagMessage, BagReader, create_bag, open_bag
from gazelle.bag.conversion import copy_bag
from gazelle.bag.formats import ROS1
from gazelle.cli.ros_tool import add_flag, option_parser
from gazelle.cli.rosbag.info import human_size
from gazelle.diagnostics import Diagnostics, render

__all__ = ["ProgressMeter", "compress", "decompress", "reindex"]

_REST = 37
_PERIOD_S = 1.0


class ProgressMeter:
    """Draws ``name 45% 1.0 KB / 2.0 KB 00:10 ETA`` once a second."""

    def __init__(self, path: str, total: int) -> None:
        """Draw the start."""
        width = shutil.get_terminal_size().columns - _REST
        self._name = path if len(path) <= width else f"...{path[3 - width :]}"
        self._width = width
        self._total = total
        self._start_s = self._drawn_s = time.monotonic()
        self._draw(0, 0.0)

    def step(self, size: int) -> None:
        """Tell how many bytes are done."""
        now_s = time.monotonic()
        if now_s - self._drawn_s > _PERIOD_S:
            self._drawn_s = now_s
            self._draw(size, now_s - self._start_s)

    def finish(self) -> None:
        """Draw the end."""
        self._draw(self._total, time.monotonic() - self._start_s)
        print()

    def _draw(self, size: int, elapsed_s: float) -> None:
        total = human_size(self._total)
        if size >= self._total:
            clock = f"{int(elapsed_s / 60):02d}:{int(elapsed_s % 60):02d}"
            text = f"{self._name:<{self._width}} 100% {total:>19} {clock}    "
        else:
            share = size / self._total
            left_s = elapsed_s * (1 / share - 1) if share else 0.0
            left = f"{int(left_s / 60):02d}:{int(left_s % 60):02d}"
            if not share or left_s > 99 * 60:
                left = "--:--"
            head = f"{self._name:<{self._width}} {int(100 * share):3d}%"
            text = f"{head} {human_size(size):>8} / {total:>8} {left} ETA"
        sys.stdout.write(f"\r {text}")
        sys.stdout.flush()


def compress(argv: list[str]) -> int:
    """Write bags with compressed chunks; what they were stays as ``NAME.orig.bag``."""
    parser = _parser("compress")
    add_flag(parser, "-j", "--bz2", dest="bz2", text="use BZ2 compression")
    add_flag(parser, "--lz4", dest="lz4", text="use lz4 compression")
    options, args = _arguments(parser, argv)
    if options.bz2 and options.lz4:
        parser.error("Can specify only one compression format.")
    return _rewrite(args, options, "lz4" if options.lz4 else "bz2")


def decompress(argv: list[str]) -> int:
    """Write bags without compression; what they were stays as ``NAME.orig.bag``."""
    options, args = _arguments(_parser("decompress"), argv)
    return _rewrite(args, options, "none")


def reindex(argv: list[str]) -> int:
    """Write bags with an index that were not closed; what they were stays as ``NAME.orig.bag``."""
    options, args = _arguments(_parser("reindex"), argv)
    return _rewrite(args, options, "")


def _parser(command: str) -> OptionParser:
    parser = option_parser("rosbag", f"{command} [options] BAGFILE1 [BAGFILE2 ...]")
    parser.add_option("--output-dir", metavar="DIR", help="write to directory DIR")
    add_flag(
        parser, "-f", "--force", dest="force", text="force overwriting of backup file if it exists"
    )
    add_flag(parser, "-q", "--quiet", dest="quiet", text="suppress noncritical messages")
    return parser


def _arguments(parser: OptionParser, argv: list[str]) -> tuple[Values, list[str]]:
    options, args = parser.parse_args(argv)
    if not args:
        parser.error("You must specify at least one bag file.")
    return options, args


def _rewrite(args: list[str], options: Values, compression: str) -> int:
    for word in args:
        path = Path(word)
        bag = open_bag(path)
        if bag.storage != ROS1.name:
            print(f"Skipping {word}. It is {bag.storage}; see `ros2 bag reindex` and `gazelle bag "
                  "convert`.", file=sys.stderr)  # fmt: skip
            continue
        own = compression or max(
            bag.summary.packs, key=lambda name: bag.summary.packs[name].pieces, default="none"
        )
        _rewrite_one(bag, path, own, options)
        bag.close()
    return 0


def _rewrite_one(bag: BagReader, path: Path, compression: str, options: Values) -> None:
    target = Path(options.output_dir or path.parent) / path.name
    in_place = target.resolve() == path.resolve()
    backup = path.with_name(f"{path.stem}.orig{path.suffix}")
    if in_place and backup.exists() and not options.force:
        if not options.quiet:
            message = f"Skipping {path}. Backup path {backup} already exists."
            print(message, file=sys.stderr)
        return
    total = sum(pack.uncompressed for pack in bag.summary.packs.values())
    meter = None if options.quiet else ProgressMeter(str(target), total)
    part = target.with_name(f"{target.name}.part")
    done, diagnostics = [0], Diagnostics()

    def step(message: BagMessage) -> None:
        done[0] += len(message.data)
        if meter is not None:
            meter.step(min(done[0], total - 1))

    writer = create_bag(part, ROS1.name, compression=compression)
    copy_bag(bag, writer, diagnostics=diagnostics, progress=step)
    writer.close()
    if in_place:
        path.replace(backup)
    part.replace(target)
    if meter is not None:
        meter.finish()
    sys.stdout.flush()
    render(diagnostics)
