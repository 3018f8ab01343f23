"""Codes of xacro; phrases are those of the official program."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "xacro.undefined-name",
        "error",
        "An expression uses a name that is not defined",
        "Properties are seen in the macro that defines them and below, in the order of the file.",
        "define the property above its use, or correct its name",
        "name is not defined when evaluating expression",
    ),
    Entry(
        "xacro.bad-expression",
        "error",
        "An expression cannot be evaluated",
        "What stands in ${…} is Python with a small choice of functions.",
        "correct the expression",
        "when evaluating expression",
    ),
    Entry(
        "xacro.argument-missing",
        "error",
        "An argument has no value",
        "$(arg name) needs a value from the command line or a default.",
        "pass name:=value or give <xacro:arg> a default",
        "Undefined substitution argument",
    ),
    Entry(
        "xacro.package-missing",
        "error",
        "A package is not known",
        "$(find pkg) looks in the workspace and among the built-in packages.",
        "correct the name, or source the workspace that has the package",
        "package not found",
    ),
    Entry(
        "xacro.include-left-out",
        "warning",
        "An include of a file in a missing package is left out",
        "Robots include macros of sensors and mounts they may carry. Where none of them is used, "
        "nothing is lost; where one is used, xacro.unknown-macro follows.",
        "put the package's source folder into the workspace",
        "package not found",
    ),
    Entry(
        "xacro.file-missing",
        "error",
        "A file cannot be read",
        "The file itself, an included one or a YAML file does not exist.",
        "correct the path; relative ones start from the including file's folder",
        "No such file or directory",
    ),
    Entry(
        "xacro.unknown-macro",
        "error",
        "A macro is not defined",
        "Macros are known below their definition or include.",
        "include the file that defines it, or correct the name",
        "unknown macro name",
    ),
    Entry(
        "xacro.recursion",
        "error",
        "Macros call each other without end",
        "Expansion was stopped.",
        "end the recursion with <xacro:if>",
        "maximum recursion depth exceeded",
    ),
    Entry(
        "xacro.failed",
        "error",
        "xacro cannot expand the file",
        "The message is xacro's own.",
        "correct the element shown",
    ),
    Entry(
        "xacro.warning",
        "warning",
        "xacro warns",
        "The message is xacro's own; the file is expanded all the same.",
        "see the message",
        "warning:",
    ),
    Entry(
        "xacro.message",
        "info",
        "A xacro file prints a message",
        "The file calls xacro.message or a part of it does.",
        "nothing to do",
    ),
)
