"""Quality of service (rclpy.qos). The graph acts on reliability, durability and depth."""

from __future__ import annotations

import enum
from typing import Any

from gazelle.compat.rclpy.duration import Duration, Infinite

__all__ = [
    "DurabilityPolicy",
    "HistoryPolicy",
    "InvalidQoSProfileException",
    "LivelinessPolicy",
    "QoSDurabilityPolicy",
    "QoSHistoryPolicy",
    "QoSLivelinessPolicy",
    "QoSPresetProfiles",
    "QoSProfile",
    "QoSReliabilityPolicy",
    "ReliabilityPolicy",
    "as_profile",
    "qos_profile_action_status_default",
    "qos_profile_best_available",
    "qos_profile_default",
    "qos_profile_parameter_events",
    "qos_profile_parameters",
    "qos_profile_sensor_data",
    "qos_profile_services_default",
    "qos_profile_system_default",
]


class InvalidQoSProfileException(Exception):  # noqa: N818 - rclpy's name
    """A profile lacks what it needs."""


class HistoryPolicy(enum.IntEnum):
    """How many messages are kept; the long names are those of older programs."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3
    RMW_QOS_POLICY_HISTORY_KEEP_LAST = 1
    RMW_QOS_POLICY_HISTORY_KEEP_ALL = 2


class ReliabilityPolicy(enum.IntEnum):
    """Whether slow subscriptions are waited for."""

    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4
    RMW_QOS_POLICY_RELIABILITY_RELIABLE = 1
    RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT = 2


class DurabilityPolicy(enum.IntEnum):
    """Whether late subscriptions get the last message."""

    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4
    RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL = 1
    RMW_QOS_POLICY_DURABILITY_VOLATILE = 2


class LivelinessPolicy(enum.IntEnum):
    """How a publisher says that it lives."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5


QoSHistoryPolicy = HistoryPolicy
QoSReliabilityPolicy = ReliabilityPolicy
QoSDurabilityPolicy = DurabilityPolicy
QoSLivelinessPolicy = LivelinessPolicy

_DEFAULTS: dict[str, Any] = {
    "reliability": ReliabilityPolicy.RELIABLE,
    "durability": DurabilityPolicy.VOLATILE,
    "lifespan": Infinite,
    "deadline": Infinite,
    "liveliness": LivelinessPolicy.AUTOMATIC,
    "liveliness_lease_duration": Infinite,
    "avoid_ros_namespace_conventions": False,
}


class QoSProfile:
    """A quality of service.

    Args:
        history, depth: one of them at least.
        reliability, durability, lifespan, deadline, liveliness, liveliness_lease_duration,
            avoid_ros_namespace_conventions: the rest, by name.

    Raises:
        InvalidQoSProfileException: neither history nor depth, or no depth to keep.
    """

    def __init__(self, **kwargs: Any) -> None:
        unknown = set(kwargs) - {"history", "depth", *_DEFAULTS}
        if unknown:
            raise AssertionError(f"Unknown QoS setting(s): {', '.join(sorted(unknown))}")
        if "history" not in kwargs and "depth" not in kwargs:
            raise InvalidQoSProfileException("History and/or depth settings are required.")
        history = HistoryPolicy(kwargs.get("history", HistoryPolicy.KEEP_LAST))
        if history is HistoryPolicy.KEEP_LAST and "depth" not in kwargs:
            raise InvalidQoSProfileException("History set to KEEP_LAST without a depth setting.")
        values = _DEFAULTS | kwargs
        self.history = history
        self.depth = int(kwargs.get("depth", 0))
        self.reliability = ReliabilityPolicy(values["reliability"])
        self.durability = DurabilityPolicy(values["durability"])
        self.lifespan: Duration = values["lifespan"]
        self.deadline: Duration = values["deadline"]
        self.liveliness = LivelinessPolicy(values["liveliness"])
        self.liveliness_lease_duration: Duration = values["liveliness_lease_duration"]
        self.avoid_ros_namespace_conventions = bool(values["avoid_ros_namespace_conventions"])

    @property
    def is_reliable(self) -> bool:
        """True when slow subscriptions are waited for."""
        return self.reliability is not ReliabilityPolicy.BEST_EFFORT

    @property
    def is_latched(self) -> bool:
        """True when late subscriptions get the last message."""
        return self.durability is DurabilityPolicy.TRANSIENT_LOCAL

    def __eq__(self, other: object) -> bool:
        return isinstance(other, QoSProfile) and vars(self) == vars(other)

    def __hash__(self) -> int:
        return hash((self.history, self.depth, self.reliability, self.durability))

    def __repr__(self) -> str:
        inner = ", ".join(f"{name}={value!r}" for name, value in vars(self).items())
        return f"QoSProfile({inner})"


def as_profile(qos: QoSProfile | int) -> QoSProfile:
    """Return a profile, or that of a queue's depth.

    Raises:
        TypeError: it is neither.
        ValueError: the depth is negative.
    """
    if isinstance(qos, QoSProfile):
        return qos
    if isinstance(qos, bool) or not isinstance(qos, int):
        raise TypeError("Expected QoSProfile or int, but received " + repr(type(qos)))
    if qos < 0:
        raise ValueError("history depth must be greater than or equal to zero")
    return QoSProfile(depth=qos)


qos_profile_default = QoSProfile(depth=10)
qos_profile_system_default = QoSProfile(
    history=HistoryPolicy.SYSTEM_DEFAULT,
    reliability=ReliabilityPolicy.SYSTEM_DEFAULT,
    durability=DurabilityPolicy.SYSTEM_DEFAULT,
)
qos_profile_sensor_data = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
qos_profile_services_default = QoSProfile(depth=10)
qos_profile_parameters = QoSProfile(depth=1000)
qos_profile_parameter_events = QoSProfile(depth=1000)
qos_profile_action_status_default = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
qos_profile_best_available = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.BEST_AVAILABLE,
    durability=DurabilityPolicy.BEST_AVAILABLE,
)


class QoSPresetProfiles(enum.Enum):
    """The profiles above, by name."""

    DEFAULT = qos_profile_default
    SYSTEM_DEFAULT = qos_profile_system_default
    SENSOR_DATA = qos_profile_sensor_data
    SERVICES_DEFAULT = qos_profile_services_default
    PARAMETERS = qos_profile_parameters
    PARAMETER_EVENTS = qos_profile_parameter_events
    ACTION_STATUS_DEFAULT = qos_profile_action_status_default
    BEST_AVAILABLE = qos_profile_best_available

    @classmethod
    def get_from_short_key(cls, name: str) -> QoSProfile:
        """Return a profile by its name in small letters."""
        profile: QoSProfile = cls[name.upper()].value
        return profile
