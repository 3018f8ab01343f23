"""Which planning pipeline a request means: MoveIt's two, and those of other people's packages."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from gazelle.description.moveit import MoveItConfig, Pipeline
from gazelle.diagnostics import did_you_mean
from gazelle.extensions import ExtensionGroup, load_extensions
from gazelle.motion.model import JointGroup
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.ompl_pipeline import OMPL
from gazelle.nodes.move_group.pilz_pipeline import PILZ
from gazelle.nodes.move_group.planning_pipeline import Asked, PlannerChoice, PlanningPipeline

__all__ = ["choose_planner", "pipeline_of", "planning_pipeline"]

_OWN = (PILZ, OMPL)


def pipeline_of(config: MoveItConfig, name: str) -> Pipeline:
    """Return a pipeline of the robot's files, the default one for an empty name.

    Raises:
        MoveGroupError: there is none of this name.
    """
    wanted = name or config.default_pipeline
    found = config.pipelines.get(wanted)
    if found is None and not name:
        return next(iter(config.pipelines.values()), Pipeline(OMPL.name))
    if found is None:
        hint = did_you_mean(name, config.pipelines)
        text = f"No planning pipeline available for name '{name}'; {hint}"
        raise MoveGroupError(ErrorCode.FAILURE, text)
    return found


def planning_pipeline(pipeline: Pipeline) -> tuple[PlanningPipeline, tuple[str, ...]]:
    """Return what plans for a pipeline of the robot's files.

    Returns:
        OMPL's where nobody has the planner that is meant, and why others' packages do not.
    """
    own = next((one for one in _OWN if one.is_meant(pipeline)), None)
    if own is not None:
        return own, ()
    added = load_extensions(ExtensionGroup.PIPELINES, PlanningPipeline)
    meant = (one.part for one in added.parts if one.part.is_meant(pipeline))
    found = next(meant, None)
    return (found, ()) if found is not None else (OMPL, added.problems)


def choose_planner(
    config: MoveItConfig,
    group: JointGroup,
    *,
    pipeline: str,
    planner: str,
    changed: Mapping[tuple[str, str], Mapping[str, str]] | None = None,
) -> PlannerChoice:
    """Return the planner for a request.

    Args:
        config: the robot's.
        group: what moves.
        pipeline: as the request has it, empty for the default one.
        planner: as the request has it, empty for the group's default one.
        changed: parameters that clients set, by group (or empty) and planner.

    Raises:
        MoveGroupError: there is no such pipeline.
    """
    found = pipeline_of(config, pipeline)
    plans, problems = planning_pipeline(found)
    choice = plans.choose(plans, Asked(found, group, planner, changed or {}))
    return replace(choice, notes=(*problems, *choice.notes)) if problems else choice
