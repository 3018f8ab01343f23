"""Logs of robots in buildings whose walls are known: segments, lidars, odometry that errs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.se2 import between, compose
from gazelle.mapping.slam import Slam, SlamParameters

Segments = NDArray[np.float64]


@dataclass(frozen=True)
class Lidar:
    """Beams evenly over a field of view."""

    beams: int
    fov_rad: float
    range_m: float
    sigma_m: float
    mount: tuple[float, float, float] = (0.0, 0.0, 0.0)


SICK = Lidar(180, math.pi, 80.0, 0.015, (0.15, 0.0, 0.0))
HOKUYO = Lidar(541, math.radians(270), 30.0, 0.01, (0.1, 0.02, 0.05))
LDS = Lidar(360, math.tau, 3.5, 0.01, (-0.03, 0.0, 0.0))


@dataclass(frozen=True)
class Wheels:
    """How odometry errs: shares of way and turn, a steady drift, and slips now and then."""

    way: float = 0.03
    turn: float = 0.05
    drift_rad_per_m: float = 0.005
    noise_m: float = 0.002
    noise_rad: float = 0.002
    slips: int = 0


@dataclass(frozen=True)
class Building:
    """Walls, shape (n, 4), a tour through it, shape (m, 2), and walls of glass.

    Of the beams that meet glass one in four comes back.
    """

    walls: Segments
    tour: NDArray[np.float64]
    glass: Segments = field(default_factory=lambda: np.zeros((0, 4)))


def box(x0: float, y0: float, x1: float, y1: float) -> list[tuple[float, ...]]:
    return [(x0, y0, x1, y0), (x1, y0, x1, y1), (x1, y1, x0, y1), (x0, y1, x0, y0)]


def ring(width: float, height: float, seed: int, rooms: float = 6.0, laps: float = 1.2) -> Building:
    """A corridor, 2.4 m wide, around a block, with rooms of irregular doors outside and inside."""
    rng = np.random.default_rng(seed)
    walls: list[tuple[float, ...]] = []
    half = 1.2
    outer, inner = (
        (-half, -half, width + half, height + half),
        (half, half, width - half, height - half),
    )
    for x0, y0, x1, y1 in (outer, inner):
        out = 1.0 if (x0, y0) == outer[:2] else -1.0
        corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]
        for (ax, ay), (bx, by) in pairwise(corners):
            walls += _wall_with_rooms((ax, ay), (bx, by), out, rng, rooms)
    lap = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    count = math.ceil(laps * 4) + 1
    tour = np.array([lap[i % 4] for i in range(count)])
    return Building(np.array(walls), tour)


def _wall_with_rooms(
    a: tuple[float, float],
    b: tuple[float, float],
    out: float,
    rng: np.random.Generator,
    mean: float,
) -> list[tuple[float, ...]]:
    start, end = np.array(a), np.array(b)
    length = float(np.hypot(*(end - start)))
    along = (end - start) / length
    away = out * np.array([along[1], -along[0]])
    walls: list[tuple[float, ...]] = []
    at = 0.0
    while True:
        gap = float(rng.uniform(0.5, 1.5) * mean)
        door = float(rng.uniform(0.8, 1.3))
        if at + gap + door + 0.5 > length:
            break
        p, q = start + along * (at + gap), start + along * (at + gap + door)
        walls.append((*(start + along * at), *p))
        deep, left, right = rng.uniform(0.3, 3.0), rng.uniform(0, 0.4 * gap), rng.uniform(0, 0.4)
        corners = [p, p - along * left, p - along * left + away * deep,
                   q + along * right + away * deep, q + along * right, q]  # fmt: skip
        walls += [(*c, *d) for c, d in pairwise(corners)]
        at += gap + door
    walls.append((*(start + along * at), *end))
    return walls


def corridor(length: float, seed: int) -> Building:
    """There and back along a corridor with few doors."""
    plain = ring(length, 12.0, seed, rooms=9.0)
    keep = (plain.walls[:, 1] < 6.0) & (plain.walls[:, 3] < 6.0)
    ends = [(-1.2, 1.2, -1.2, -1.2), (length + 1.2, 1.2, length + 1.2, -1.2)]
    inside = [(-1.2, 1.2, 1.2, 1.2), (length - 1.2, 1.2, length + 1.2, 1.2)]
    walls = np.concatenate([plain.walls[keep], np.array(ends + inside)])
    return Building(walls, np.array([(0.0, 0.0), (length, 0.0), (0.5, 0.3)]))


def hall(width: float, height: float, seed: int) -> Building:
    """A hall with pillars and boxes, driven in rounds."""
    rng = np.random.default_rng(seed)
    walls = box(0, 0, width, height)
    for _ in range(int(width * height / 25)):
        x, y = rng.uniform(1.5, width - 1.5), rng.uniform(1.5, height - 1.5)
        w, h = rng.uniform(0.2, 0.7, 2)
        if min(abs(x - 3), abs(x - width + 3), abs(y - 3), abs(y - height + 3)) > 1.0:
            walls += box(x, y, x + w, y + h)
    lap = [(3, 3), (width - 3, 3), (width - 3, height - 3), (3, height - 3), (3, 3)]
    return Building(np.array(walls), np.array([*lap, *lap[1:]], dtype=float))


def house(seed: int) -> Building:
    """Four rooms of 5 × 4 m around a cross of doors, with furniture."""
    rng = np.random.default_rng(seed)
    walls = box(0, 0, 10, 8)
    walls += [(5, 0, 5, 1.5), (5, 2.5, 5, 5.5), (5, 6.5, 5, 8)]
    walls += [(0, 4, 2, 4), (3, 4, 7, 4), (8, 4, 10, 4)]
    for cx, cy in (
        (1, 1),
        (4, 3.3),
        (9, 0.8),
        (6, 3.3),
        (9.2, 7),
        (6.2, 4.8),
        (0.8, 7.2),
        (3.8, 4.8),
    ):
        x, y = cx + rng.uniform(-0.2, 0.2), cy + rng.uniform(-0.2, 0.2)
        walls += box(x - 0.25, y - 0.2, x + 0.25, y + 0.2)
    tour = [(2.5, 2), (7.5, 2), (7.5, 6), (2.5, 6), (2.5, 2), (5, 2), (7.5, 2), (7.5, 6), (2.5, 6)]
    return Building(np.array(walls), np.array(tour, dtype=float))


def drive(
    tour: NDArray[np.float64], step_m: float = 0.1, turn_rad: float = 0.15
) -> NDArray[np.float64]:
    """Poses along a tour: straight ways with a slight weave, turns on the spot."""
    poses: list[tuple[float, float, float]] = []
    heading = math.atan2(*(tour[1] - tour[0])[::-1])
    for a, b in pairwise(tour):
        goal = math.atan2(*(b - a)[::-1])
        change = math.remainder(goal - heading, math.tau)
        for k in range(1, math.ceil(abs(change) / turn_rad) + 1):
            part = min(1.0, k * turn_rad / abs(change))
            poses.append((a[0], a[1], heading + change * part))
        heading += change
        length = float(np.hypot(*(b - a)))
        for k in range(1, int(length / step_m) + 1):
            weave = 0.03 * math.sin(k * step_m)
            x, y = a + (b - a) * min(1.0, k * step_m / length)
            poses.append((x, y, heading + weave))
    return np.array(poses)


def odometry_of(poses: NDArray[np.float64], wheels: Wheels, seed: int) -> NDArray[np.float64]:
    rng = np.random.default_rng(seed)
    steps = between(poses[:-1], poses[1:])
    way = np.hypot(steps[:, 0], steps[:, 1])
    scale = 1 + rng.uniform(-wheels.way, wheels.way)
    bend = 1 + rng.uniform(-wheels.turn, wheels.turn)
    drift = rng.uniform(-wheels.drift_rad_per_m, wheels.drift_rad_per_m)
    steps[:, :2] = steps[:, :2] * scale + rng.normal(0, wheels.noise_m, (len(steps), 2))
    steps[:, 2] = steps[:, 2] * bend + drift * way + rng.normal(0, wheels.noise_rad, len(steps))
    for k in rng.choice(len(steps), wheels.slips, replace=False):
        steps[k] += rng.uniform(-1, 1, 3) * (0.3, 0.1, 0.5)
    out = [np.zeros(3)]
    for step in steps:
        out.append(compose(out[-1], step))
    return np.array(out)


def cast(
    walls: Segments, origin: NDArray[np.float64], directions: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distances to the nearest wall, infinity where there is none."""
    dx, dy = np.cos(directions)[:, None], np.sin(directions)[:, None]
    ax, ay = walls[:, 0] - origin[0], walls[:, 1] - origin[1]
    ex, ey = walls[:, 2] - walls[:, 0], walls[:, 3] - walls[:, 1]
    with np.errstate(divide="ignore", invalid="ignore"):
        cross = dx * ey - dy * ex
        away = (ax * ey - ay * ex) / cross
        along = (ax * dy - ay * dx) / cross
    away[~((away > 0) & (along >= 0) & (along <= 1))] = np.inf
    return np.asarray(away.min(axis=1), dtype=float)


