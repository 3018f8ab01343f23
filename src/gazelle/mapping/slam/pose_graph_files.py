"""Graphs of poses with their scans as files, to go on mapping or to localise later."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from gazelle.documents.files import refused_version
from gazelle.documents.npz_files import read_arrays
from gazelle.errors import GazelleError
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.pose_graph.constraints import Edges, doubtful
from gazelle.mapping.slam.keyframes import keyframe_of
from gazelle.mapping.slam.slam_engine import Slam
from gazelle.mapping.slam.slam_parameters import SlamParameters

__all__ = ["SUFFIX", "SavedGraphError", "load_graph", "save_graph"]

SUFFIX = ".posegraph"
_FORMAT, _VERSION = "gazelle posegraph", 1


class SavedGraphError(GazelleError):
    """A graph of poses cannot be read or written."""


def save_graph(engine: Slam, path: Path) -> None:
    """Write kept scans, poses and relations.

    Raises:
        SavedGraphError: the file cannot be written.
    """
    frames = [engine.keyframes[i] for i in range(len(engine.keyframes))]
    scans = [frame.scan for frame in frames]
    columns: dict[str, Any] = {
        "format": np.array(f"{_FORMAT} {_VERSION}"),
        "poses": engine.keyframes.poses,
        "ways_m": engine.keyframes.ways_m,
        "ranges_m": np.concatenate([scan.ranges_m for scan in scans]) if scans else np.empty(0),
        "beams": np.array([len(scan.ranges_m) for scan in scans], dtype=np.int64),
        "stamps_ns": np.array([scan.stamp_ns for scan in scans], dtype=np.int64),
        "scans": np.array([_row(scan) for scan in scans]).reshape(-1, 8),
    }
    columns |= {f"edge_{name}": value for name, value in engine.edges._asdict().items()}
    try:
        with path.open("wb") as file:
            np.savez_compressed(file, **columns)
    except OSError as error:
        raise SavedGraphError(f"{path} cannot be written: {error.strerror}") from None


def load_graph(path: Path, parameters: SlamParameters) -> Slam:
    """Return an engine that has mapped what a file holds.

    Raises:
        SavedGraphError: the file is not there, or holds no graph.
    """
    try:
        columns: dict[str, Any] = read_arrays(path)
        name, _, version = str(columns["format"]).rpartition(" ")
        if name != _FORMAT or not version.isdecimal():
            raise ValueError(f"it is '{columns['format']}', not '{_FORMAT} {_VERSION}'")
        if why := refused_version(str(path), int(version), _VERSION):
            raise SavedGraphError(why)
        return _engine(columns, parameters)
    except OSError as error:
        raise SavedGraphError(f"{path} cannot be read: {error.strerror or error}") from None
    except (KeyError, ValueError, IndexError, TypeError, OverflowError) as error:
        raise SavedGraphError(
            f"{path} holds no graph of poses that Gazelle has written ({error}); files of the "
            "original's serialize_map are its own binary format"
        ) from None


def _row(scan: Scan) -> tuple[float, ...]:
    return (
        scan.angle_min_rad, scan.angle_increment_rad, scan.range_min_m, scan.range_max_m,
        *scan.T_base_laser, float(scan.upside_down),
    )  # fmt: skip


def _engine(columns: dict[str, Any], parameters: SlamParameters) -> Slam:
    engine = Slam(parameters)
    ends = np.cumsum(columns["beams"])
    for k, row in enumerate(columns["scans"].tolist()):
        ranges = columns["ranges_m"][ends[k] - columns["beams"][k] : ends[k]]
        scan = Scan(
            int(columns["stamps_ns"][k]), row[0], row[1], ranges.astype(np.float32), row[2],
            row[3], (row[4], row[5], row[6]), bool(row[7]),
        )  # fmt: skip
        frame = keyframe_of(scan, parameters, float(columns["ways_m"][k]))
        engine.keyframes.append(frame, columns["poses"][k])
    names = Edges._fields
    engine.edges = Edges(*(columns[f"edge_{name}"] for name in names))
    torn = doubtful(engine.edges.information) & ~engine.edges.is_loop
    engine.keyframes.tears = set(engine.edges.head[torn].tolist())
    engine.resume(columns["poses"][-1])
    return engine
