"""Names without ``::``, which only nested models of SDF have."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from gazelle.description.model import Joint, Link, Model, PluginTag
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics

__all__ = ["free_name", "part_names", "with_plain_names"]

_SCOPE = "::"


def with_plain_names(model: Model, diagnostics: Diagnostics) -> Model:
    """Return the model with ``arm::hand`` called ``arm_hand`` wherever it is named.

    sdformat refuses ``::`` in a name, and tf2 and ROS parameters cannot use it well. Plug-ins of a
    nested model name its parts without its scope; these are written in full too.

    Args:
        model: its nested models flattened.
        diagnostics: receives ``convert.renamed``.
    """
    model = replace(model, name=model.name.replace(_SCOPE, "_"))
    names = part_names(model)
    scoped = [name for name in names if _SCOPE in name]
    if not scoped:
        return model
    taken = set(names).difference(scoped)
    renamed: dict[str, str] = {}
    for name in scoped:
        renamed[name] = free_name(name.replace(_SCOPE, "_"), taken)
        taken.add(renamed[name])
    shown = ", ".join(f"'{old}' is '{new}'" for old, new in list(renamed.items())[:3])
    message = f"names of nested models are written with '_' for '::': {shown}"
    more = f" and {len(renamed) - 3} more" if len(renamed) > 3 else ""
    diagnostics.report("convert.renamed", message + more, model.span)
    return _renamed(model, renamed)


def part_names(model: Model) -> tuple[str, ...]:
    """Return the names of a model's links, joints and frames, each once."""
    names = [link.name for link in model.links]
    names += [joint.name for joint in model.joints]
    names += [frame.name for frame in model.frames]
    return tuple(dict.fromkeys(names))


def free_name(wanted: str, taken: Iterable[str]) -> str:
    """Return the name, numbered when it is taken."""
    known = set(taken)
    name, number = wanted, 2
    while name in known:
        name, number = f"{wanted}_{number}", number + 1
    return name


def _renamed(model: Model, names: Mapping[str, str]) -> Model:
    def name(old: str) -> str:
        return names.get(old, old)

    return replace(
        model,
        links=tuple(_renamed_link(link, names) for link in model.links),
        joints=tuple(_renamed_joint(joint, names) for joint in model.joints),
        frames=tuple(
            replace(frame, name=name(frame.name), attached_to=name(frame.attached_to))
            for frame in model.frames
        ),
        canonical_link=name(model.canonical_link),
        plugins=tuple(_renamed_plugin(plugin, names) for plugin in model.plugins),
    )


def _renamed_link(link: Link, names: Mapping[str, str]) -> Link:
    sensors = tuple(
        replace(sensor, plugins=tuple(_renamed_plugin(item, names) for item in sensor.plugins))
        for sensor in link.sensors
    )
    return replace(link, name=names.get(link.name, link.name), sensors=sensors)


def _renamed_joint(joint: Joint, names: Mapping[str, str]) -> Joint:
    mimic = joint.mimic
    if mimic is not None:
        mimic = replace(mimic, joint=names.get(mimic.joint, mimic.joint))
    reference = joint.gearbox_reference_body
    return replace(
        joint,
        name=names.get(joint.name, joint.name),
        parent=names.get(joint.parent, joint.parent),
        child=names.get(joint.child, joint.child),
        mimic=mimic,
        gearbox_reference_body=names.get(reference, reference),
    )


def _renamed_plugin(plugin: PluginTag, names: Mapping[str, str]) -> PluginTag:
    scope = plugin.reference
    own = {old.removeprefix(f"{scope}{_SCOPE}"): new for old, new in names.items()}
    return replace(plugin, parameters=_renamed_tag(plugin.parameters, {**own, **names}))


def _renamed_tag(tag: Tag, names: Mapping[str, str]) -> Tag:
    text = names.get(tag.text, tag.text) if tag.name != "plugin" else tag.text
    raw_text = tag.raw_text if text == tag.text else text
    children = tuple(_renamed_tag(child, names) for child in tag.children)
    return replace(tag, text=text, raw_text=raw_text, children=children)
