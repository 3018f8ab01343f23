# mypy: ignore-errors
# ruff: noqa: ANN001, ANN201, ANN202
"""The compiled loops of localisation; see `gazelle.navigation.costmap.costmap_kernels`."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gazelle.kernels import kernel

__all__ = [
    "ParticleNeed",
    "beam_likelihoods",
    "cast_ray",
    "field_sums",
    "fitting_shares",
    "log_sums",
    "resample",
]


class ParticleNeed(NamedTuple):
    """How many particles a distribution needs (KLD sampling).

    Attributes:
        least: at least so many.
        most: at most.
        error: of the distribution that is allowed.
        quantile: of that error.
    """

    least: int
    most: int
    error: float
    quantile: float


@kernel(flags="fast")
def field_sums(particles, ends, field, outside, frame, out):
    """Fill `out` with 1 + the sum of a field at the ends of beams, by particle.

    `ends` are (n, 2) in the robot's frame, m; `field` has a value by cell, `outside` that of
    everything else; cells are where a `field.MapFrame` says.
    """
    ox, oy, inverse = frame.x_m, frame.y_m, frame.per_m
    height, width = field.shape
    for k in range(particles.shape[0]):
        c = math.cos(particles[k, 2]) * inverse
        s = math.sin(particles[k, 2]) * inverse
        x = (particles[k, 0] - ox) * inverse
        y = (particles[k, 1] - oy) * inverse
        total = np.float32(1.0)
        for b in range(ends.shape[0]):
            u = x + c * ends[b, 0] - s * ends[b, 1]
            v = y + s * ends[b, 0] + c * ends[b, 1]
            if u >= 0.0 and v >= 0.0 and u < width and v < height:
                total += field[int(v), int(u)]
            else:
                total += outside
        out[k] = total


@kernel(flags="fast")
def log_sums(particles, ends, used, field, outside, frame, out):
    """Fill `out` with the sum of a field at the ends of the beams that are used."""
    ox, oy, inverse = frame.x_m, frame.y_m, frame.per_m
    height, width = field.shape
    for k in range(particles.shape[0]):
        c = math.cos(particles[k, 2]) * inverse
        s = math.sin(particles[k, 2]) * inverse
        x = (particles[k, 0] - ox) * inverse
        y = (particles[k, 1] - oy) * inverse
        total = 0.0
        for b in range(ends.shape[0]):
            if not used[b]:
                continue
            u = x + c * ends[b, 0] - s * ends[b, 1]
            v = y + s * ends[b, 0] + c * ends[b, 1]
            if u >= 0.0 and v >= 0.0 and u < width and v < height:
                total += field[int(v), int(u)]
            else:
                total += outside
        out[k] = total


@kernel
def fitting_shares(particles, ends, distances, near, frame):
    """Return, by beam, the share of particles for which it ends nearer to a wall than `near`."""
    ox, oy, inverse = frame.x_m, frame.y_m, frame.per_m
    height, width = distances.shape
    count = ends.shape[0]
    shares = np.zeros(count)
    for k in range(particles.shape[0]):
        c = math.cos(particles[k, 2])
        s = math.sin(particles[k, 2])
        for b in range(count):
            u = math.floor((particles[k, 0] + c * ends[b, 0] - s * ends[b, 1] - ox) * inverse)
            v = math.floor((particles[k, 1] + s * ends[b, 0] + c * ends[b, 1] - oy) * inverse)
            if u >= 0 and v >= 0 and u < width and v < height and distances[v, u] < near:
                shares[b] += 1.0
    for b in range(count):
        shares[b] /= max(particles.shape[0], 1)
    return shares


@kernel
def cast_ray(cells, x, y, angle, most):
    """Return how far a ray goes until a cell that is not free, everything in cells.

    Cells are gone through one by one (Amanatides and Woo 1987); outside of the map the ray ends.
    """
    height, width = cells.shape
    dx = math.cos(angle)
    dy = math.sin(angle)
    u = math.floor(x)
    v = math.floor(y)
    sx = 1 if dx > 0 else -1
    sy = 1 if dy > 0 else -1
    per_x = abs(1.0 / dx) if dx != 0.0 else 1e18
    per_y = abs(1.0 / dy) if dy != 0.0 else 1e18
    next_x = ((u + 1 - x) if dx > 0 else (x - u)) * per_x
    next_y = ((v + 1 - y) if dy > 0 else (y - v)) * per_y
    gone = 0.0
    while gone < most:
        if u < 0 or v < 0 or u >= width or v >= height or cells[v, u] != 0:
            return gone
        if next_x < next_y:
            gone = next_x
            next_x += per_x
            u += sx
        else:
            gone = next_y
            next_y += per_y
            v += sy
    return most


@kernel
def beam_likelihoods(particles, beams, cells, frame, terms, out):
    """Fill `out` with 1 + the sum of cubed likelihoods of beams, by particle.

    Args:
        particles: (n, 3).
        beams: `sensor.Beams`.
        cells: those that are not 0 are not free.
        frame: where they are, a `field.MapFrame`.
        terms: what a beam can have met, `sensor.BeamTerms`.
        out: (n,).
    """
    laser, bearings, ranges, longest = (
        beams.laser, beams.bearings_rad, beams.ranges_m, beams.longest_m,
    )  # fmt: skip
    ox, oy, resolution, sigma = frame.x_m, frame.y_m, frame.cell_m, terms.sigma_m
    for k in range(particles.shape[0]):
        c = math.cos(particles[k, 2])
        s = math.sin(particles[k, 2])
        x = (particles[k, 0] + c * laser[0] - s * laser[1] - ox) / resolution
        y = (particles[k, 1] + s * laser[0] + c * laser[1] - oy) / resolution
        total = 1.0
        for b in range(bearings.shape[0]):
            seen = ranges[b]
            there = resolution * cast_ray(
                cells, x, y, particles[k, 2] + bearings[b], longest / resolution
            )
            off = seen - there
            p = terms.hit * math.exp(-off * off / (2 * sigma * sigma))
            if off < 0:
                p += terms.short * terms.short_per_m * math.exp(-terms.short_per_m * seen)
            if seen >= longest:
                p += terms.longest
            else:
                p += terms.random / longest
            total += p * p * p
        out[k] = total


@kernel
def _place(cumulative, chance):
    """Return how many of the running sums are not greater."""
    low, high = 0, cumulative.shape[0]
    while low < high:
        middle = (low + high) >> 1
        if cumulative[middle] <= chance:
            low = middle + 1
        else:
            high = middle
    return low


@kernel
def resample(particles, cumulative, chances, draws, elsewhere, need):
    """Return so many particles as the spread of what is drawn needs (KLD sampling, Fox 2001).

    Args:
        particles: (n, 3).
        cumulative: running sum of weights, the last one 1.
        chances: uniform numbers, one per particle; below `elsewhere` a random pose is taken.
        draws: particles to take where `chances` are not below, by uniform numbers, and the random
            poses, as columns u, x, y, yaw.
        elsewhere: share of random poses.
        need: how many there have to be, a `ParticleNeed`.
    """
    least, most, error, quantile = need.least, need.most, need.error, need.quantile
    size = 1 << 16
    while size < 4 * most:
        size *= 2
    mask = size - 1
    table = np.empty(size, np.int64)
    for k in range(size):
        table[k] = -1
    drawn = np.empty((most, 3))
    bins = 0
    count = 0
    while count < most:
        if chances[count] < elsewhere:
            drawn[count, 0] = draws[count, 1]
            drawn[count, 1] = draws[count, 2]
            drawn[count, 2] = draws[count, 3]
        else:
            source = min(_place(cumulative, draws[count, 0]), particles.shape[0] - 1)
            drawn[count, 0] = particles[source, 0]
            drawn[count, 1] = particles[source, 1]
            drawn[count, 2] = particles[source, 2]
        yaw = math.atan2(math.sin(drawn[count, 2]), math.cos(drawn[count, 2]))
        a = math.floor(drawn[count, 0] / 0.5) + 1048576
        b = math.floor(drawn[count, 1] / 0.5) + 1048576
        key = (a * 2097152 + b) * 64 + math.floor(yaw / 0.17453292519943295) + 32
        count += 1
        slot = (key * 2654435761) & mask
        while table[slot] != -1 and table[slot] != key:
            slot = (slot + 1) & mask
        if table[slot] == -1:
            table[slot] = key
            bins += 1
        if bins > 1 and count >= least:
            spread = 2.0 / (9.0 * (bins - 1))
            root = 1.0 - spread + math.sqrt(spread) * quantile
            if count > (bins - 1) / (2.0 * error) * root * root * root:
                break
    return drawn[:count].copy()
