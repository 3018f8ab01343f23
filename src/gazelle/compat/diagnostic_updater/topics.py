"""Tasks of a topic: how often its messages come and how old they are."""

from __future__ import annotations

from typing import Any

from gazelle.compat.diagnostic_updater.rates import (
    FrequencyStatus,
    FrequencyStatusParam,
    TimeStampStatus,
    TimeStampStatusParam,
)
from gazelle.compat.diagnostic_updater.status import IS_ROS1
from gazelle.compat.diagnostic_updater.tasks import CompositeDiagnosticTask
from gazelle.interfaces.stamps import seconds_of

__all__ = ["DiagnosedPublisher", "HeaderlessTopicDiagnostic", "TopicDiagnostic"]


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
