"""What SLAM can be told, and the numbers that no parameter of a node names: a record per algorithm.

The defaults fit buildings, robots that drive, and planar lidars. They belong together and were
chosen together: on the Intel Research Lab's log (`benchmarks/bench_slam.py`), on the public logs of
`benchmarks/soak/slam_logs.py` and on the buildings of tests/mapping. Who changes one runs these
again.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field

from gazelle.mapping.loop_detection.settings import (
    AgreementSettings,
    AmbiguitySettings,
    CandidateSettings,
    RecognitionSettings,
)
from gazelle.mapping.pose_graph.optimizer import GraphSettings
from gazelle.mapping.scan_matching.settings import FieldSettings, MatchSettings, SurfaceSettings

__all__ = [
    "EngineSettings",
    "FreeSpaceSettings",
    "GlobalRefinementSettings",
    "JumpSettings",
    "KeyframeSettings",
    "LoopClosureSettings",
    "OccupancySettings",
    "PoseSelectionSettings",
    "RelocationSettings",
    "SlamParameters",
    "SlamSettings",
    "TrackingSettings",
]


@dataclass(frozen=True, slots=True)
class EngineSettings:
    """What the engine does when.

    Attributes:
        give_up: after so many scans in a row that fit nowhere scans are kept by odometry alone.
        last_iterations: of the graph's optimisation at the end.
        global_refinements: how often all scans are matched with their neighbours then.
    """

    give_up: int = 4
    last_iterations: int = 20
    global_refinements: int = 2


@dataclass(frozen=True, slots=True)
class KeyframeSettings:
    """What is kept of a scan.

    Attributes:
        most_points: so many points are matched.
        margin_m: fields reach so much farther than what is matched in them.
        unseen_m: points so near to the end of sight are not matched: walls go on behind it, and
            what earlier scans did not see would pull every scan back to the last ones.
        unseen_share: or this share of the lidar's range where that is less.
    """

    most_points: int = 360
    margin_m: float = 2.0
    unseen_m: float = 0.7
    unseen_share: float = 0.2


@dataclass(frozen=True, slots=True)
class TrackingSettings:
    """How scans are matched with the last kept ones.

    Attributes:
        fewest_points: scans that meet less say nothing of where they are.
        still_m, still_rad: error of odometry at rest, standard deviation; a robot that moves less
            is looked for without a search.
        m_per_rad: further error of odometry's distance per turn.
        good_score: mean likelihood that is good whatever was usual.
        suspicious: a share of the usual mean likelihood below which the pose is looked for among
            all that was seen.
        usual_score: mean likelihood that is usual before anything was matched.
        usual_spread: and by how much it scatters.
        forget: weight of the last match in what is usual.
        sudden: a match that is worse by this than usual is doubtful,
        sudden_spreads: or by so many usual spreads where that is more.
        wide_m, wide_rad: half sides of the wide window, at least.
        left_m: a robot so far from its field's middle gets another field; a field reaches
            `field_margin_m` farther than beams do.
        field_margin_m: see there.
    """

    fewest_points: int = 20
    still_m: float = 0.05
    still_rad: float = 0.03
    m_per_rad: float = 0.02
    good_score: float = 0.6
    suspicious: float = 0.8
    usual_score: float = 0.8
    usual_spread: float = 0.1
    forget: float = 0.05
    sudden: float = 0.3
    sudden_spreads: float = 6.0
    wide_m: float = 1.0
    wide_rad: float = 1.2
    left_m: float = 1.5
    field_margin_m: float = 2.0


@dataclass(frozen=True, slots=True)
class RelocationSettings:
    """Where a lost robot is looked for.

    Attributes:
        reach_m: half side of the window at once.
        reach_m_per_scan: and so much more per scan that fitted nowhere.
        most_m: but no more than this.
        believed: share of the usual mean likelihood that is believed.
    """

    reach_m: float = 2.0
    reach_m_per_scan: float = 1.0
    most_m: float = 6.0
    believed: float = 0.85


@dataclass(frozen=True, slots=True)
class JumpSettings:
    """When a robot was carried away: odometry errs by less while a scan or two fit nowhere.

    Attributes:
        away_m, away_rad: a pose so far from odometry's is a jump.
        proving_points: so many points prove it, of several scans in a row where they are few: in
            the open there are always some that a few bushes fit.
        same_m, same_rad: these scans agree so well about where it went.
        near_m: a jump to so near a place of long ago is drift.
    """

    away_m: float = 1.0
    away_rad: float = 0.6
    proving_points: int = 500
    same_m: float = 0.5
    same_rad: float = 0.3
    near_m: float = 4.0


@dataclass(frozen=True, slots=True)
class PoseSelectionSettings:
    """What speaks for a pose and what against it.

    Attributes:
        nearest: scans that say what was seen around a pose.
        sector_rad: each sector of turns, about so wide, gives its best pose.
        least: mean likelihood in the coarse field below which a pose is not looked at.
        least_worth: worth below which little speaks for the best pose.
        clearly: the best pose's worth exceeds others' by this, or it is doubtful.
        apart_m, apart_rad: poses nearer than this are one.
        far_costs: what a pose at the edge of the window costs. Wheels slip seldom by so much
            within a step; what is new in a scan explains a bad fit more often.
        lost_costs: the same where odometry says little.
        most_edges: poses farther out, in half sides of the window, are none.
    """

    nearest: int = 80
    sector_rad: float = 0.3
    least: float = 0.2
    least_worth: float = 0.15
    clearly: float = 0.15
    apart_m: float = 0.3
    apart_rad: float = 0.15
    far_costs: float = 0.12
    lost_costs: float = 0.05
    most_edges: float = 1.5


@dataclass(frozen=True, slots=True)
class FreeSpaceSettings:
    """How free space is known.

    Attributes:
        cell_m: side of its cells.
        margin_m: beams may end so far in front of and behind what is known.
    """

    cell_m: float = 0.1
    margin_m: float = 0.3


@dataclass(frozen=True, slots=True)
class LoopClosureSettings:
    """When the map is moved so that places coincide.

    Attributes:
        step_m: after so long a way the robot looks around again.
        iterations: of the graph's optimisation.
        torn: squared standard deviations by which one sure step of the drive may be bent.
        sure_reach_m: in windows so small a place is recognised without the agreement of others.
    """

    step_m: float = 0.5
    iterations: int = 5
    torn: float = 60.0
    sure_reach_m: float = 1.0


@dataclass(frozen=True, slots=True)
class GlobalRefinementSettings:
    """How every kept scan is matched with all its neighbours at the end.

    Attributes:
        near_m: neighbours are nearer than this,
        near_scans: and so many.
        m_per_rad: a turn of them counts as so much distance.
        tied: so many of them a scan is tied to.
        reach_m, reach_rad: half sides of the window.
        sigma_m, sigma_rad: how far poses are off, standard deviation.
        least: mean likelihood below which a match is not believed.
        good: above which no wider window is looked at.
        wide_m, wide_rad: half sides of that.
        better: by so much its match must be better.
        stray_m, stray_rad: poses that move farther were wrong at the time.
        stray_weight: of their relations then.
        apart: neighbours that a scan is tied to are so many keyframes apart.
        iterations: of the graph's optimisation.
        huber: from how many standard deviations on a relation counts linearly.
    """

    near_m: float = 4.0
    near_scans: int = 20
    m_per_rad: float = 0.5
    tied: int = 3
    reach_m: float = 0.2
    reach_rad: float = 0.2
    sigma_m: float = 0.15
    sigma_rad: float = 0.1
    least: float = 0.5
    good: float = 0.8
    wide_m: float = 0.4
    wide_rad: float = 0.5
    better: float = 0.05
    stray_m: float = 0.15
    stray_rad: float = 0.06
    stray_weight: float = 0.01
    apart: int = 2
    iterations: int = 20
    huber: float = 1.0


@dataclass(frozen=True, slots=True)
class OccupancySettings:
    """How maps are drawn.

    Attributes:
        margin_m: of the map around what is seen.
        grow_m: a map that becomes too small grows by this.
        moved_cells: a map whose scans moved by more cells is drawn anew,
        moved_rad: or turned by more.
        tail: a cell in which fewer than this share of a neighbour's beams ended lies behind a wall.
    """

    margin_m: float = 1.0
    grow_m: float = 10.0
    moved_cells: float = 0.5
    moved_rad: float = 0.004
    tail: float = 0.1


@dataclass(frozen=True, slots=True)
class SlamSettings:
    """All of them.

    Attributes:
        engine, keyframes, tracking, relocation, jump, pose_selection, free_space, loop_closure,
            global_refinement, field, surface, match, places, recognition, ambiguity, agreement,
            graph: one algorithm each.
    """

    engine: EngineSettings = dataclasses.field(default_factory=EngineSettings)
    keyframes: KeyframeSettings = dataclasses.field(default_factory=KeyframeSettings)
    tracking: TrackingSettings = dataclasses.field(default_factory=TrackingSettings)
    relocation: RelocationSettings = dataclasses.field(default_factory=RelocationSettings)
    jump: JumpSettings = dataclasses.field(default_factory=JumpSettings)
    pose_selection: PoseSelectionSettings = dataclasses.field(default_factory=PoseSelectionSettings)
    free_space: FreeSpaceSettings = dataclasses.field(default_factory=FreeSpaceSettings)
    loop_closure: LoopClosureSettings = dataclasses.field(default_factory=LoopClosureSettings)
    global_refinement: GlobalRefinementSettings = dataclasses.field(
        default_factory=GlobalRefinementSettings
    )
    field: FieldSettings = dataclasses.field(default_factory=FieldSettings)
    surface: SurfaceSettings = dataclasses.field(default_factory=SurfaceSettings)
    match: MatchSettings = dataclasses.field(default_factory=MatchSettings)
    places: CandidateSettings = dataclasses.field(default_factory=CandidateSettings)
    recognition: RecognitionSettings = dataclasses.field(default_factory=RecognitionSettings)
    ambiguity: AmbiguitySettings = dataclasses.field(default_factory=AmbiguitySettings)
    agreement: AgreementSettings = dataclasses.field(default_factory=AgreementSettings)
    graph: GraphSettings = dataclasses.field(default_factory=GraphSettings)


@dataclass(frozen=True, slots=True)
class SlamParameters:
    """Parameters of SLAM.

    Attributes:
        cell_m: cells of likelihood fields.
        sigma_m: how far beams end from their surface, standard deviation.
        max_range_m: beams that are longer are not matched.
        keyframe_m, keyframe_rad: a scan is kept when the robot has moved or turned so far.
        submap_scans: scans are matched with so many kept ones.
        window_m, window_rad: the least half sides of the window around odometry's guess.
        odometry_m_per_m: error of odometry's distance, standard deviation per way.
        odometry_rad_per_rad: of its turn, per turn.
        odometry_rad_per_m: of its heading, per way.
        least_match: mean likelihood below which a match is not believed.
        loop_closing: whether places are recognised.
        least_loop: mean likelihood below which a place is not recognised.
        loop_reach_m: places are looked for within this distance at most.
        loop_gap_m: a place is seen again after at least so long a way.
        global_refinement: whether all scans are matched with their neighbours once more at the end.
        settings: numbers of the algorithms that hardly anybody needs to change.
    """

    cell_m: float = 0.05
    sigma_m: float = 0.07
    max_range_m: float = 20.0
    keyframe_m: float = 0.25
    keyframe_rad: float = 0.2
    submap_scans: int = 25
    window_m: float = 0.4
    window_rad: float = 0.4
    odometry_m_per_m: float = 0.1
    odometry_rad_per_rad: float = 0.15
    odometry_rad_per_m: float = 0.05
    least_match: float = 0.3
    loop_closing: bool = True
    least_loop: float = 0.6
    loop_reach_m: float = 18.0
    loop_gap_m: float = 10.0
    global_refinement: bool = True
    settings: SlamSettings = field(default_factory=SlamSettings)
