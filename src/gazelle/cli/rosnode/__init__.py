"""``rosnode``: which nodes there are, what they do, and their end."""

from __future__ import annotations

from gazelle.cli.tool import Tool, run_tool

__all__ = ["main"]

_USAGE = """rosnode is a command-line tool for printing information about ROS Nodes.

Commands:
\trosnode ping\ttest connectivity to node
\trosnode list\tlist active nodes
\trosnode info\tprint information about node
\trosnode machine\tlist nodes running on a particular machine or list machines
\trosnode kill\tkill a running node
\trosnode cleanup\tpurge registration information of unreachable nodes

Type rosnode <command> -h for more detailed usage, e.g. 'rosnode ping -h'
"""
_TOOL = Tool(
    "rosnode",
    {
        "cleanup": "gazelle.cli.rosnode.ping:cleanup",
        "info": "gazelle.cli.rosnode.info:run",
        "kill": "gazelle.cli.rosnode.kill:run",
        "list": "gazelle.cli.rosnode.listing:run",
        "machine": "gazelle.cli.rosnode.listing:machine",
        "ping": "gazelle.cli.rosnode.ping:run",
    },
    _USAGE,
)


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rosnode``."""
    return run_tool(_TOOL, argv)
