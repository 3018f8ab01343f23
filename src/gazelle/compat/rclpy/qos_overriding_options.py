"""Qualities of service that users may change by parameters (rclpy.qos_overriding_options)."""

from __future__ import annotations

import copy
import enum
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from gazelle.compat.rclpy.duration import Duration
from gazelle.compat.rclpy.qos import QoSPolicyKind, QoSProfile
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces import message_type

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = [
    "InvalidQosOverridesError",
    "QoSOverridingOptions",
    "QosCallbackResult",
    "overridden",
]

QosCallbackResult = message_type("rcl_interfaces/msg/SetParametersResult")


class InvalidQosOverridesError(Exception):
    """A program's own check refused the overrides."""


class QoSOverridingOptions:
    """Which policies become parameters ``qos_overrides.TOPIC.publisher.POLICY``.

    Args:
        policy_kinds: the policies.
        callback: judges the profile with a ``SetParametersResult``.
        entity_id: tells several publishers of one topic apart.
    """

    def __init__(
        self,
        policy_kinds: Iterable[QoSPolicyKind],
        *,
        callback: Callable[[QoSProfile], Any] | None = None,
        entity_id: str | None = None,
    ) -> None:
        self.policy_kinds = tuple(policy_kinds)
        self.callback = callback
        self.entity_id = entity_id

    @classmethod
    def with_default_policies(
        cls,
        *,
        callback: Callable[[QoSProfile], Any] | None = None,
        entity_id: str | None = None,
    ) -> QoSOverridingOptions:
        """Return options for history, depth and reliability."""
        kinds = (QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY)
        return cls(kinds, callback=callback, entity_id=entity_id)


def overridden(
    node: Node, topic: str, kind: str, qos: QoSProfile, options: QoSOverridingOptions | None
) -> QoSProfile:
    """Return a profile after its parameters, which are declared read-only.

    Args:
        node: holds the parameters.
        topic: global name.
        kind: ``publisher`` or ``subscription``.
        qos: the defaults.
        options: None for no parameters.

    Raises:
        InvalidQosOverridesError: the program's check refuses the result.
        RuntimeError: a parameter names no such policy.
    """
    if options is None:
        return qos
    changed = copy.copy(qos)
    suffix = "" if options.entity_id is None else f"_{options.entity_id}"
    base = f"qos_overrides.{topic}.{kind}{suffix}"
    about = f"for {kind} `{topic}` with id `{options.entity_id}`"
    for policy in options.policy_kinds:
        policy_name = policy.name.lower()
        if policy_name == "lifespan" and kind == "subscription":
            continue
        _override(node, f"{base}.{policy_name}", policy_name, changed, f"{policy_name} {about}")
    if options.callback is not None:
        result = options.callback(changed)
        if not result.successful:
            text = f"Provided QoS overrides {about}, are not valid: {result.reason}"
            raise InvalidQosOverridesError(text)
    return changed


def _override(node: Node, name: str, policy_name: str, qos: QoSProfile, description: str) -> None:
    present = getattr(qos, policy_name)
    if not node.has_parameter(name):
        descriptor = message_type("rcl_interfaces/msg/ParameterDescriptor")
        about = descriptor(description=description, read_only=True)
        node.declare_parameter(name, _as_parameter(present), about)
    value = node.get_parameter(name).value
    if isinstance(present, enum.IntEnum):
        known = type(present).short_keys()  # type: ignore[attr-defined]
        if value not in known:
            hint = did_you_mean(str(value), known)
            raise RuntimeError(
                f"Unexpected QoS override for policy `{policy_name}`: `{value}`; {hint}"
            )
        value = type(present)[value.upper()]
    elif isinstance(present, Duration):
        value = Duration(nanoseconds=value)
    setattr(qos, policy_name, value)


def _as_parameter(value: Any) -> Any:
    if isinstance(value, enum.IntEnum):
        return value.name.lower()
    return value.nanoseconds if isinstance(value, Duration) else value
