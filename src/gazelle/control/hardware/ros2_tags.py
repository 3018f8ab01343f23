"""``<ros2_control>`` blocks as values."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from gazelle.description.model import Model, Ros2ControlTag
from gazelle.description.urdf_reader.attributes import check_vocabulary
from gazelle.description.xml import Tag
from gazelle.description.xml.numbers import bool_from
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean

__all__ = ["HardwareTag", "InterfaceTag", "PartTag", "read_hardware_tags"]

_PARTS = ("joint", "sensor", "gpio")
_TYPES = ("system", "actuator", "sensor")


@dataclass(frozen=True, slots=True)
class InterfaceTag:
    """A ``<command_interface>`` or ``<state_interface>``.

    Attributes:
        lower, upper: ``min`` and ``max``; infinite when absent or switched off.
        initial: ``initial_value``, None when absent.
        span: of the element, None where there is none.
    """

    name: str
    lower: float = -math.inf
    upper: float = math.inf
    initial: float | None = None
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class PartTag:
    """A ``<joint>``, ``<sensor>`` or ``<gpio>``.

    Attributes:
        kind: the element's name.
        may_mimic: False when the attribute ``mimic`` says so.
    """

    kind: str
    name: str
    commands: tuple[InterfaceTag, ...]
    states: tuple[InterfaceTag, ...]
    parameters: Mapping[str, str]
    span: SourceSpan
    may_mimic: bool = True


@dataclass(frozen=True, slots=True)
class HardwareTag:
    """A whole block.

    Attributes:
        plugin: class of the hardware, empty when the block names none.
    """

    name: str
    type: str
    plugin: str
    span: SourceSpan
    parameters: Mapping[str, str] = field(default_factory=dict)
    parts: tuple[PartTag, ...] = ()

    def of_kind(self, kind: str) -> tuple[PartTag, ...]:
        """Return the joints, sensors or gpios."""
        return tuple(part for part in self.parts if part.kind == kind)


def read_hardware_tags(model: Model, diagnostics: Diagnostics) -> tuple[HardwareTag, ...]:
    """Return the blocks of a model, in the order of the file; what is wrong is reported."""
    return tuple(
        _each_once(_read_block(tag, diagnostics), diagnostics) for tag in model.ros2_controls
    )


def _each_once(block: HardwareTag, diagnostics: Diagnostics) -> HardwareTag:
    """Leave out parts that stand in a block again: the resource manager throws at them.

    Another block may have the same joints: that of other hardware, of which one is started.
    """
    parts: dict[tuple[str, str], PartTag] = {}
    for part in block.parts:
        key = part.kind, part.name
        if key not in parts:
            parts[key] = part
            continue
        text = f"<{part.kind}> '{part.name}' stands twice in hardware '{block.name}'; the second "
        text += "one is left out (real ROS 2: its interfaces already exist)"
        diagnostics.report("control.ros2-control-twice", text, part.span)
    return replace(block, parts=tuple(parts.values()))


def _read_block(block: Ros2ControlTag, diagnostics: Diagnostics) -> HardwareTag:
    tag = block.element
    check_vocabulary(
        tag,
        diagnostics,
        attributes=("name", "type", "is_async", "rw_rate", "thread_priority"),
        children=("hardware", "joint", "sensor", "gpio", "transmission", "limits", "group"),
        once=("hardware",),
    )
    if block.type not in _TYPES:
        text = f"hardware '{block.name}' is of type '{block.type}'; it is taken as a system"
        hint = did_you_mean(block.type, _TYPES)
        diagnostics.report("control.ros2-control-value", text, tag.span, fix=hint)
    if tag.find("transmission") is not None:
        text = f"transmissions of hardware '{block.name}' have no effect on simulated joints, as in"
        text += " Gazebo: controllers drive the joints themselves"
        diagnostics.report("control.transmission-idle", text, tag.span)
    hardware = tag.find("hardware")
    plugin, parameters = "", {}
    if hardware is not None:
        known = ("plugin", "param", "group", "properties")
        check_vocabulary(hardware, diagnostics, children=known, once=("plugin",))
        plugin = hardware.text_of("plugin").strip()
        parameters = _parameters(hardware)
    limited = _enabled(tag.find("limits"), diagnostics)
    parts = tuple(
        _read_part(child, limited, diagnostics) for child in tag.children if child.name in _PARTS
    )
    return HardwareTag(block.name, block.type, plugin, tag.span, parameters, parts)


def _read_part(tag: Tag, limited: bool, diagnostics: Diagnostics) -> PartTag:
    check_vocabulary(
        tag,
        diagnostics,
        attributes=("name", "mimic"),
        children=("command_interface", "state_interface", "param", "limits", "properties"),
    )
    limited = limited and _enabled(tag.find("limits"), diagnostics)

    def interfaces(name: str) -> tuple[InterfaceTag, ...]:
        found = (_read_interface(item, limited, diagnostics) for item in tag.find_all(name))
        return tuple(item for item in found if item.name)

    return PartTag(
        tag.name,
        tag.attributes.get("name", "").strip(),
        interfaces("command_interface"),
        interfaces("state_interface"),
        _parameters(tag),
        tag.span,
        tag.attributes.get("mimic", "").strip().lower() != "false",
    )


def _read_interface(tag: Tag, limited: bool, diagnostics: Diagnostics) -> InterfaceTag:
    check_vocabulary(
        tag,
        diagnostics,
        attributes=("name", "data_type", "size"),
        children=("param", "limits"),
    )
    values = _parameters(tag)
    limited = limited and _enabled(tag.find("limits"), diagnostics)
    numbers = {
        key: _number(values[key], key, tag, diagnostics)
        for key in ("min", "max", "initial_value")
        if key in values
    }
    lower, upper = numbers.get("min"), numbers.get("max")
    return InterfaceTag(
        tag.attributes.get("name", "").strip(),
        -math.inf if lower is None or not limited else lower,
        math.inf if upper is None or not limited else upper,
        numbers.get("initial_value"),
        tag.span,
    )


def _parameters(tag: Tag) -> dict[str, str]:
    return {item.attributes.get("name", ""): item.text.strip() for item in tag.find_all("param")}


def _number(text: str, key: str, tag: Tag, diagnostics: Diagnostics) -> float | None:
    words = {"true": 1.0, "false": 0.0}
    try:
        return words[text.lower()] if text.lower() in words else float(text)
    except ValueError:
        name = tag.attributes.get("name", "")
        message = f"{key} of interface '{name}' is '{text}', not a number; it is left out"
        diagnostics.report("control.ros2-control-value", message, tag.span)
        return None


def _enabled(limits: Tag | None, diagnostics: Diagnostics) -> bool:
    """Return what ``<limits enable="…"/>`` says; True when it is absent."""
    if limits is None or "enable" not in limits.attributes:
        return True
    word = Tag(limits.name, limits.span, text=limits.attributes["enable"])
    return bool_from(word, True, diagnostics)
