"""Bodies of a replay and how they move: the scene that the page draws, and tracks of its poses."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.recording import Recording
from gazelle.sensors.scene_json import world_value
from gazelle.studio.replay.geometry import PackedAssets
from gazelle.studio.replay.packing import Pack
from gazelle.studio.scenes.shapes import page_scene

__all__ = ["motion_head"]

_RATE_HZ = 25
_PLACE_STEP_M = 1e-4
_TURN_STEP = 1.0 / 16384.0
_PERIOD_NS = 1_000_000_000 // _RATE_HZ

Values = dict[str, Any]


class _Body(NamedTuple):
    value: Values
    model: Values


def _frame_times_ns(recording: Recording) -> NDArray[np.int64]:
    """Return the simulated times of the frames: 25 per second, and the end."""
    times = np.arange(recording.start_ns, recording.end_ns, _PERIOD_NS)
    return np.append(times, recording.end_ns).astype(np.int64)


def motion_head(recording: Recording, pack: Pack) -> Values:
    """Return scene, meshes, textures and tracks; arrays go into the pack."""
    assets = PackedAssets(pack)
    times = _frame_times_ns(recording)
    starts = [int(one.times_ns[0]) for one in recording.stretches]
    owner = np.maximum(np.searchsorted(starts, times, "right") - 1, 0)
    bodies: dict[str, _Body] = {}
    poses: dict[str, NDArray[np.float64]] = {}
    scene: Values = {}
    for number, stretch in enumerate(recording.stretches):
        scene = dict(page_scene(world_value(stretch.world), assets))
        frames = np.flatnonzero(owner == number)
        moments = [stretch.moment(int(times[frame])) for frame in frames]
        for value in scene["bodies"]:
            key = _key(value, scene["models"][value["model"]])
            bodies.setdefault(key, _Body(value, scene["models"][value["model"]]))
            track = poses.setdefault(key, np.full((len(times), 7), np.nan))
            if value["name"] in stretch.link_names:
                row = stretch.link_names.index(value["name"])
                if moments:
                    track[frames] = [moment.T[row] for moment in moments]
            else:
                track[frames] = value["pose"]
    return {
        "scene": _scene(scene, list(bodies.values())),
        "meshes": assets.meshes,
        "textures": assets.textures,
        "tracks": [_track(poses[key], pack) for key in bodies],
        "frames": {
            "count": len(times),
            "period_s": _PERIOD_NS * 1e-9,
            "start_s": recording.start_s,
            "duration_s": recording.duration_s,
        },
    }


def _key(body: Values, model: Values) -> str:
    return json.dumps([body["name"], model["static"], body["visuals"]], sort_keys=True)


def _scene(last: Values, bodies: list[_Body]) -> Values:
    """Return one scene with the bodies of all stretches."""
    names = list(dict.fromkeys(one.model["name"] for one in bodies))
    value = {key: last[key] for key in ("name", "lights", "sky", "ambient", "background")}
    models: list[Values] = [{"name": name, "static": True, "bodies": [], "joints": []}
                            for name in names]  # fmt: skip
    shown = []
    for place, one in enumerate(bodies):
        model = models[names.index(one.model["name"])]
        model["static"] = one.model["static"]
        model.setdefault("pose", one.model["pose"])
        model["bodies"].append(place)
        shown.append(
            {
                "name": one.value["name"],
                "link": one.value["link"],
                "model": names.index(one.model["name"]),
                "pose": one.value["pose"],
                "visuals": one.value["visuals"],
                "inertial": None,
                "collisions": [],
                "sensors": [],
                "lights": [],
            }
        )
    rest = {"kind": "world", "version": 1, "joints": [], "models": models, "bodies": shown}
    return {**value, **rest, "shadows": last["shadows"], "grid": last["grid"], "view": last["view"]}


def _track(poses: NDArray[np.float64], pack: Pack) -> Values:
    """Return where a body is: one pose, or whole numbers for each frame, and when it is there."""
    there = np.asarray(np.isfinite(poses).all(axis=1))
    filled = _filled(poses, there)
    places = np.rint(filled[:, :3] / _PLACE_STEP_M).astype(np.int64)
    turns = np.rint(_continuous(filled[:, 3:]) / _TURN_STEP).astype(np.int64)
    value: Values = {}
    if not there.all():
        value["there"] = _runs(there)
    if (places == places[0]).all() and (turns == turns[0]).all():
        value["pose"] = [float(number) for number in np.round(filled[0], 6)]
        return value
    value["places"] = pack.integers(places, 2)
    value["turns"] = pack.integers(turns, 2)
    value["steps"] = [_PLACE_STEP_M, _TURN_STEP]
    return value


def _filled(poses: NDArray[np.float64], there: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return poses with the nearest one where there is none."""
    if not there.any():
        return np.tile([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], (len(poses), 1))
    known = np.flatnonzero(there)
    nearest = np.clip(np.searchsorted(known, np.arange(len(poses)), "right") - 1, 0, None)
    return np.asarray(poses[known[nearest]])


def _continuous(quats: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the same turns without jumps of sign."""
    dots = (quats[1:] * quats[:-1]).sum(axis=1)
    signs = np.concatenate([[1.0], np.cumprod(np.where(dots < 0.0, -1.0, 1.0))])
    return np.asarray(quats * signs[:, None])


def _runs(there: NDArray[np.bool_]) -> list[list[int]]:
    """Return the frames between which it is there: first, and behind the last."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], there, [False]]).astype(np.int8)))
    return [[int(first), int(end)] for first, end in edges.reshape(-1, 2)]
