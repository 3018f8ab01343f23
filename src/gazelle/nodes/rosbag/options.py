"""Options as rosbag takes them."""

from __future__ import annotations

from optparse import OptionParser

__all__ = ["add_flag", "option_parser"]


def option_parser(usage: str) -> OptionParser:
    """Return a parser that talks as rosbag's does."""
    return OptionParser(usage=f"usage: %prog {usage}", prog="rosbag")


def add_flag(parser: OptionParser, *names: str, dest: str, text: str) -> None:
    """Add an option without a value; it is False when it is not given."""
    parser.add_option(*names, dest=dest, action="store_true", default=False, help=text)