@dataclass(frozen=True)
class Log:
    """What a robot recorded, and where it was."""

    records: list[tuple[Scan, NDArray[np.float64]]]
    truth: NDArray[np.float64]


def log_of(
    building: Building, lidar: Lidar, wheels: Wheels = Wheels(), seed: int = 0, step_m: float = 0.1
) -> Log:
    rng = np.random.default_rng(seed + 1000)
    truth = drive(building.tour, step_m)
    odometry = odometry_of(truth, wheels, seed)
    return Log(list(_records(building, lidar, truth, odometry, rng)), truth)


def _records(
    building: Building,
    lidar: Lidar,
    truth: NDArray[np.float64],
    odometry: NDArray[np.float64],
    rng: np.random.Generator,
) -> Iterator[tuple[Scan, NDArray[np.float64]]]:
    step = lidar.fov_rad / lidar.beams
    angles = -lidar.fov_rad / 2 + step * np.arange(lidar.beams)
    for k, (pose, odo) in enumerate(zip(truth, odometry, strict=True)):
        place = compose(pose, lidar.mount)
        ranges = cast(building.walls, place, place[2] + angles)
        if len(building.glass):
            panes = cast(building.glass, place, place[2] + angles)
            panes[rng.random(len(panes)) > 0.25] = np.inf
            ranges = np.minimum(ranges, panes)
        ranges = ranges + rng.normal(0, lidar.sigma_m, len(ranges))
        ranges[ranges > lidar.range_m] = np.inf
        scan = Scan(
            k * 200_000_000, angles[0], step, ranges.astype(np.float32), 0.05, lidar.range_m,
            lidar.mount,
        )  # fmt: skip
        yield scan, odo


