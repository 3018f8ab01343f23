"""``rosbag compress``, ``decompress`` and ``reindex``: bags in place of themselves."""

from __future__ import annotations

import sys
from optparse import OptionParser, Values
from pathlib import Path

from gazelle.bag import BagMessage, BagReader, create_bag, open_bag
from gazelle.bag.conversion import copy_bag
from gazelle.bag.formats import ROS1
from gazelle.cli.rosbag.progress import ProgressMeter
from gazelle.cli.tool import add_flag, option_parser
from gazelle.diagnostics import Diagnostics, render

__all__ = ["compress", "decompress", "reindex"]


def compress(words: list[str]) -> int:
    """Write bags with compressed chunks; what they were stays as ``NAME.orig.bag``."""
    parser = _parser("compress")
    add_flag(parser, "-j", "--bz2", dest="bz2", text="use BZ2 compression")
    add_flag(parser, "--lz4", dest="lz4", text="use lz4 compression")
    options, args = _arguments(parser, words)
    if options.bz2 and options.lz4:
        parser.error("Can specify only one compression format.")
    return _rewrite(args, options, "lz4" if options.lz4 else "bz2")


def decompress(words: list[str]) -> int:
    """Write bags without compression; what they were stays as ``NAME.orig.bag``."""
    options, args = _arguments(_parser("decompress"), words)
    return _rewrite(args, options, "none")


def reindex(words: list[str]) -> int:
    """Write bags with an index that were not closed; what they were stays as ``NAME.orig.bag``."""
    options, args = _arguments(_parser("reindex"), words)
    return _rewrite(args, options, "")


def _parser(command: str) -> OptionParser:
    parser = option_parser("rosbag", f"{command} [options] BAGFILE1 [BAGFILE2 ...]")
    parser.add_option("--output-dir", metavar="DIR", help="write to directory DIR")
    add_flag(
        parser, "-f", "--force", dest="force", text="force overwriting of backup file if it exists"
    )
    add_flag(parser, "-q", "--quiet", dest="quiet", text="suppress noncritical messages")
    return parser


def _arguments(parser: OptionParser, words: list[str]) -> tuple[Values, list[str]]:
    options, args = parser.parse_args(words)
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
