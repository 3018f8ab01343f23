"""Cameras of films: where they stand at each time of a recording."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import CameraSpec, World
from gazelle.diagnostics import nearest_names
from gazelle.errors import GazelleError, NotFoundError
from gazelle.geometry import IDENTITY_POSE, Pose, Vector3
from gazelle.recording import Recording
from gazelle.sensors.view_cameras import camera_spec, fitting_camera, looking_at, view_direction
from gazelle.video.subjects import Subject, free_direction, subject_of

__all__ = [
    "AutomaticCamera",
    "Camera",
    "FixedCamera",
    "FollowCamera",
    "PlacedCamera",
    "SensorCamera",
]

_FAR_M = 1000.0
_NEAR_M = 0.01
# A subject that goes farther than so many of its own sizes is followed.
_FOLLOWED_FROM = 2.0
_AIR = 1.75
"""How much larger than the subject the picture is."""

_ON_BOARD_M = 4.0
"""How far a camera on board is taken to look."""

_BEHIND: Vector3 = (-1.0, 0.0, 0.5)
_TURN_S = 1.0
"""Time constant with which a camera behind a robot turns along."""


class PlacedCamera(NamedTuple):
    """A camera of one recording.

    Attributes:
        spec: lens, size and clip distances.
        pose_at: ``T_world_camera`` at a simulated time (ns); it looks along +x, z up.
        distance_m: to what it looks at.
    """

    spec: CameraSpec
    pose_at: Callable[[int], Pose]
    distance_m: float


class Camera(Protocol):
    """Anything that can be placed in a recording."""

    def place(self, recording: Recording, size_px: tuple[int, int]) -> PlacedCamera:
        """Return where it stands over time.

        Raises:
            NotFoundError: what it looks at or sits on is not in the recording.
        """
        ...


@dataclass(frozen=True, slots=True)
class FixedCamera:
    """A camera that stands still.

    Attributes:
        eye_m: where it stands, world frame; None for where all that the robots do is in the
            picture, seen from `view`.
        target_m: what it looks at; the middle of the robots at the start when None.
        view: of `gazelle.sensors.view_cameras.VIEWS`.
        model: what it looks at in place of the robots.
    """

    eye_m: Vector3 | None = None
    target_m: Vector3 | None = None
    view: str = "iso"
    model: str | None = None

    def place(self, recording: Recording, size_px: tuple[int, int]) -> PlacedCamera:
        """Return where it stands."""
        spec = _lens(size_px)
        if self.eye_m is not None and self.target_m is not None:
            return _standing(spec, self.eye_m, self.target_m)
        subject = subject_of(recording, self.model)
        if self.eye_m is not None:
            return _standing(spec, self.eye_m, _vector(subject.middles[0]))
        points = _with_air(np.concatenate(subject.clouds), 1.0 + (_AIR - 1.0) / 2.0)
        direction = _seen_from(recording, subject, self.view, points, spec)
        pose = fitting_camera(points, direction, spec)
        distance_m = float(np.linalg.norm(subject.middles[0] - np.array(pose.position_m)))
        return PlacedCamera(spec, lambda _time_ns: pose, distance_m)


@dataclass(frozen=True, slots=True)
class FollowCamera:
    """A camera that goes along with a model, at the same distance.

    Attributes:
        model: its name; the robot that goes farthest when None.
        view: from where, of `gazelle.sensors.view_cameras.VIEWS`; the front is the world's +x.
        turns: look from behind and above, and turn along with the model.
        orbit_s: go round it once in so many simulated seconds; 0 for not at all.
    """

    model: str | None = None
    view: str = "iso"
    turns: bool = False
    orbit_s: float = 0.0

    def place(self, recording: Recording, size_px: tuple[int, int]) -> PlacedCamera:
        """Return where it is over time."""
        subject = _one_subject(recording, self.model)
        spec = _lens(size_px)
        base = _base_link(recording, subject.models[0])
        first = _link_pose(recording, base, subject.times_ns[0])
        offset = first.inverse().transform(subject.middles[:1])[0]
        shape = _with_air(_gathered(subject), _AIR)
        direction = _BEHIND if self.turns else view_direction(self.view)
        if not (self.turns or self.orbit_s):
            direction = _seen_from(recording, subject, self.view, shape, spec)
        fitting = fitting_camera(shape, direction, spec)
        away = np.array(fitting.position_m)
        start_ns = recording.start_ns
        yaw_at = _smooth_yaw(recording, base) if self.turns else (lambda _time_ns: 0.0)
        rate_rad_s = 2.0 * math.pi / self.orbit_s if self.orbit_s else 0.0

        def pose_at(time_ns: int) -> Pose:
            T_world_base = _link_pose(recording, base, max(time_ns, subject.times_ns[0]))
            middle = T_world_base.transform(np.array([offset]))[0]
            turn = yaw_at(time_ns) + rate_rad_s * (time_ns - start_ns) * 1e-9
            T_world_follower = Pose.from_xy_yaw(0.0, 0.0, turn)
            eye = T_world_follower.transform(np.array([away]))[0] + middle
            turned = T_world_follower @ Pose((0.0, 0.0, 0.0), fitting.quat_xyzw)
            return Pose(_vector(eye), turned.quat_xyzw)

        return PlacedCamera(spec, pose_at, float(np.linalg.norm(away)))


@dataclass(frozen=True, slots=True)
class SensorCamera:
    """A camera on board: a camera sensor of a model, with its lens, or a link, looking along +x.

    Attributes:
        name: ``model::link::sensor`` or ``model::link``, or an end of it that is not ambiguous.
    """

    name: str

    def place(self, recording: Recording, size_px: tuple[int, int]) -> PlacedCamera:
        """Return where it is over time."""
        mounts = _mounts(recording.stretches[-1].world)
        mount = mounts[_one_name(self.name, mounts)]
        spec = replace(
            _lens(size_px),
            horizontal_fov_rad=mount.fov_rad,
            near_m=mount.near_m,
        )

        def pose_at(time_ns: int) -> Pose:
            return _link_pose(recording, mount.link, time_ns) @ mount.T_link_camera

        return PlacedCamera(spec, pose_at, _ON_BOARD_M)


@dataclass(frozen=True, slots=True)
class AutomaticCamera:
    """Follows the robot if it goes far for its size, else stands where all is in the picture.

    Attributes:
        view: from where, of `gazelle.sensors.view_cameras.VIEWS`.
    """

    view: str = "iso"

    def place(self, recording: Recording, size_px: tuple[int, int]) -> PlacedCamera:
        """Return where it is over time."""
        subject = subject_of(recording)
        is_one = len(subject.models) == 1
        if is_one and subject.travel_m > _FOLLOWED_FROM * subject.radius_m:
            return FollowCamera(view=self.view).place(recording, size_px)
        return FixedCamera(view=self.view).place(recording, size_px)


class _Mount(NamedTuple):
    link: str
    T_link_camera: Pose
    fov_rad: float
    near_m: float


def _standing(spec: CameraSpec, eye_m: Vector3, target_m: Vector3) -> PlacedCamera:
    pose = looking_at(eye_m, target_m)
    return PlacedCamera(spec, lambda _time_ns: pose, math.dist(eye_m, target_m))


def _lens(size_px: tuple[int, int]) -> CameraSpec:
    return replace(camera_spec(*size_px), near_m=_NEAR_M, far_m=_FAR_M)


def _one_subject(recording: Recording, model: str | None) -> Subject:
    """Return the model asked for, or the robot that goes farthest."""
    subject = subject_of(recording, model)
    if len(subject.models) == 1:
        return subject
    return max(
        (subject_of(recording, name) for name in subject.models), key=lambda one: one.travel_m
    )


def _gathered(subject: Subject) -> NDArray[np.float64]:
    """Return the points of all times about the origin."""
    pairs = zip(subject.clouds, subject.middles, strict=True)
    return np.concatenate([cloud - middle for cloud, middle in pairs])


def _with_air(points: NDArray[np.float64], factor: float) -> NDArray[np.float64]:
    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    return np.asarray(middle + factor * (points - middle))


def _seen_from(
    recording: Recording,
    subject: Subject,
    view: str,
    points: NDArray[np.float64],
    spec: CameraSpec,
) -> Vector3:
    direction = view_direction(view)
    if view != "iso":
        # Who names a side wants that one.
        return direction
    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    fitting = fitting_camera(points, direction, spec)
    distance_m = float(np.linalg.norm(np.array(fitting.position_m) - middle))
    return free_direction(recording, subject, direction, distance_m)


def _base_link(recording: Recording, model: str) -> str:
    found = next(
        one for two in reversed(recording.stretches) for one in two.world.models
        if one.name == model
    )  # fmt: skip
    return f"{model}::{found.canonical_link or found.links[0].name}"


def _link_pose(recording: Recording, link: str, time_ns: int) -> Pose:
    """Return a link's pose, where it first stands before it is there."""
    stretch = recording.stretch_at(time_ns)
    if link not in stretch.link_names:
        having = [one for one in recording.stretches if link in one.link_names]
        later = [one for one in having if one.times_ns[0] >= time_ns]
        stretch = (later or having)[0 if later else -1]
    x, y, z, *quat = stretch.moment(time_ns).T[stretch.link_names.index(link)].tolist()
    return Pose((x, y, z), (quat[0], quat[1], quat[2], quat[3]))