def in_the_open(building: Building, way_m: float) -> Building:
    """The robot starts so far from the building, on open ground, and comes in by a gap."""
    start, wall_x = building.tour[0], building.walls[:, [0, 2]].min()
    gate = box(wall_x, start[1] - 0.7, wall_x, start[1] + 0.7)[1]
    on_wall = (building.walls[:, [0, 2]] == wall_x).all(axis=1)
    bottom, top = building.walls[on_wall][:, [1, 3]].min(), building.walls[on_wall][:, [1, 3]].max()
    sides = [(wall_x, bottom, wall_x, gate[1]), (wall_x, gate[3], wall_x, top)]
    walls = np.concatenate([building.walls[~on_wall], np.array(sides)])
    tour = np.concatenate([[start - (way_m, 0.0)], building.tour])
    return replace(building, walls=walls, tour=tour)


def with_people(log: Log, seed: int, share: float = 0.05) -> Log:
    """Some beams end at people who are elsewhere in every scan."""
    rng = np.random.default_rng(seed)
    records = []
    for scan, odometry in log.records:
        ranges = scan.ranges_m.copy()
        at, count = rng.integers(len(ranges)), int(share * len(ranges))
        ranges[at : at + count] = np.minimum(ranges[at : at + count], rng.uniform(0.5, 3.0))
        records.append((replace(scan, ranges_m=ranges), odometry))
    return Log(records, log.truth)


def with_noise(log: Log, seed: int, share: float = 0.1) -> Log:
    """Of every scan some beams say anything."""
    rng = np.random.default_rng(seed)
    records = []
    for scan, odometry in log.records:
        ranges = scan.ranges_m.copy()
        hit = rng.random(len(ranges)) < share
        farthest = np.minimum(np.where(np.isfinite(ranges), ranges, scan.range_max_m), 10.0)
        ranges[hit] = rng.uniform(0.3, np.maximum(farthest[hit], 0.31))
        records.append((replace(scan, ranges_m=ranges), odometry))
    return Log(records, log.truth)


def without(log: Log, first: int, count: int) -> Log:
    """Scans are lost on the way."""
    return _of(log, [k for k in range(len(log.records)) if not first <= k < first + count])


def carried(log: Log, first: int, count: int) -> Log:
    """From one scan to another the robot is carried: wheels stand, and nothing is seen."""
    steps = _steps(log)
    steps[first : first + count] = 0.0
    seen = [k for k in range(len(log.records)) if not first < k <= first + count]
    return _of(_driven(log, steps), seen)


def slipping(log: Log, first: int, length_m: float, share: float) -> Log:
    """Wheels count another way than the robot goes, for so many metres of its own."""
    steps = _steps(log)
    ways_m = np.cumsum(np.hypot(steps[first:, 0], steps[first:, 1]))
    last = first + int(np.searchsorted(ways_m, length_m))
    steps[first:last, :2] *= share
    return _driven(log, steps)


def early(log: Log, share: float) -> Log:
    """Odometry's clock is ahead of the lidar's, by a share of the time between two scans."""
    odometry = np.array([pose for _, pose in log.records])
    ahead = compose(odometry[:-1], share * _steps(log))
    records = [(scan, pose) for (scan, _), pose in zip(log.records[:-1], ahead, strict=True)]
    return Log([*records, log.records[-1]], log.truth)


def _steps(log: Log) -> NDArray[np.float64]:
    odometry = np.array([pose for _, pose in log.records])
    return np.asarray(between(odometry[:-1], odometry[1:]), dtype=float)


def _driven(log: Log, steps: NDArray[np.float64]) -> Log:
    poses = [log.records[0][1]]
    for step in steps:
        poses.append(compose(poses[-1], step))
    return Log(
        [(scan, pose) for (scan, _), pose in zip(log.records, poses, strict=True)], log.truth
    )


def _of(log: Log, chosen: list[int]) -> Log:
    return Log([log.records[k] for k in chosen], log.truth[chosen])


def mapped(log: Log, parameters: SlamParameters | None = None) -> Slam:
    """What SLAM makes of a log."""
    engine = Slam(parameters)
    for scan, odometry in log.records:
        engine.add(scan, odometry)
    engine.finish()
    return engine
