"""Where one frame was over time, seen from its parent."""

from __future__ import annotations

import math
from bisect import bisect_left
from typing import NamedTuple

from gazelle.geometry import Pose
from gazelle.graph.tf.exceptions import ExtrapolationError

__all__ = ["Added", "History", "Sample", "StaticHistory", "interpolate"]

Added = str
"""Empty when a sample was taken, else tf2's word for why not."""

_NEARLY_PARALLEL = 1.0 - 1e-9


class Sample(NamedTuple):
    """A frame at one time: parent frame and ``T_parent_child``."""

    stamp_ns: int
    parent: str
    pose: Pose


class StaticHistory:
    """A frame that never moves; only the last sample counts."""

    is_static = True

    def __init__(self, sample: Sample) -> None:
        self._sample = sample

    def __len__(self) -> int:
        return 1

    @property
    def latest(self) -> Sample:
        """The sample, with time 0."""
        return self._sample._replace(stamp_ns=0)

    @property
    def oldest_ns(self) -> int:
        """Always 0."""
        return 0

    def add(self, sample: Sample, cache_ns: int) -> Added:
        """Replace the sample."""
        self._sample = sample
        return ""

    def at(self, stamp_ns: int) -> Sample:
        """Return the sample, whatever the time."""
        return self._sample._replace(stamp_ns=stamp_ns)


class History:
    """Samples in order of time, those older than the cache time dropped."""

    is_static = False

    def __init__(self, sample: Sample) -> None:
        self._samples = [sample]
        self._stamps = [sample.stamp_ns]

    def __len__(self) -> int:
        return len(self._samples)

    @property
    def latest(self) -> Sample:
        """The newest sample."""
        return self._samples[-1]

    @property
    def oldest_ns(self) -> int:
        """Time of the oldest sample."""
        return self._stamps[0]

    def add(self, sample: Sample, cache_ns: int) -> Added:
        """Insert a sample; late ones find their place."""
        stamps, stamp_ns = self._stamps, sample.stamp_ns
        if stamp_ns > stamps[-1]:
            stamps.append(stamp_ns)
            self._samples.append(sample)
        elif stamp_ns + cache_ns < stamps[-1]:
            return "TF_OLD_DATA"
        else:
            index = bisect_left(stamps, stamp_ns)
            if stamps[index] == stamp_ns:
                return "TF_REPEATED_DATA"
            stamps.insert(index, stamp_ns)
            self._samples.insert(index, sample)
        kept = bisect_left(stamps, stamps[-1] - cache_ns)
        if kept:
            del stamps[:kept], self._samples[:kept]
        return ""

    def at(self, stamp_ns: int) -> Sample:
        """Return the frame at a time, between samples interpolated; time 0 is the newest.

        Raises:
            ExtrapolationError: the time is before the first or after the last sample.
        """
        stamps = self._stamps
        if stamp_ns == 0:
            return self._samples[-1]
        index = bisect_left(stamps, stamp_ns)
        if index < len(stamps) and stamps[index] == stamp_ns:
            return self._samples[index]
        if index == 0 or index == len(stamps):
            raise ExtrapolationError(self._outside(stamp_ns), is_past=index == 0)
        before, after = self._samples[index - 1], self._samples[index]
        if before.parent != after.parent:
            return before
        ratio = (stamp_ns - before.stamp_ns) / (after.stamp_ns - before.stamp_ns)
        return Sample(stamp_ns, before.parent, interpolate(before.pose, after.pose, ratio))

    def _outside(self, stamp_ns: int) -> str:
        asked, oldest, newest = (
            _seconds(one) for one in (stamp_ns, self._stamps[0], self._stamps[-1])
        )
        if len(self._stamps) == 1:
            return (
                f"Lookup would require extrapolation at time {asked}, but only time {oldest} is in "
                "the buffer"
            )
        if stamp_ns > self._stamps[-1]:
            return (
                f"Lookup would require extrapolation {_seconds(stamp_ns - self._stamps[-1])}s into "
                f"the future.  Requested time {asked} but the latest data is at time {newest}"
            )
        return (
            f"Lookup would require extrapolation {_seconds(self._stamps[0] - stamp_ns)}s into the "
            f"past.  Requested time {asked} but the earliest data is at time {oldest}"
        )


def interpolate(first: Pose, second: Pose, ratio: float) -> Pose:
    """Return the pose at a ratio of the way: positions linearly, orientations on the great arc."""
    a, b = first.position_m, second.position_m
    x, y, z = (p + ratio * (q - p) for p, q in zip(a, b, strict=True))
    return Pose((x, y, z), _slerp(first.quat_xyzw, second.quat_xyzw, ratio))


def _slerp(
    first: tuple[float, float, float, float],
    second: tuple[float, float, float, float],
    ratio: float,
) -> tuple[float, float, float, float]:
    """Shoemake 1985, along the shorter arc."""
    dot = sum(p * q for p, q in zip(first, second, strict=True))
    sign = -1.0 if dot < 0 else 1.0
    dot *= sign
    if dot > _NEARLY_PARALLEL:
        start, end = 1 - ratio, ratio * sign
    else:
        angle = math.acos(dot)
        start = math.sin((1 - ratio) * angle) / math.sin(angle)
        end = sign * math.sin(ratio * angle) / math.sin(angle)
    x, y, z, w = (start * p + end * q for p, q in zip(first, second, strict=True))
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    return (x / norm, y / norm, z / norm, w / norm)


def _seconds(stamp_ns: int) -> str:
    return f"{stamp_ns // 1_000_000_000}.{stamp_ns % 1_000_000_000:09d}"
