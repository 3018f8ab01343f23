"""``rosservice``: which services there are, and calling them."""

from __future__ import annotations

from gazelle.cli.tool import Tool, run_tool

__all__ = ["main"]

_USAGE = """Commands:
\trosservice args\tprint service arguments
\trosservice call\tcall the service with the provided args
\trosservice find\tfind services by service type
\trosservice info\tprint information about service
\trosservice list\tlist active services
\trosservice type\tprint service type
\trosservice uri\tprint service ROSRPC uri

Type rosservice <command> -h for more detailed usage, e.g. 'rosservice call -h'
"""
_TOOL = Tool(
    "rosservice",
    {
        "args": "gazelle.cli.rosservice.info:args",
        "call": "gazelle.cli.rosservice.call:run",
        "find": "gazelle.cli.rosservice.listing:find",
        "info": "gazelle.cli.rosservice.info:info",
        "list": "gazelle.cli.rosservice.listing:run",
        "node": "gazelle.cli.rosservice.info:node",
        "type": "gazelle.cli.rosservice.info:show_type",
        "uri": "gazelle.cli.rosservice.info:uri",
    },
    _USAGE,
)


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rosservice``."""
    return run_tool(_TOOL, argv)
