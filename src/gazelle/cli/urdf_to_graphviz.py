"""``urdf_to_graphviz FILE [OUTPUT]``: links, joints and origins as a drawing."""

from __future__ import annotations

import sys
from pathlib import Path

from gazelle.cli.graphviz import typeset
from gazelle.cli.urdf_file import (
    REFUSED,
    mappings_of,
    read_urdf_file,
    report_findings,
    robot_in,
)
from gazelle.description.urdfdom_emulation import EndlessTreeError, Robot, graphviz_text

__all__ = ["main"]

_USAGE = (
    "Usage: urdf_to_graphviz input.xml [OUTPUT]"
    "  Will create either $ROBOT_NAME.gv & $ROBOT_NAME.pdf in CWD  or OUTPUT.gv & OUTPUT.pdf."
)
_DEPRECATED = "WARNING: OUTPUT not given. This type of usage is deprecated!"


def main(argv: list[str]) -> int:
    """Write ``OUTPUT.gv`` and, with Graphviz's ``dot``, ``OUTPUT.pdf``.

    Returns:
        0 when urdfdom accepts the file, 255 when it does not or nothing could be written.
    """
    tokens, mappings = mappings_of(argv)
    if not 1 <= len(tokens) <= 2 or tokens[0] in {"-h", "--help"}:
        print(_USAGE, file=sys.stderr)
        return REFUSED
    if len(tokens) == 1:
        print(f"{_DEPRECATED}{_USAGE}", file=sys.stderr)
    file = read_urdf_file(tokens[0], mappings)
    robot = robot_in(file)
    output = tokens[1] if len(tokens) == 2 else ""
    code = REFUSED if robot is None else _draw(robot, output)
    report_findings(file)
    return code


def _draw(robot: Robot, output: str) -> int:
    # A name from the file must not lead out of the current folder.
    if not output and ("/" in robot.name or "\\" in robot.name or not robot.name):
        message = f"the robot's name '{robot.name}' is no file name; give OUTPUT"
        return _fail(message)
    output = output or robot.name
    source = Path(f"{output}.gv")
    try:
        source.write_text(graphviz_text(robot), encoding="utf-8")
    except EndlessTreeError as error:
        return _fail(str(error))
    except OSError as error:
        return _fail(f"cannot write '{source}': {error.strerror}")
    print(f"Created file {source}")
    if typeset(source, Path(f"{output}.pdf"), "urdf_to_graphviz"):
        print(f"Created file {output}.pdf")
    return 0


def _fail(message: str) -> int:
    print(f"urdf_to_graphviz: {message}", file=sys.stderr)
    return REFUSED
