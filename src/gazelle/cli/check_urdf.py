"""``check_urdf FILE``: urdfdom's verdict and tree, and all that urdfdom does not see."""

from __future__ import annotations

import sys

from gazelle.cli.urdf_file import (
    REFUSED,
    mappings_of,
    read_urdf_file,
    report_findings,
    robot_in,
)
from gazelle.description.urdfdom_emulation import EndlessTreeError, tree_text

__all__ = ["main"]

_USAGE = """usage: check_urdf FILE [name:=value ...]
  FILE: a URDF or xacro file, also as package://PACKAGE/FILE; the values are for xacro."""


def main(argv: list[str]) -> int:
    """Print the tree of a robot.

    Returns:
        0 when urdfdom accepts the file, 255 when it does not; our findings change neither.
    """
    tokens, mappings = mappings_of(argv)
    if not tokens:
        print("Expect URDF xml file to parse", file=sys.stderr)
        return REFUSED
    if tokens[0] in {"-h", "--help"}:
        print(_USAGE, file=sys.stderr)
        return REFUSED
    file = read_urdf_file(tokens[0], mappings)
    robot = robot_in(file)
    code = REFUSED
    if robot is not None:
        try:
            sys.stdout.write(tree_text(robot))
            code = 0
        except EndlessTreeError as error:
            print(f"check_urdf: {error}", file=sys.stderr)
    report_findings(file)
    return code
