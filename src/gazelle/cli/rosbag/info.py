"""``rosbag info``."""

from __future__ import annotations

import sys

from gazelle.bag import BagError, open_bag
from gazelle.bag.opening import tell_of_unindexed
from gazelle.cli.rosbag.report import report_of, report_text, report_yaml, yaml_value
from gazelle.cli.tool import add_flag, option_parser

__all__ = ["run"]


def run(words: list[str]) -> int:
    """Print what is in bags, as text or YAML."""
    parser = option_parser("rosbag", "info [options] BAGFILE1 [BAGFILE2 BAGFILE3 ...]")
    add_flag(parser, "-y", "--yaml", dest="yaml", text="print information in YAML format")
    parser.add_option("-k", "--key", metavar="KEY", help="print information on the given key")
    add_flag(parser, "--freq", dest="freq", text="display topic message frequency statistics")
    options, args = parser.parse_args(words)
    if not args:
        parser.error("You must specify at least 1 bag file.")
    if options.key and not options.yaml:
        parser.error("You can only specify key when printing in YAML format.")
    for place, path in enumerate(args):
        try:
            _show(path, options.key, yaml=options.yaml, rates=options.freq)
        except BagError as error:
            print(f"ERROR reading {path}: {error}", file=sys.stderr)
            return 1
        if place < len(args) - 1:
            print("---")
    return 0


def _show(path: str, key: str | None, *, yaml: bool, rates: bool) -> None:
    bag = open_bag(path)
    report = report_of(bag, path, rates=rates)
    if not yaml:
        print(report_text(report))
    elif key:
        value = yaml_value(report, key)
        print(f'Error getting key "{key}"' if value is None else value)
    else:
        print(report_yaml(report))
    sys.stdout.flush()
    tell_of_unindexed(bag)
    bag.close()
