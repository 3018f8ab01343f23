"""Quality of service (rclpy.qos). The graph acts on reliability, durability and depth."""

from __future__ import annotations

import enum
from typing import Any

from gazelle.compat.rclpy.duration import Duration, Infinite
from gazelle.compat.warn_once import warn_once
from gazelle.graph import Qos

__all__ = [
    "DurabilityPolicy",
    "HistoryPolicy",
    "InvalidQoSProfileException",
    "LivelinessPolicy",
    "QoSCompatibility",
    "QoSDurabilityPolicy",
    "QoSHistoryPolicy",
    "QoSLivelinessPolicy",
    "QoSPolicyKind",
    "QoSPresetProfiles",
    "QoSProfile",
    "QoSReliabilityPolicy",
    "ReliabilityPolicy",
    "announced_qos",
    "as_profile",
    "clashing_policy",
    "profile_of",
    "qos_check_compatible",
    "qos_policy_name_from_kind",
    "qos_profile_action_status_default",
    "qos_profile_best_available",
    "qos_profile_default",
    "qos_profile_parameter_events",
    "qos_profile_parameters",
    "qos_profile_rosout_default",
    "qos_profile_sensor_data",
    "qos_profile_services_default",
    "qos_profile_system_default",
    "qos_profile_unknown",
    "tell_unusual_qos",
]


class InvalidQoSProfileException(Exception):  # noqa: N818 - rclpy's name
    """A profile lacks what it needs."""


class _Policy(enum.IntEnum):
    """A policy's kinds, with rclpy's words in small letters."""

    @classmethod
    def short_keys(cls) -> list[str]:
        """Return the words."""
        return [name.lower() for name in cls.__members__ if not name.startswith("RMW")]

    @classmethod
    def get_from_short_key(cls, name: str) -> int:
        """Return a kind's number by its word."""
        return cls[name.upper()].value

    @property
    def short_key(self) -> str:
        """Its word."""
        return self.name.lower()


class HistoryPolicy(_Policy):
    """How many messages are kept; the long names are those of older programs."""

    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2
    UNKNOWN = 3
    RMW_QOS_POLICY_HISTORY_KEEP_LAST = 1
    RMW_QOS_POLICY_HISTORY_KEEP_ALL = 2


class ReliabilityPolicy(_Policy):
    """Whether slow subscriptions are waited for."""

    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4
    RMW_QOS_POLICY_RELIABILITY_RELIABLE = 1
    RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT = 2


class DurabilityPolicy(_Policy):
    """Whether late subscriptions get the last message."""

    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2
    UNKNOWN = 3
    BEST_AVAILABLE = 4
    RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL = 1
    RMW_QOS_POLICY_DURABILITY_VOLATILE = 2


class LivelinessPolicy(_Policy):
    """How a publisher says that it lives."""

    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3
    UNKNOWN = 4
    BEST_AVAILABLE = 5


class QoSPolicyKind(enum.IntEnum):
    """Which policy is meant."""

    INVALID = 1
    DURABILITY = 2
    DEADLINE = 4
    LIVELINESS = 8
    RELIABILITY = 16
    HISTORY = 32
    LIFESPAN = 64
    DEPTH = 128
    LIVELINESS_LEASE_DURATION = 256
    AVOID_ROS_NAMESPACE_CONVENTIONS = 512


class QoSCompatibility(enum.IntEnum):
    """Whether a publisher and a subscription would find each other."""

    OK = 0
    WARNING = 1
    ERROR = 2


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


def announced_qos(profile: QoSProfile) -> Qos:
    """Return what others are told about an end with this profile."""
    keeps_all = profile.history is HistoryPolicy.KEEP_ALL
    return Qos(
        profile.is_reliable,
        profile.is_latched,
        0 if keeps_all else profile.depth or Qos().depth,
        _limit_ns(profile.deadline),
        _limit_ns(profile.lifespan),
        profile.liveliness is LivelinessPolicy.MANUAL_BY_TOPIC,
        _limit_ns(profile.liveliness_lease_duration),
    )


def tell_unusual_qos(what: str, profile: QoSProfile) -> None:
    """Say that services and actions are reliable here, where a profile wants something else.

    How many requests may wait is no such thing: none is dropped, whatever the depth.
    """
    wanted = announced_qos(profile)
    if wanted != Qos(depth=wanted.depth):
        warn_once(f"{what}: its QoS is not heeded; here every request and answer arrives, once")


