"""Which planner a request means, with the parameters that ``ompl_planning.yaml`` gives it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from gazelle.description.moveit import MoveItConfig, Pipeline
from gazelle.diagnostics import Diagnostic, Diagnostics, did_you_mean
from gazelle.motion.planning import PlannerSettings, configured
from gazelle.motion.planning.planners import DEFAULT
from gazelle.motion.space import JointSpace
from gazelle.nodes.move_group.error_codes import ErrorCode, MoveGroupError

__all__ = ["PILZ", "PlannerChoice", "choose_planner", "pipeline_of"]

_ELSEWHERE = frozenset({"chomp", "stomp"})
PILZ = "pilz_industrial_motion_planner"
"""Name of the pipeline of PTP, LIN and CIRC, which its plug-ins have in their names too."""


@dataclass(frozen=True)
class PlannerChoice:
    """What plans.

    Attributes:
        pipeline: its pipeline's name.
        planner: its name or id.
        is_pilz: it is one of Pilz' planners.
        settings: its parameters.
        adapters: of requests and responses.
        values: the pipeline's other parameters, such as ``resample_dt``.
        notes: what of the file is not honoured.
    """

    pipeline: str
    planner: str
    is_pilz: bool = False
    settings: PlannerSettings = field(default_factory=PlannerSettings)
    adapters: tuple[str, ...] = ()
    values: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def pipeline_of(config: MoveItConfig, name: str) -> Pipeline:
    """Return a pipeline, the default one for an empty name.

    Raises:
        MoveGroupError: there is none of this name.
    """
    wanted = name or config.default_pipeline
    found = config.pipelines.get(wanted)
    if found is None and not name:
        return next(iter(config.pipelines.values()), Pipeline("ompl"))
    if found is None:
        hint = did_you_mean(name, config.pipelines)
        text = f"No planning pipeline available for name '{name}'; {hint}"
        raise MoveGroupError(ErrorCode.FAILURE, text)
    return found


def choose_planner(
    config: MoveItConfig,
    space: JointSpace,
    *,
    group: str,
    pipeline: str,
    planner: str,
    changed: Mapping[tuple[str, str], Mapping[str, str]] | None = None,
) -> PlannerChoice:
    """Return the planner for a request.

    Args:
        config: the robot's.
        space: of the group; its extent turns fractions into steps.
        group: name of the group.
        pipeline: as the request has it, empty for the default one.
        planner: as the request has it, empty for the group's default one.
        changed: parameters that clients set, by group (or empty) and planner.

    Raises:
        MoveGroupError: there is no such pipeline.
    """
    found = pipeline_of(config, pipeline)
    adapters = (*found.request_adapters, *found.response_adapters)
    if found.name == PILZ or any(PILZ in plugin for plugin in found.plugins):
        name = planner or found.default_planner or "PTP"
        return PlannerChoice(found.name, name, is_pilz=True, adapters=adapters, values=found.values)
    diagnostics, foreign = Diagnostics(), _foreign(found)
    if foreign:
        # Its planners' names mean nothing to those of OMPL.
        found, planner = replace(found, planner_configs={}, groups={}), ""
    chosen = configured(_with(found, group, changed or {}), group, planner, space, diagnostics)
    notes = (*foreign, *(_told(finding) for finding in diagnostics))
    return PlannerChoice(
        found.name,
        chosen.planner,
        settings=chosen.settings,
        adapters=adapters,
        values=found.values,
        notes=notes,
    )


def _foreign(pipeline: Pipeline) -> tuple[str, ...]:
    """Say who plans in place of a plug-in that is neither OMPL's nor Pilz'."""
    known = [one for one in pipeline.plugins if "ompl" in one.lower()]
    name = next(iter(pipeline.plugins), "")
    if known or not (name or pipeline.name in _ELSEWHERE):
        return ()
    what = f"planning plug-in '{name}'" if name else "planner"
    text = f"the {what} of pipeline '{pipeline.name}' is not here; {DEFAULT} plans instead "
    return (f"{text}(there are the pipelines of OMPL and of Pilz: PTP, LIN and CIRC)",)


def _with(
    pipeline: Pipeline, group: str, changed: Mapping[tuple[str, str], Mapping[str, str]]
) -> Pipeline:
    """Lay what clients set over the file's parameters, that of the group last."""
    configs = {name: dict(values) for name, values in pipeline.planner_configs.items()}
    for owner in ("", group):
        for (of_group, name), values in changed.items():
            if of_group == owner:
                configs.setdefault(name, {}).update(values)
    return replace(pipeline, planner_configs=configs)


def _told(finding: Diagnostic) -> str:
    return f"{finding.message}{f'; {finding.fix}' if finding.fix else ''} [{finding.code}]"
