"""``rosparam``: the parameters."""

from __future__ import annotations

from gazelle.cli.tool import Tool, run_tool

__all__ = ["main"]

_USAGE = """rosparam is a command-line tool for getting, setting, and deleting parameters from the \
ROS Parameter Server.

Commands:
\trosparam set\tset parameter
\trosparam get\tget parameter
\trosparam load\tload parameters from file
\trosparam dump\tdump parameters to file
\trosparam delete\tdelete parameter
\trosparam list\tlist parameter names
"""
_TOOL = Tool(
    "rosparam",
    {
        "delete": "gazelle.cli.rosparam.writing:delete",
        "dump": "gazelle.cli.rosparam.reading:dump",
        "get": "gazelle.cli.rosparam.reading:get",
        "list": "gazelle.cli.rosparam.reading:listing",
        "load": "gazelle.cli.rosparam.writing:load",
        "set": "gazelle.cli.rosparam.writing:set_value",
    },
    _USAGE,
    usage_code=0,
    takes_remappings=False,
)


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rosparam``."""
    return run_tool(_TOOL, argv)
