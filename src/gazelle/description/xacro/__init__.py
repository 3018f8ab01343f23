"""xacro files: expanded by the official library, with places for every element and error."""

from __future__ import annotations

from gazelle.description.xacro.command_line import (
    XacroCommand,
    parse_xacro_arguments,
    read_xacro_arguments,
)
from gazelle.description.xacro.expander import Expanded, expand_xacro

__all__ = [
    "Expanded",
    "XacroCommand",
    "expand_xacro",
    "parse_xacro_arguments",
    "read_xacro_arguments",
]
