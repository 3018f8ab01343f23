"""``rostopic``: what is on the topics."""

from __future__ import annotations

from gazelle.cli.ros_tool import Tool, run_tool

__all__ = ["main"]

_USAGE = """rostopic is a command-line tool for printing information about ROS Topics.

Commands:
\trostopic bw\tdisplay bandwidth used by topic
\trostopic delay\tdisplay delay of topic from timestamp in header
\trostopic echo\tprint messages to screen
\trostopic find\tfind topics by type
\trostopic hz\tdisplay publishing rate of topic
\trostopic info\tprint information about active topic
\trostopic list\tlist active topics
\trostopic pub\tpublish data to topic
\trostopic type\tprint topic or field type

Type rostopic <command> -h for more detailed usage, e.g. 'rostopic echo -h'
"""
_TOOL = Tool(
    "rostopic",
    {
        "bw": "gazelle.cli.rostopic.bw:run",
        "delay": "gazelle.cli.rostopic.delay:run",
        "echo": "gazelle.cli.rostopic.echo:run",
        "find": "gazelle.cli.rostopic.list:find",
        "hz": "gazelle.cli.rostopic.hz:run",
        "info": "gazelle.cli.rostopic.list:info",
        "list": "gazelle.cli.rostopic.list:run",
        "pub": "gazelle.cli.rostopic.pub:run",
        "type": "gazelle.cli.rostopic.list:show_type",
    },
    _USAGE,
)


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rostopic``."""
    return run_tool(_TOOL, argv)
