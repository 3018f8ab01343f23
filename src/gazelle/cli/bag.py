"""``gazelle bag convert`` and ``gazelle bag export``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from gazelle.bag import BagError, BagReader, create_bag, open_bag, storage_of
from gazelle.bag.conversion import copy_bag
from gazelle.bag.export import FORMATS, export_bag
from gazelle.bag.formats import MCAP, OWN_FORMATS, storage_names
from gazelle.bag.open_bag import warn_of_unindexed
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.diagnostics import Diagnostics, render

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run ``gazelle bag convert`` or ``gazelle bag export``."""
    options = _parser().parse_args(argv)
    learn_workspace_types()
    return _convert(options) if options.verb == "convert" else _export(options)


def _convert(options: argparse.Namespace) -> int:
    source, target = Path(options.input), Path(options.output)
    if target.exists():
        raise BagError(f"{target} is there already")
    storage = options.storage or storage_of(target) or MCAP.name
    bag, diagnostics = open_bag(source), Diagnostics()
    writer = create_bag(target, storage, compression=options.compression)
    topics = {f"/{topic.lstrip('/')}" for topic in options.topics}
    try:
        copied = copy_bag(
            bag,
            writer,
            diagnostics=diagnostics,
            wanted=lambda message: not topics or message.connection.topic in topics,
        )
    finally:
        writer.close()
    print(f"{target}: {copied.written} messages ({storage})")
    return _end(bag, diagnostics)


def _export(options: argparse.Namespace) -> int:
    bag, diagnostics = open_bag(options.input), Diagnostics()
    folder = Path(options.output or f"{Path(options.input).stem}_{options.to}")
    topics = [f"/{topic.lstrip('/')}" for topic in options.topics]
    files = export_bag(
        bag, folder, options.to, topics=topics, rate_hz=options.rate, diagnostics=diagnostics
    )
    shown = files if len(files) <= 20 else [*files[:3], Path("…"), *files[-1:]]
    print("\n".join(map(str, shown)))
    return _end(bag, diagnostics)


def _end(bag: BagReader, diagnostics: Diagnostics) -> int:
    sys.stdout.flush()
    warn_of_unindexed(bag)
    render(diagnostics)
    return 0


def _parser() -> argparse.ArgumentParser:
    about = "convert bags between ROS 1 and rosbag2, and export them"
    parser = argparse.ArgumentParser(prog="gazelle bag", description=about)
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="{convert,export}")
    convert = verbs.add_parser("convert", help="write a bag in another format")
    export = verbs.add_parser("export", help="write the messages into files of other programs")
    suffixes = [one.suffix for one in OWN_FORMATS]
    for verb in (convert, export):
        verb.add_argument(
            "input", metavar="IN", help=f"{', '.join(suffixes)} or a folder of rosbag2"
        )
        verb.add_argument("--topics", nargs="+", default=[], help="only these topics")
    text = ", ".join((*(f"NAME{one}" for one in suffixes), "or a folder of rosbag2"))
    convert.add_argument("output", metavar="OUT", help=text)
    convert.add_argument(
        "--storage", choices=storage_names(), help="the format, where OUT does not tell it"
    )
    packed = [one for one in OWN_FORMATS if one.compressions]
    text = ", ".join(f"{' or '.join(one.compressions)} ({one.suffix})" for one in packed)
    names = sorted({name for one in packed for name in one.compressions})
    convert.add_argument("--compression", default="", choices=names, help=text)
    export.add_argument("--to", required=True, choices=FORMATS, help="the format")
    export.add_argument("-o", "--output", metavar="DIR", help="folder for the files")
    text = "pictures a second of a film; the median of the recording by default"
    export.add_argument("--rate", type=float, default=0.0, metavar="HZ", help=text)
    return parser
