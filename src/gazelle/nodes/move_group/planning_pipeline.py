"""What plans the requests of a pipeline: the seam between move_group and planners.

A `PlanningPipeline` is a record of functions. OMPL's and Pilz' are two of them; other people's pip
packages add theirs by an entry point of group ``gazelle.planning_pipelines``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from gazelle.description.moveit import MoveItConfig, Pipeline
from gazelle.motion.model import JointGroup
from gazelle.motion.planning import PlannerSettings
from gazelle.motion.timing import Trajectory
from gazelle.nodes.move_group.planning_problem import GroupProblem

__all__ = ["Asked", "PlannerChoice", "PlanningJob", "PlanningPipeline", "SequenceJob", "as_named"]


class Asked(NamedTuple):
    """What a request asks of a pipeline, before anything is planned.

    Attributes:
        pipeline: its planners and parameters, as the robot's files have them.
        group: what is to move.
        planner: as the request has it, empty for the default one.
        changed: parameters that clients set, by group (or empty) and planner.
    """

    pipeline: Pipeline
    group: JointGroup
    planner: str = ""
    changed: Mapping[tuple[str, str], Mapping[str, str]] = {}


@dataclass(frozen=True)
class PlannerChoice:
    """What plans.

    Attributes:
        pipeline: its pipeline's name.
        planner: its name or id.
        plans: does it.
        settings: its parameters.
        adapters: of requests and responses.
        values: the pipeline's other parameters, such as ``resample_dt``.
        notes: what of the file is not honoured.
    """

    pipeline: str
    planner: str
    plans: PlanningPipeline
    settings: PlannerSettings = field(default_factory=PlannerSettings)
    adapters: tuple[str, ...] = ()
    values: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


class PlanningJob(NamedTuple):
    """One request.

    Attributes:
        config: the robot's.
        problem: group, start, kinematics and collisions.
        choice: what plans.
        request: the ``MotionPlanRequest``.
        seed: of all chance.
    """

    config: MoveItConfig
    problem: GroupProblem
    choice: PlannerChoice
    request: Any
    seed: int = 0


class SequenceJob(NamedTuple):
    """Requests of one group that run into each other.

    Attributes:
        config: the robot's.
        problem: where the first one starts.
        planners: the planner of each.
        requests: the ``MotionPlanRequest`` of each.
        radii_m: how early each may be left for the next.
    """

    config: MoveItConfig
    problem: GroupProblem
    planners: Sequence[str]
    requests: Sequence[Any]
    radii_m: Sequence[float]


@dataclass(frozen=True)
class PlanningPipeline:
    """A way to plan.

    Attributes:
        name: of the pipeline; a plug-in that has it in its name means this one, too.
        title: what ``query_planner_interface`` calls it.
        planner_ids: returns the planners that a request may name.
        choose: returns what plans a request.
        plan: returns the trajectory and notes on what was done otherwise than asked. Raises
            `MoveGroupError` or `PlanningError` with MoveIt's code and why where there is none.
        plan_sequence: plans requests that are blended into each other; None for a pipeline that
            cannot.
    """

    name: str
    title: str
    planner_ids: Callable[[Pipeline], Sequence[str]]
    choose: Callable[[PlanningPipeline, Asked], PlannerChoice]
    plan: Callable[[PlanningJob], tuple[Trajectory, tuple[str, ...]]]
    plan_sequence: Callable[[SequenceJob], Trajectory] | None = None

    def is_meant(self, pipeline: Pipeline) -> bool:
        """Tell whether a robot's files mean this pipeline."""
        return pipeline.name == self.name or any(self.name in one for one in pipeline.plugins)


def as_named(plans: PlanningPipeline, asked: Asked) -> PlannerChoice:
    """Return the planner that a request names, else the files' default, else the first there is."""
    pipeline = asked.pipeline
    name = asked.planner or pipeline.default_planner or next(iter(plans.planner_ids(pipeline)), "")
    adapters = (*pipeline.request_adapters, *pipeline.response_adapters)
    return PlannerChoice(pipeline.name, name, plans, adapters=adapters, values=pipeline.values)
