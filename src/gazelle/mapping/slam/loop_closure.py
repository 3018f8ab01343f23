"""Moving the map so that places seen again coincide."""

from __future__ import annotations

import numpy as np

from gazelle.mapping.loops.candidates import places_near
from gazelle.mapping.loops.detection import recognise
from gazelle.mapping.loops.hypotheses import Hypotheses, Hypothesis
from gazelle.mapping.pose_graph.constraints import Edges
from gazelle.mapping.pose_graph.information import doubtful
from gazelle.mapping.pose_graph.optimise import optimise, residuals
from gazelle.mapping.poses import Poses
from gazelle.mapping.slam.keyframes import Keyframes
from gazelle.mapping.slam.parameters import SlamParameters

__all__ = ["LoopCloser"]


class LoopCloser:
    """Recognises places and ties them together.

    Attributes:
        closed: how many loop closures hold.
        refused: how many were found that would have torn the map.
    """

    def __init__(self, keyframes: Keyframes, parameters: SlamParameters) -> None:
        """Look among keyframes."""
        self.closed = 0
        self.refused = 0
        self._keyframes = keyframes
        self._parameters = parameters
        self._settings = parameters.settings
        self._hypotheses = Hypotheses(self._settings.agreement)
        self._looked_m = 0.0

    def close(self, edges: Edges) -> Edges | None:
        """Look around the last keyframe; move the map and return new edges if it is known there."""
        way_m = self._keyframes[-1].way_m
        if way_m - self._looked_m < self._settings.closing.step_m:
            return None
        self._looked_m = way_m
        believed = self._believed(edges)
        if not believed:
            return None
        tied = edges
        for one in believed:
            tied = tied.with_edge(one.tail, one.head, one.relative, one.information, is_loop=True)
        told = self._settings.closing
        poses = optimise(
            self._keyframes.poses, tied, iterations=told.iterations, settings=self._settings.graph
        )
        sure = ~tied.is_loop & ~doubtful(tied.information)
        bent = residuals(poses, tied).squared[sure]
        if bent.max(initial=0.0) > told.torn:
            self.refused += len(believed)
            return None
        self.closed += len(believed)
        self._keyframes.poses = poses
        return tied

    def has_drifted(self, pose: Poses, jump_m: float) -> bool:
        """Tell whether the robot was near a pose so long ago that drift explains a jump to it.

        The pose is (3,) in the map: x, y (m) and yaw (rad).
        """
        poses, ways = self._keyframes.poses, self._keyframes.ways_m
        gap_m = max(self._parameters.loop_gap_m, jump_m / self._settings.places.drift_m_per_m)
        old = ways[-1] - ways > gap_m
        far = np.hypot(*(poses[old, :2] - pose[:2]).T)
        return bool(far.min(initial=np.inf) < self._settings.jump.near_m)

    def _believed(self, edges: Edges) -> list[Hypothesis]:
        told, poses = self._parameters, self._keyframes.poses
        believed: list[Hypothesis] = []
        places = places_near(
            poses,
            edges,
            gap_m=told.loop_gap_m,
            reach_m=told.loop_reach_m,
            settings=self._settings.places,
        )
        for place in places:
            found = recognise(self._keyframes, place, told)
            if found is None:
                continue
            if found.reach_m <= self._settings.closing.sure_reach_m:
                believed.append(found)
            else:
                believed += self._hypotheses.agree(found, poses, self._keyframes.ways_m)
        return believed
