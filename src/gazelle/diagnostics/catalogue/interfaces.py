"""Codes of message, service and action definitions."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "interfaces.unreadable",
        "error",
        "A definition file cannot be read",
        "The file system refuses it, so the types it defines cannot be used.",
        "check the file's permissions",
        "Unable to load msg",
    ),
    Entry(
        "interfaces.bad-line",
        "error",
        "A line of a definition is neither a field nor a constant",
        "A line is `type name`, `type name default` (ROS 2) or `type NAME=value`.",
        "write `type name` or `type NAME=value`",
        "Invalid declaration",
    ),
    Entry(
        "interfaces.bad-name",
        "error",
        "A field or constant has a name that is not allowed",
        "Names start with a letter and consist of letters, digits and underscores.",
        "rename it",
        "is not a legal message field name",
    ),
    Entry(
        "interfaces.bad-type",
        "error",
        "A type is not written as a type",
        "Types are primitives or `package/Name`, with `[]`, `[N]` or `[<=N]` behind them.",
        "correct the type",
        "is not a legal message type",
    ),
    Entry(
        "interfaces.unknown-type",
        "error",
        "A field's message type is not known",
        "The message cannot be read or written without it.",
        "correct the name, or put the package that defines it into the workspace",
        "Cannot locate message",
    ),
    Entry(
        "interfaces.bad-value",
        "error",
        "A constant's or default's value does not fit its type",
        "Values are plain numbers, true or false, or text; integers must be in range.",
        "write a value of the type, in range",
        "cannot convert value",
    ),
    Entry(
        "interfaces.repeated-name",
        "error",
        "Two fields or constants have the same name",
        "The second one could never be reached.",
        "rename one of the two",
        "Duplicate field names",
    ),
    Entry(
        "interfaces.missing-separator",
        "error",
        "A service or action has the wrong number of `---` lines",
        "A service has one `---` (request, response), an action two (goal, result, feedback).",
        "separate the parts by lines of `---`",
        "could not find '---' separator",
    ),
    Entry(
        "interfaces.recursive-type",
        "error",
        "A message contains itself",
        "Such a message would have no end.",
        "remove the field that closes the circle",
        "recursive message definition",
    ),
    Entry(
        "interfaces.config-program",
        "error",
        "A .cfg file of dynamic_reconfigure fails",
        "Such a file is a Python program that says which parameters there are; it ended early.",
        "correct the file at the place shown",
        "add_custom_command failed",
    ),
    Entry(
        "interfaces.parameter-file",
        "error",
        "A parameter file of generate_parameter_library cannot be read",
        "It has one outermost key and below it groups and parameters, each with its type.",
        "correct the entry at the place shown",
        "generate_parameter_library_cpp failed",
    ),
)
