"""Codes of planner configurations."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "motion.no-such-parameter",
        "warning",
        "A planner configuration has a parameter that no planner knows",
        "OMPL prints a line that nobody sees and goes on without it.",
        "correct the name in ompl_planning.yaml, or remove the line",
        "Parameter was not found",
    ),
    Entry(
        "motion.bad-parameter",
        "warning",
        "A parameter of a planner has a value that it cannot have",
        "The planner goes on with its default.",
        "correct the value in ompl_planning.yaml",
        "Unable to convert parameter",
    ),
    Entry(
        "motion.parameter-without-effect",
        "info",
        "A parameter means nothing to the planner that is used",
        "It belongs to another planner, or to one of OMPL that another one stands in for.",
        "nothing has to be done",
        "ompl_planning.yaml",
        idle=True,
    ),
    Entry(
        "motion.no-such-planner",
        "warning",
        "A planner is asked for that does not exist",
        "MoveIt plans with the default of the group then, and so does Gazelle.",
        "name one of the planner_configs of ompl_planning.yaml",
        "Cannot find planning configuration for group",
    ),
)
