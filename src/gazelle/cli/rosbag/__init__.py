"""``rosbag``: recording, playing and rewriting bags."""

from __future__ import annotations

from gazelle.cli.tool import Tool, run_tool

__all__ = ["main"]

_USAGE = """Usage: rosbag <subcommand> [options] [args]

A bag is a file format in ROS for storing ROS message data. The rosbag command can record, \
replay and manipulate bags.

Available subcommands:
   check  \tDetermine whether a bag is playable in the current system.
   compress  \tCompress one or more bag files.
   decompress  \tDecompress one or more bag files.
   filter  \tFilter the contents of the bag.
   fix  \tWrite a bag anew with the definitions of the current system.
   info  \tSummarize the contents of one or more bag files.
   play  \tPlay back the contents of one or more bag files in a time-synchronized fashion.
   record  \tRecord a bag file with the contents of specified topics.
   reindex  \tReindexes one or more bag files.

For additional information, see http://wiki.ros.org/rosbag
"""
_TOOL = Tool(
    "rosbag",
    {
        "check": "gazelle.cli.rosbag.check:check",
        "compress": "gazelle.cli.rosbag.compress:compress",
        "decompress": "gazelle.cli.rosbag.compress:decompress",
        "filter": "gazelle.cli.rosbag.filter:run",
        "fix": "gazelle.cli.rosbag.check:fix",
        "info": "gazelle.cli.rosbag.info:run",
        "play": "gazelle.cli.rosbag.play:run",
        "record": "gazelle.cli.rosbag.record:run",
        "reindex": "gazelle.cli.rosbag.compress:reindex",
    },
    _USAGE,
    0,
    takes_remappings=False,
)


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rosbag``."""
    return run_tool(_TOOL, argv)