def profile_of(qos: Qos) -> QoSProfile:
    """Return the profile that another end tells."""
    latched, manual = qos.latched, LivelinessPolicy.MANUAL_BY_TOPIC
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST if qos.depth else HistoryPolicy.KEEP_ALL,
        depth=qos.depth,
        reliability=ReliabilityPolicy.RELIABLE if qos.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
        deadline=_duration_of(qos.deadline_ns),
        lifespan=_duration_of(qos.lifespan_ns),
        liveliness=manual if qos.manual else LivelinessPolicy.AUTOMATIC,
        liveliness_lease_duration=_duration_of(qos.lease_ns),
    )


def clashing_policy(offered: Qos, wanted: Qos) -> QoSPolicyKind | None:
    """Return why DDS would not connect a publisher and a subscription, None when it would.

    Of several policies it is the one with the highest number in DDS, as Fast DDS tells.
    """
    if wanted.reliable and not offered.reliable:
        return QoSPolicyKind.RELIABILITY
    if (wanted.manual and not offered.manual) or _is_longer(offered.lease_ns, wanted.lease_ns):
        return QoSPolicyKind.LIVELINESS
    if _is_longer(offered.deadline_ns, wanted.deadline_ns):
        return QoSPolicyKind.DEADLINE
    if wanted.latched and not offered.latched:
        return QoSPolicyKind.DURABILITY
    return None


def _is_longer(offered_ns: int, wanted_ns: int) -> bool:
    return wanted_ns > 0 and not 0 < offered_ns <= wanted_ns


def _limit_ns(limit: Duration) -> int:
    return 0 if limit == Infinite else max(limit.nanoseconds, 0)


def _duration_of(limit_ns: int) -> Duration:
    return Duration(nanoseconds=limit_ns) if limit_ns else Infinite


def qos_policy_name_from_kind(policy_kind: QoSPolicyKind | int) -> str:
    """Return a policy's name."""
    return QoSPolicyKind(policy_kind).name


def qos_check_compatible(
    publisher_qos: QoSProfile, subscription_qos: QoSProfile
) -> tuple[QoSCompatibility, str]:
    """Tell whether transports of ROS 2 would connect two ends, and why not.

    Gazelle's own graph connects them in any case.
    """
    faults = []
    if subscription_qos.is_reliable and not publisher_qos.is_reliable:
        faults.append("ERROR: Best effort publisher and reliable subscription;")
    if subscription_qos.is_latched and not publisher_qos.is_latched:
        faults.append("ERROR: Volatile publisher and transient local subscription;")
    wanted, offered = subscription_qos.deadline, publisher_qos.deadline
    if wanted != Infinite and offered == Infinite:
        faults.append("ERROR: Subscription has a deadline, but publisher does not;")
    elif wanted < offered:
        faults.append("ERROR: Subscription deadline is less than publisher deadline;")
    return (QoSCompatibility.ERROR if faults else QoSCompatibility.OK), "".join(faults)


qos_profile_unknown = QoSProfile(
    history=HistoryPolicy.UNKNOWN,
    reliability=ReliabilityPolicy.UNKNOWN,
    durability=DurabilityPolicy.UNKNOWN,
    liveliness=LivelinessPolicy.UNKNOWN,
)
qos_profile_rosout_default = QoSProfile(
    depth=1000,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
    lifespan=Duration(seconds=10),
)
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

    UNKNOWN = qos_profile_unknown
    DEFAULT = qos_profile_default
    SYSTEM_DEFAULT = qos_profile_system_default
    SENSOR_DATA = qos_profile_sensor_data
    SERVICES_DEFAULT = qos_profile_services_default
    PARAMETERS = qos_profile_parameters
    PARAMETER_EVENTS = qos_profile_parameter_events
    ACTION_STATUS_DEFAULT = qos_profile_action_status_default
    BEST_AVAILABLE = qos_profile_best_available
    ROSOUT_DEFAULT = qos_profile_rosout_default

    @classmethod
    def short_keys(cls) -> list[str]:
        """Return the names in small letters."""
        return [name.lower() for name in cls.__members__]

    @classmethod
    def get_from_short_key(cls, name: str) -> QoSProfile:
        """Return a profile by its name in small letters."""
        profile: QoSProfile = cls[name.upper()].value
        return profile
