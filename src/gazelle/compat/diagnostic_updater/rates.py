"""Tasks that watch how often something happens, such as messages of a topic, and how old it is."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any

from gazelle.compat.diagnostic_updater.tasks import (
    IS_ROS1,
    CompositeDiagnosticTask,
    DiagnosticStatus,
    DiagnosticTask,
    seconds,
)
from gazelle.interfaces.stamps import seconds_of

__all__ = [
    "DiagnosedPublisher",
    "FrequencyStatus",
    "FrequencyStatusParam",
    "HeaderlessTopicDiagnostic",
    "Heartbeat",
    "TimeStampStatus",
    "TimeStampStatusParam",
    "TopicDiagnostic",
]


class FrequencyStatusParam:
    """What `FrequencyStatus` goes by.

    Attributes:
        freq_bound: ``min`` and, where there is one, ``max``, in Hz; it may change.
        tolerance: the part by which they may be missed.
        window_size: of how many reports the mean is made.
    """

    def __init__(
        self, freq_bound: Mapping[str, float], tolerance: float = 0.1, window_size: int = 5
    ) -> None:
        self.freq_bound = freq_bound
        self.tolerance = tolerance
        self.window_size = window_size

    def limits_hz(self) -> tuple[float, float | None]:
        """Return the lowest and the highest rate that are taken."""
        high = self.freq_bound.get("max")
        low = self.freq_bound["min"] * (1 - self.tolerance)
        return low, None if high is None else high * (1 + self.tolerance)


class FrequencyStatus(DiagnosticTask):
    """Tells whether something happens as often as it should."""

    def __init__(self, params: FrequencyStatusParam, name: str = "FrequencyStatus") -> None:
        super().__init__(name)
        self.params = params
        self.lock = threading.Lock()
        self.clear()

    def clear(self) -> None:
        """Begin anew."""
        with self.lock:
            self.count = 0
            self.times = [seconds()] * self.params.window_size
            self.seq_nums = [0] * self.params.window_size
            self.hist_indx = 0

    def tick(self) -> None:
        """Count one event."""
        with self.lock:
            self.count += 1

    def run(self, stat: Any) -> Any:
        """Fill in a status: the rate since the report that is `window_size` back."""
        with self.lock:
            now, index = seconds(), self.hist_indx
            events = self.count - self.seq_nums[index]
            window_s = now - self.times[index]
            self.seq_nums[index], self.times[index] = self.count, now
            self.hist_indx = (index + 1) % self.params.window_size
            stat.summary(*self._verdict(events, window_s))
            self._write(stat, events, window_s)
        return stat

    def _verdict(self, events: int, window_s: float) -> tuple[Any, str]:
        low, high = self.params.limits_hz()
        rate = _rate_hz(events, window_s)
        if events == 0:
            return DiagnosticStatus.ERROR, "No events recorded."
        if rate < low:
            return DiagnosticStatus.WARN, "Frequency too low."
        if high is not None and rate > high:
            return DiagnosticStatus.WARN, "Frequency too high."
        return DiagnosticStatus.OK, "Desired frequency met"

    def _write(self, stat: Any, events: int, window_s: float) -> None:
        low, high = self.params.limits_hz()
        bound = self.params.freq_bound
        stat.add("Events in window", events)
        stat.add("Events since startup", self.count)
        stat.add("Duration of window (s)", f"{window_s:f}")
        stat.add("Actual frequency (Hz)", f"{_rate_hz(events, window_s):f}")
        if bound["min"] == bound.get("max"):
            stat.add("Target frequency (Hz)", f"{bound['min']:f}")
        if bound["min"] > 0:
            stat.add("Minimum acceptable frequency (Hz)", f"{low:f}")
        if high is not None:
            stat.add("Maximum acceptable frequency (Hz)", f"{high:f}")


class TimeStampStatusParam:
    """What `TimeStampStatus` goes by: how old stamps may be, in seconds; below 0 is the future."""

    def __init__(self, min_acceptable: float = -1, max_acceptable: float = 5) -> None:
        self.min_acceptable = min_acceptable
        self.max_acceptable = max_acceptable


class TimeStampStatus(DiagnosticTask):
    """Tells whether stamps are near the time at which they come."""

    def __init__(
        self, params: TimeStampStatusParam | None = None, name: str = "Timestamp Status"
    ) -> None:
        super().__init__(name)
        self.params = params or TimeStampStatusParam()
        self.lock = threading.Lock()
        self.early_count = self.late_count = self.zero_count = 0
        self._begin()

    def _begin(self) -> None:
        self.zero_seen = False
        self.deltas_valid = False
        self.max_delta = self.min_delta = 0.0

    def tick(self, stamp: Any) -> None:
        """Note one stamp: a time of rospy or rclpy, or seconds."""
        if hasattr(stamp, "to_sec"):
            stamp = stamp.to_sec()
        elif hasattr(stamp, "nanoseconds"):
            stamp = stamp.nanoseconds * 1e-9
        with self.lock:
            if stamp == 0:
                self.zero_seen = True
                return
            delta = seconds() - stamp
            self.max_delta = max(delta, self.max_delta) if self.deltas_valid else delta
            self.min_delta = min(delta, self.min_delta) if self.deltas_valid else delta
            self.deltas_valid = True

    def run(self, stat: Any) -> Any:
        """Fill in a status: of the stamps since the last one."""
        with self.lock:
            stat.summary(DiagnosticStatus.OK, "Timestamps are reasonable.")
            if self.deltas_valid:
                self._judge(stat)
            else:
                stat.summary(DiagnosticStatus.WARN, "No data since last update.")
            stat.add("Earliest timestamp delay:", f"{self.min_delta:f}")
            stat.add("Latest timestamp delay:", f"{self.max_delta:f}")
            stat.add("Earliest acceptable timestamp delay:", f"{self.params.min_acceptable:f}")
            stat.add("Latest acceptable timestamp delay:", f"{self.params.max_acceptable:f}")
            stat.add("Late diagnostic update count:", self.late_count)
            stat.add("Early diagnostic update count:", self.early_count)
            stat.add("Zero seen diagnostic update count:", self.zero_count)
            self._begin()
        return stat

    def _judge(self, stat: Any) -> None:
        error = DiagnosticStatus.ERROR
        if self.min_delta < self.params.min_acceptable:
            stat.summary(error, "Timestamps too far in future seen.")
            self.early_count += 1
        if self.max_delta > self.params.max_acceptable:
            stat.summary(error, "Timestamps too far in past seen.")
            self.late_count += 1
        if self.zero_seen:
            stat.summary(error, "Zero timestamp seen.")
            self.zero_count += 1


class Heartbeat(DiagnosticTask):
    """Tells that the node runs."""

    def __init__(self) -> None:
        super().__init__("Heartbeat")

    def run(self, stat: Any) -> Any:
        """Fill in a status."""
        stat.summary(DiagnosticStatus.OK, "Alive")
        return stat


class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    """The rate of a topic whose messages have no header."""

    def __init__(self, name: str, diag: Any, freq: FrequencyStatusParam) -> None:
        super().__init__(f"{name} topic status")
        self.diag = diag
        self.freq = FrequencyStatus(freq)
        self.addTask(self.freq)
        self.diag.add(self)

    def tick(self) -> None:
        """Count one message."""
        self.freq.tick()

    def clear_window(self) -> None:
        """Begin to count anew."""
        self.freq.clear()


class TopicDiagnostic(HeaderlessTopicDiagnostic):
    """The rate of a topic, and the stamps of its messages."""

    def __init__(
        self, name: str, diag: Any, freq: FrequencyStatusParam, stamp: TimeStampStatusParam
    ) -> None:
        super().__init__(name, diag, freq)
        self.stamp = TimeStampStatus(stamp)
        self.addTask(self.stamp)

    def tick(self, stamp: Any) -> None:  # type: ignore[override]
        """Count one message with its stamp."""
        self.stamp.tick(stamp)
        super().tick()


class DiagnosedPublisher(TopicDiagnostic):
    """A publisher whose messages are counted."""

    def __init__(
        self, pub: Any, diag: Any, freq: FrequencyStatusParam, stamp: TimeStampStatusParam
    ) -> None:
        super().__init__(pub.name if IS_ROS1 else pub.topic_name, diag, freq, stamp)
        self.publisher = pub

    def publish(self, message: Any) -> None:
        """Count a message and publish it."""
        stamp = message.header.stamp
        if not IS_ROS1:
            stamp = seconds_of(stamp)
        self.tick(stamp)
        self.publisher.publish(message)


def _rate_hz(events: int, window_s: float) -> float:
    """Return the rate; while simulated time stands still there is none."""
    return events / window_s if window_s > 0 else 0.0