def _smooth_yaw(recording: Recording, link: str) -> Callable[[int], float]:
    """Return the heading of a link over time, as something heavy follows it."""
    times = np.concatenate([one.times_ns for one in recording.stretches])
    yaws = np.unwrap([_link_pose(recording, link, int(one)).xy_yaw[2] for one in times])
    smooth = np.array(yaws)
    for place in range(1, len(smooth)):
        passed_s = (times[place] - times[place - 1]) * 1e-9
        share = 1.0 - math.exp(-passed_s / _TURN_S)
        smooth[place] = smooth[place - 1] + share * (yaws[place] - smooth[place - 1])
    return lambda time_ns: float(np.interp(time_ns, times, smooth))


def _mounts(world: World) -> dict[str, _Mount]:
    found: dict[str, _Mount] = {}
    plain = CameraSpec()
    for model in world.models:
        for link in model.links:
            name = f"{model.name}::{link.name}"
            found[name] = _Mount(name, IDENTITY_POSE, plain.horizontal_fov_rad, _NEAR_M)
            for sensor in link.sensors:
                if isinstance(sensor.spec, CameraSpec):
                    spec = sensor.spec
                    T_link_camera = sensor.T_link_sensor @ spec.T_sensor_camera
                    near_m = max(spec.near_m, 1e-3)
                    mount = _Mount(name, T_link_camera, spec.horizontal_fov_rad, near_m)
                    found[f"{name}::{sensor.name}"] = mount
    return found


def _one_name(name: str, known: dict[str, _Mount]) -> str:
    if name in known:
        return name
    ends = [one for one in known if one.endswith(f"::{name}")]
    cameras = [one for one in ends if one.count("::") > 1]
    if len(ends) == 1 or len(cameras) == 1:
        return (cameras or ends)[0]
    if ends:
        raise GazelleError(
            f"several cameras and links are called '{name}': {', '.join(ends)}; write one of "
            "these names"
        )
    cameras = [one for one in known if one.count("::") > 1]
    hint = f"cameras there: {', '.join(cameras) or 'none; a link can be one'}"
    nearest = nearest_names(name, [*(one.rpartition("::")[2] for one in known), *known])
    raise NotFoundError("camera", name, nearest=nearest, hint=hint)


def _vector(numbers: NDArray[np.float64]) -> Vector3:
    x, y, z = numbers.tolist()
    return (x, y, z)
