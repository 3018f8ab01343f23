"""Planner configurations of ``ompl_planning.yaml``."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from gazelle.description.moveit import Pipeline
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.motion.joint_space import JointSpace
from gazelle.motion.planning.ompl_planners import NATIVE_PARAMETERS, why_missing
from gazelle.motion.planning.planner_registry import DEFAULT, PLANNERS, bare_name, find_planner
from gazelle.motion.planning.problem import PlannerSettings

__all__ = ["PlannerConfig", "configured"]

_OF_EVERY = frozenset(
    {
        "longest_valid_segment_fraction",
        "maximum_waypoint_distance",
        "minimum_waypoint_count",
        "simplify_solutions",
    }
)
"""Parameters that mean something whichever planner runs."""
_OF_SOME = frozenset(name for one in PLANNERS.values() for name in one.parameters)

_AS_GAZELLE_DOES = {
    "type": (),
    "planner_configs": (),
    "default_planner_config": (),
    "enforce_joint_model_state_space": (),
    "interpolate": (),
    "optimization_objective": ("PathLengthOptimizationObjective",),
}
"""Parameters that ask for what is done anyway, with the values that do (none means all)."""

_KNOWN = frozenset(
    """
    hybridize max_hybrid_paths num_planners planners shortcut termination_condition
    multi_query_planning_enabled store_planner_data load_planner_data
    planner_data_path enforce_constrained_state_space
    constrained_planning_state_space frountier_node_ratio temp_change_factor min_temperature
    init_temperature frountier_threshold frountierNodeRatio frontier_threshold
    frontier_node_ratio k_constant cost_threshold cost_propagation max_states_failed
    degree max_degree min_degree max_pts_per_leaf estimated_dimension
    use_projected_distance stretch_factor sparse_delta_fraction dense_delta_fraction
    max_failures epsilon free_space_volume balanced optimality max_dist_near
    informed_sampling sample_rejection number_sampling_attempts
    use_admissible_heuristic tree_pruning prune_threshold pruned_measure
    focus_search new_state_rejection ordered_sampling ordering_batch_size
    max_num_goals intermediate_states maximum_planning_threads
    """.split()  # noqa: SIM905 - a list of fifty lines is harder to read
)
"""Parameters of OMPL's planners and of MoveIt that mean nothing to Gazelle's."""


@dataclass(frozen=True)
class PlannerConfig:
    """What a request's planner id stands for.

    Attributes:
        name: the configuration's name, as written.
        planner: the planner's MoveIt name, for `plan`.
        settings: its parameters.
    """

    name: str
    planner: str
    settings: PlannerSettings = field(default_factory=PlannerSettings)


def configured(
    pipeline: Pipeline,
    group: str,
    planner_id: str,
    space: JointSpace,
    diagnostics: Diagnostics,
    *,
    span: SourceSpan | None = None,
) -> PlannerConfig:
    """Return the planner and the parameters that a planner id means for a group.

    Args:
        pipeline: as ``ompl_planning.yaml`` describes it.
        group: the planning group.
        planner_id: of the request; empty for the group's default.
        space: the joints of the group.
        diagnostics: receives what is not honoured, parameter by parameter.
        span: where the pipeline was written.
    """
    own = pipeline.groups.get(group)
    default = (own.default_planner if own else "") or pipeline.default_planner
    name = planner_id.strip()
    if inner := re.fullmatch(r"[^\[\]]*\[([^\[\]]+)\]", name):
        name = inner[1]
    if name and name not in pipeline.planner_configs and find_planner(bare_name(name)) is None:
        known = [*pipeline.planner_configs, *PLANNERS]
        message = f"group '{group}' has no planner '{planner_id}'; "
        message += f"{default or DEFAULT} plans instead, as in MoveIt"
        fix = did_you_mean(name, known)
        diagnostics.report("motion.no-such-planner", message, span, fix=fix)
        name = ""
    name = name or default or DEFAULT
    values = dict(own.values) if own else {}
    values |= pipeline.planner_configs.get(name, {})
    planner = bare_name(str(values.get("type", "")) or name)
    reader = _Reader(name, planner, space, diagnostics, span)
    return PlannerConfig(name, planner, reader.settings(values))


class _Reader:
    def __init__(
        self,
        name: str,
        planner: str,
        space: JointSpace,
        diagnostics: Diagnostics,
        span: SourceSpan | None,
    ) -> None:
        self._name = name
        self._space = space
        self._diagnostics = diagnostics
        self._span = span
        entry = find_planner(planner)
        is_native = entry is not None and entry.own is None and not why_missing(planner)
        self._runs = planner if entry is None or entry.own or is_native else entry.stand_in
        runs = find_planner(self._runs)
        self._taken = frozenset() if runs is None else _OF_EVERY | set(runs.parameters)
        self._is_native = is_native
        self._settings = PlannerSettings()
        self._native: dict[str, float] = {}
        self._steps: list[float] = []

    def settings(self, values: Mapping[str, Any]) -> PlannerSettings:
        for key, value in values.items():
            if key in _AS_GAZELLE_DOES:
                self._check_usual(key, value)
            elif self._is_native and key in NATIVE_PARAMETERS:
                self._take_native(key, value)
            elif key in self._taken:
                self._take(key, value)
            elif key in _OF_EVERY | _OF_SOME or key in NATIVE_PARAMETERS or key in _KNOWN:
                self._without_effect(key)
            else:
                message = f"{self._place(key)} is a parameter that no planner has; it is ignored"
                known = sorted({*_OF_EVERY, *_OF_SOME, *NATIVE_PARAMETERS, *_KNOWN})
                fix = did_you_mean(key, known)
                self._diagnostics.report("motion.no-such-parameter", message, self._span, fix=fix)
        return replace(self._settings, native=self._native)

    def _take(self, key: str, value: Any) -> None:
        takers: dict[str, Callable[[], None]] = {
            "range": lambda: self._set("range", key, value, 0.0, math.inf),
            "goal_bias": lambda: self._set("goal_bias", key, value, 0.0, 1.0),
            "max_nearest_neighbors": lambda: self._whole(key, value, 1),
            "minimum_waypoint_count": lambda: self._whole(key, value, 2),
            "longest_valid_segment_fraction": lambda: self._step(key, value, self._space.extent),
            "maximum_waypoint_distance": lambda: self._step(key, value, 1.0),
            "simplify_solutions": lambda: self._simplify(key, value),
            "projection_evaluator": lambda: self._project(key, value),
        }
        takers.get(key, lambda: self._take_of_added(key, value))()

    def _set(self, field_name: str, key: str, value: Any, low: float, high: float) -> None:
        number = self._number(key, value, low, high)
        if number is not None:
            changes: dict[str, Any] = {field_name: number}
            self._settings = replace(self._settings, **changes)

    def _whole(self, key: str, value: Any, low: int) -> None:
        number = self._number(key, value, low, 1e6)
        if number is not None:
            changes: dict[str, Any] = {key: int(number)}
            self._settings = replace(self._settings, **changes)

    def _step(self, key: str, value: Any, scale: float) -> None:
        """Set the motion between two checks; MoveIt takes the finer of both parameters."""
        most = 1.0 if key.endswith("fraction") else math.inf
        number = self._number(key, value, 0.0, most)
        if number:
            self._steps.append(number * scale)
            self._settings = replace(self._settings, step=min(self._steps))

    def _simplify(self, key: str, value: Any) -> None:
        text = str(value).lower()
        if text in {"true", "false", "1", "0"}:
            self._settings = replace(self._settings, simplify=text in {"true", "1"})
        else:
            self._bad(key, value, "true or false")

    def _project(self, key: str, value: Any) -> None:
        found = re.fullmatch(r"joints\(([^()]*)\)", str(value).strip())
        if not found:
            self._bad(key, value, "joints(first, second) – links are not projected to")
            return
        names = [name.strip() for name in found[1].split(",") if name.strip()]
        unknown = [name for name in names if name not in self._space.names]
        if unknown or not names:
            wanted = f"joints of the group ({', '.join(self._space.names)})"
            self._bad(key, value, wanted)
            return
        places = tuple(self._space.names.index(name) for name in names)
        self._settings = replace(self._settings, projection=places)

    def _take_native(self, key: str, value: Any) -> None:
        kind = NATIVE_PARAMETERS[key][1]
        number = self._number(key, value, 0.0, math.inf)
        if number is not None:
            # OMPL's setters want the very type.
            self._native[key] = kind(number)

    def _take_of_added(self, key: str, value: Any) -> None:
        number = self._number(key, value, -math.inf, math.inf)
        if number is not None:
            self._native[key] = number

    def _check_usual(self, key: str, value: Any) -> None:
        usual = _AS_GAZELLE_DOES[key]
        if usual and str(value) not in usual:
            message = f"{self._place(key)} is {value}; paths are made short instead ({usual[0]})"
            self._diagnostics.report("motion.parameter-without-effect", message, self._span)

    def _without_effect(self, key: str) -> None:
        message = f"{self._place(key)} has no effect: {self._runs} has no such parameter here"
        self._diagnostics.report("motion.parameter-without-effect", message, self._span)

    def _number(self, key: str, value: Any, low: float, high: float) -> float | None:
        try:
            number = float(value)
        except (OverflowError, TypeError, ValueError):
            number = math.nan
        if low <= number <= high and math.isfinite(number):
            return number
        least = f" that is {low:g} at least" if math.isfinite(low) else ""
        most = f" and {high:g} at most" if math.isfinite(high) else ""
        self._bad(key, value, f"a number{least}{most}")
        return None

    def _bad(self, key: str, value: Any, wanted: str) -> None:
        message = f"{self._place(key)} is {value!r}; it has to be {wanted}; the default is used"
        self._diagnostics.report("motion.bad-parameter", message, self._span)

    def _place(self, key: str) -> str:
        return f"'{key}' of planner configuration '{self._name}'"
