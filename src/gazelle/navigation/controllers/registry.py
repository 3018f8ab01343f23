"""Which controller a name in a parameter file means."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from typing import Any

from gazelle.navigation.controllers.controller import Controller
from gazelle.navigation.controllers.dwa_dwb_controller import SamplingController
from gazelle.navigation.controllers.dwa_dwb_parameters import (
    DwaOptions,
    DwbOptions,
    TrajectoryPlannerOptions,
    dwa_profile,
    dwb_profile,
)
from gazelle.navigation.controllers.escape_maneuver import Maneuvering, Pace
from gazelle.navigation.controllers.mppi import MppiController, MppiOptions
from gazelle.navigation.controllers.regulated_pure_pursuit import PursuitController, PursuitOptions
from gazelle.navigation.controllers.trajectory_planner import TrajectoryPlanner

__all__ = ["CONTROLLERS", "REFUSED_CONTROLLERS", "ControllerKind", "ControllerSetting"]

_MANEUVER_M_S, _MANEUVER_RAD_S, _MIN_SPEED_RAD_S = 0.2, 0.6, 0.1
# TrajectoryPlannerROS had these up to ROS Lunar.
_OLD_NAMES = frozenset({"gdist_scale", "pdist_scale"})
ControllerOptions = (
    DwaOptions | DwbOptions | MppiOptions | PursuitOptions | TrajectoryPlannerOptions
)


@dataclass(frozen=True, slots=True)
class ControllerSetting:
    """What a controller is told besides its own parameters.

    Attributes:
        period_s: between two velocity commands.
        critics: parameters of critics by name (Nav2).
        tolerance: of the goal, m and rad; a goal checker's (Nav2).
        seed: of whatever is random.
        given: names of the parameters that were set.
    """

    period_s: float
    critics: Mapping[str, Mapping[str, Any]]
    tolerance: tuple[float, float] = (0.25, 0.25)
    seed: int = 0
    given: Collection[str] = ()


@dataclass(frozen=True, slots=True)
class ControllerKind:
    """A controller.

    Attributes:
        options: class of its options.
        make: makes one of options and setting.
        note: what differs from the original, empty for nothing that matters.
    """

    options: type[ControllerOptions]
    make: Callable[[Any, ControllerSetting], Controller]
    note: str = ""


def _dwa(options: DwaOptions, setting: ControllerSetting) -> Controller:
    controller = SamplingController(dwa_profile(options), setting.period_s)
    return _maneuvering(controller, setting, options.max_vel_trans, options.max_vel_theta)


def _trajectory(options: TrajectoryPlannerOptions, setting: ControllerSetting) -> Controller:
    is_old = not _OLD_NAMES.isdisjoint(setting.given)
    controller = TrajectoryPlanner(options, setting.period_s, scales_obstacles=is_old)
    slowest = options.min_in_place_vel_theta
    return _maneuvering(controller, setting, options.max_vel_x, options.max_vel_theta, slowest)


def _dwb(options: DwbOptions, setting: ControllerSetting) -> Controller:
    # RotateToGoal reads these of the controller, not of the critic.
    own = {"xy_goal_tolerance": options.xy_goal_tolerance,
           "trans_stopped_velocity": options.trans_stopped_velocity}  # fmt: skip
    rotate = {**own, **setting.critics.get("RotateToGoal", {})}
    critics = {**setting.critics, "RotateToGoal": rotate}
    options = replace(options, vy_samples=max(options.vy_samples, 1))
    # LimitedAccelGenerator tries what one period reaches, the standard one what sim_time does.
    holds = "LimitedAccel" in options.trajectory_generator_name
    profile = replace(dwb_profile(options, critics), holds=holds, arrives=False)
    controller = SamplingController(profile, setting.period_s)
    return _maneuvering(controller, setting, options.max_vel_x, options.max_vel_theta)


def _mppi(options: MppiOptions, setting: ControllerSetting) -> Controller:
    controller = MppiController(
        options, setting.period_s, setting.critics, setting.tolerance, setting.seed
    )
    if options.motion_model == "Ackermann":
        return controller
    return _maneuvering(controller, setting, options.vx_max, options.wz_max)


def _pursuit(options: PursuitOptions, setting: ControllerSetting) -> Controller:
    controller = PursuitController(options, setting.period_s, setting.tolerance)
    if not options.use_rotate_to_heading:
        return controller
    turn = options.rotate_to_heading_angular_vel
    return _maneuvering(controller, setting, options.desired_linear_vel, turn)


def _maneuvering(
    controller: Controller,
    setting: ControllerSetting,
    m_s: float,
    rad_s: float,
    slowest_rad_s: float = 0.0,
) -> Controller:
    """Let a robot that turns on the spot do so where the controller finds no way on."""
    if m_s <= 0 or rad_s <= 0:
        return controller
    fastest, turn = min(m_s, _MANEUVER_M_S), min(rad_s, _MANEUVER_RAD_S)
    slowest = min(max(slowest_rad_s, _MIN_SPEED_RAD_S), turn)
    return Maneuvering(controller, Pace(fastest, turn, slowest), setting.period_s)


_TEB = (
    "it optimises time-elastic bands, compiled; dwa_local_planner/DWAPlannerROS drives the same "
    "robots, and nav2_mppi_controller plans as far ahead"
)

CONTROLLERS: Mapping[str, ControllerKind] = {
    "dwa_local_planner/DWAPlannerROS": ControllerKind(DwaOptions, _dwa),
    "base_local_planner/TrajectoryPlannerROS": ControllerKind(
        TrajectoryPlannerOptions, _trajectory
    ),
    **{
        f"{package}{separator}{name}": kind
        for separator in ("/", "::")
        for package, name, kind in (
            ("dwb_core", "DWBLocalPlanner", ControllerKind(DwbOptions, _dwb)),
            ("nav2_mppi_controller", "MPPIController", ControllerKind(MppiOptions, _mppi)),
            (
                "nav2_regulated_pure_pursuit_controller",
                "RegulatedPurePursuitController",
                ControllerKind(PursuitOptions, _pursuit),
            ),
        )
    },
}
"""Controllers by their names in ROS 1's and ROS 2's files."""

REFUSED_CONTROLLERS: Mapping[str, str] = {
    "teb_local_planner/TebLocalPlannerROS": _TEB,
    "teb_local_planner::TebLocalPlannerROS": _TEB,
    "eband_local_planner/EBandPlannerROS": "it is compiled; dwa_local_planner/DWAPlannerROS drives "
    "the same robots",
    "asr_ftc_local_planner/FTCPlanner": "it is compiled; dwa_local_planner/DWAPlannerROS drives "
    "the same robots",
    "pose_follower/PoseFollower": "it is compiled; dwa_local_planner/DWAPlannerROS drives the same "
    "robots",
    "nav2_rotation_shim_controller::RotationShimController": "it turns before another controller "
    "drives; name its primary_controller instead, RegulatedPurePursuitController turns by itself",
    "nav2_rotation_shim_controller/RotationShimController": "see "
    "nav2_rotation_shim_controller::RotationShimController",
    "nav2_graceful_controller::GracefulController": "it is compiled; "
    "nav2_regulated_pure_pursuit_controller drives the same robots",
}
"""Why a controller is not there, and what is."""
