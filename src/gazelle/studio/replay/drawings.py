"""What a replay draws beside bodies: laser scans, maps and paths, where they are in the world."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.graph.tf import TransformBuffer, TransformError
from gazelle.interfaces.poses import pose_of, pose_of_transform, unit_pose_of
from gazelle.recording import Recording, TopicTrack
from gazelle.sensors.scene_json import pose_value
from gazelle.studio.replay.packing import Pack

__all__ = ["drawings_head"]

_SCAN = "sensor_msgs/msg/LaserScan"
_MAP = "nav_msgs/msg/OccupancyGrid"
_PATH = "nav_msgs/msg/Path"
_TF = frozenset({"tf2_msgs/msg/TFMessage", "tf/msg/tfMessage"})
_SCAN_GAP_NS = 95_000_000
_RANGE_STEP_M = 0.01
_MOST_BEAMS = 720
_MOST_MAPS = 12
_MOST_CELLS = 1_000_000
# Costmaps lie over the map that they are made of.
_COSTMAP = "costmap"
_MOST_POINTS = 400
_PATH_GAP_NS = 450_000_000
_PATH_STEP_M = 0.005
_FARTHEST_M = 1e6
_LONGEST_NS = 10**15

Values = dict[str, Any]


def drawings_head(recording: Recording, pack: Pack) -> Values:
    """Return scans, maps and paths; arrays go into the pack."""
    frames = _Frames(recording)
    found: dict[str, list[Values]] = {"scans": [], "maps": [], "paths": []}
    for track in recording.topics:
        if track.type_name == _SCAN:
            found["scans"] += _scan(track, recording, frames, pack)
        elif track.type_name == _MAP:
            found["maps"] += _map(track, recording, frames, pack)
        elif track.type_name == _PATH:
            found["paths"] += _path(track, recording, frames, pack)
    return dict(found)


class _Frames:
    """Where frames of tf are: those of links by the links, others by tf."""

    def __init__(self, recording: Recording) -> None:
        self._recording = recording
        self._buffer = TransformBuffer(cache_ns=_LONGEST_NS)
        self._stamps: list[int] = []
        for track in recording.topics:
            if track.type_name in _TF:
                is_static = track.name.endswith("tf_static")
                self._fill(track, is_static=is_static)
        self._links = {
            name.rpartition("::")[2]: name
            for stretch in recording.stretches
            for name in stretch.link_names
        }

    def mount(self, frame: str) -> tuple[str, Pose] | None:
        """Return the link that a frame is fixed to, and where on it."""
        name = frame.strip("/")
        if name in self._links:
            return self._links[name], IDENTITY_POSE
        known = [link for link in self._links if self._buffer.has_frame(link)]
        for link in sorted(known, key=lambda one: self._steps(name, one)):
            with suppress(TransformError):
                return self._links[link], self._buffer.lookup_transform(link, name, 0).pose
        return None

    def in_world(self, frame: str, time_ns: int) -> Pose | None:
        """Return ``T_world_frame`` at a time of the recording."""
        name = frame.strip("/")
        for link, full in self._links.items():
            if not self._buffer.has_frame(link):
                continue
            for stamp_ns in (time_ns, 0):
                with suppress(TransformError):
                    T_link_frame = self._buffer.lookup_transform(link, name, stamp_ns).pose
                    moment_ns = stamp_ns or self._recording.end_ns
                    return self._link_pose(full, moment_ns) @ T_link_frame
        return IDENTITY_POSE if name in ("map", "odom", "world") else None

    def _link_pose(self, link: str, time_ns: int) -> Pose:
        having = [one for one in self._recording.stretches if link in one.link_names]
        begun = [one for one in having if one.times_ns[0] <= time_ns]
        stretch = begun[-1] if begun else having[0]
        row = stretch.moment(time_ns).T[stretch.link_names.index(link)].tolist()
        return Pose((row[0], row[1], row[2]), (row[3], row[4], row[5], row[6]))

    def _steps(self, frame: str, link: str) -> int:
        try:
            return len(self._buffer.chain(link, frame))
        except TransformError:
            return 1_000_000

    def _fill(self, track: TopicTrack, *, is_static: bool) -> None:
        # When they came: clocks of bags and of what is in them may differ.
        for time_ns, message in zip(track.times_ns.tolist(), track.messages, strict=True):
            for one in message.transforms:
                with suppress(TransformError):
                    self._buffer.set_transform(
                        one.header.frame_id,
                        one.child_frame_id,
                        time_ns,
                        pose_of_transform(one.transform),
                        is_static=is_static,
                    )


def _thinned(track: TopicTrack, gap_ns: int) -> Iterator[tuple[int, Any]]:
    last_ns = -(2**62)
    for time_ns, message in zip(track.times_ns.tolist(), track.messages, strict=True):
        if time_ns - last_ns >= gap_ns:
            last_ns = time_ns
            yield time_ns, message


def _times(times_ns: list[int], recording: Recording, pack: Pack) -> list[int]:
    return pack.integers((np.array(times_ns) - recording.start_ns) // 1000, 2)


def _scan(track: TopicTrack, recording: Recording, frames: _Frames, pack: Pack) -> Iterator[Values]:
    kept = list(_thinned(track, _SCAN_GAP_NS))
    if not kept:
        return
    first = kept[0][1]
    mount = frames.mount(first.header.frame_id)
    count = len(first.ranges)
    if mount is None or not count or not _are_finite(first.angle_min, first.angle_increment):
        return
    every = max(1, -(-count // _MOST_BEAMS))
    rows = [one for one in kept if len(one[1].ranges) == count]
    ranges = np.array([one.ranges for _, one in rows], np.float64)[:, ::every]
    good = (ranges < _FARTHEST_M) & (ranges >= first.range_min) & (ranges < first.range_max)
    steps = np.where(good, np.rint(np.where(good, ranges, 0.0) / _RANGE_STEP_M), 0.0)
    yield {
        "topic": track.name,
        "times": _times([time_ns for time_ns, _ in rows], recording, pack),
        "body": mount[0],
        "pose": pose_value(mount[1]),
        "angle_min": float(first.angle_min),
        "angle_step": float(first.angle_increment) * every,
        "range_step": _RANGE_STEP_M,
        "beams": ranges.shape[1],
        # Neighbouring beams are like each other: one long column.
        "ranges": pack.integers(steps.reshape(-1)),
    }


def _map(track: TopicTrack, recording: Recording, frames: _Frames, pack: Pack) -> Iterator[Values]:
    if _COSTMAP in track.name:
        return
    span_ns = max(1, recording.end_ns - recording.start_ns)
    versions: list[Values] = []
    last = None
    for time_ns, message in _thinned(track, span_ns // _MOST_MAPS):
        info = message.info
        T_world_frame = frames.in_world(message.header.frame_id, time_ns)
        cells = np.asarray(message.data, np.int8).view(np.uint8)
        is_whole = 0 < info.width * info.height == len(cells)
        if T_world_frame is None or not is_whole or not _are_finite(info.resolution):
            continue
        every = math.ceil(math.sqrt(len(cells) / _MOST_CELLS))
        shown = cells.reshape(info.height, info.width)[::every, ::every]
        pose = pose_value(T_world_frame @ unit_pose_of(info.origin))
        if (shown.tobytes(), pose) == last or not _are_finite(*pose):
            continue
        last = (shown.tobytes(), pose)
        versions.append(
            {
                "time_s": (time_ns - recording.start_ns) * 1e-9,
                "size": [shown.shape[1], shown.shape[0]],
                "resolution": float(info.resolution) * every,
                "pose": pose,
                "cells": pack.raw(shown.tobytes()),
            }
        )
    if versions:
        yield {"topic": track.name, "versions": versions}


def _path(track: TopicTrack, recording: Recording, frames: _Frames, pack: Pack) -> Iterator[Values]:
    versions = []
    for time_ns, message in _thinned(track, _PATH_GAP_NS):
        T_world_frame = frames.in_world(message.header.frame_id, time_ns)
        if T_world_frame is None or not len(message.poses):
            continue
        points = _points(message)
        versions.append(
            {
                "time_s": (time_ns - recording.start_ns) * 1e-9,
                "pose": pose_value(T_world_frame),
                "step": _PATH_STEP_M,
                "points": pack.integers(np.rint(points / _PATH_STEP_M), 2),
            }
        )
    if versions:
        yield {"topic": track.name, "versions": versions}


def _points(message: Any) -> NDArray[np.float64]:
    every = max(1, -(-len(message.poses) // _MOST_POINTS))
    chosen = [pose_of(one.pose).position_m for one in message.poses[::every]]
    points = np.array(chosen, np.float64).reshape(-1, 3)
    return np.asarray(points[(np.abs(points) < _FARTHEST_M).all(axis=1)])


def _are_finite(*numbers: float) -> bool:
    """Messages may hold anything, and JSON no infinity."""
    return all(math.isfinite(one) for one in numbers)
