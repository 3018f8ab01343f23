"""What Gazebo loses of a URDF when it lumps links behind fixed joints; here nothing is lost.

Links without mass that ``preserveFixedJoint`` keeps apart are dropped there, too.
"""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description.model import Joint, JointType, Link, Model, PluginTag
from gazelle.description.urdf_reader.fixed_joint_lumping import (
    collision_names,
    lumped_joints,
    lumped_links,
)
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["check_lumping", "check_preserved"]

# sdformat puts the remaining link's name into these two, in plug-ins that stand below <gazebo>.
_REPLACED = frozenset({"bodyName", "frameName"})


def check_preserved(model: Model, diagnostics: Diagnostics) -> None:
    """Report links without mass that ``preserveFixedJoint`` keeps apart from those with mass."""
    if model.source_format != "urdf":
        return
    heads = lumped_links(model)
    has_mass = {
        heads.get(link.name, link.name)
        for link in model.links
        if link.inertial is not None and not link.inertial.estimated
    }
    for joint in model.joints:
        if joint.type is not JointType.FIXED or not joint.disable_fixed_joint_lumping:
            continue
        parent, child = (heads.get(name, name) for name in (joint.parent, joint.child))
        is_root = all(other.child != parent for other in model.joints) and parent != "world"
        if is_root and parent not in has_mass and child in has_mass:
            _report_massless(
                joint, parent, ", and with it the whole robot: nothing appears", diagnostics
            )
        elif child not in has_mass:
            below = [other.child for other in model.joints if other.parent == child]
            lost = f" with all that hangs on it, such as '{below[0]}'" if below else ""
            _report_massless(joint, child, lost, diagnostics)


def check_lumping(model: Model, diagnostics: Diagnostics, *, root: Tag | None = None) -> None:
    """Report names that Gazebo would not find any more, and values that would act on more.

    Args:
        model: the robot.
        diagnostics: receives the findings.
        root: the ``<robot>`` element; names of collisions are not checked without.
    """
    heads = lumped_links(model)
    if not heads:
        return
    _check_plugins(model, heads, diagnostics)
    _check_joint_sensors(model, diagnostics)
    _check_gravity(model, heads, diagnostics)
    if root is not None:
        _check_watched_collisions(root, model, heads, diagnostics)


def _report_massless(joint: Joint, massless: str, lost: str, diagnostics: Diagnostics) -> None:
    text = (
        f"the fixed joint '{joint.name}' is preserved, but '{massless}' has no <inertial>: Gazebo "
        f"drops that link{lost}; here it is kept"
    )
    fix = (
        f"remove <preserveFixedJoint> (<disableFixedJointLumping>) from '{joint.name}', or give "
        f"'{massless}' an <inertial> with a small mass, such as 0.01 kg and 1e-6 kg·m²"
    )
    diagnostics.report("robot.preserved-massless", text, joint.span, fix=fix)


def _check_plugins(model: Model, heads: dict[str, str], diagnostics: Diagnostics) -> None:
    joints = {joint.name: joint.child for joint in lumped_joints(model).values()}
    for plugin in model.plugins:
        replaced = []
        for tag, name in _named(plugin, heads.keys() | joints.keys()):
            is_link = name in heads and "joint" not in tag.name.lower()
            if is_link and tag.name in _REPLACED:
                replaced.append((tag, name))
            elif name in joints or is_link:
                kind, child = ("link", name) if is_link else ("joint", joints.get(name, name))
                text = (
                    f"plug-in '{plugin.name}' names the {kind} '{name}' in <{tag.name}>. Gazebo "
                    f"lumps '{child}' into '{heads[child]}': there the {kind} does not exist and "
                    "the plug-in fails; here it is kept"
                )
                _report("robot.lumped-name", text, tag.span, model, child, diagnostics)
        if replaced:
            _tell_replaced(plugin, replaced, model, heads, diagnostics)


def _tell_replaced(
    plugin: PluginTag,
    replaced: list[tuple[Tag, str]],
    model: Model,
    heads: dict[str, str],
    diagnostics: Diagnostics,
) -> None:
    words = ", ".join(f"<{tag.name}> '{name}' becomes '{heads[name]}'" for tag, name in replaced)
    text = (
        f"Gazebo changes links in plug-in '{plugin.name}', since it lumps them: {words}, and its "
        "data comes in that frame; here they stay"
    )
    span, name = replaced[0][0].span, replaced[0][1]
    _report("robot.lumped-frame", text, span, model, name, diagnostics)


def _check_joint_sensors(model: Model, diagnostics: Diagnostics) -> None:
    for joint in lumped_joints(model).values():
        for sensor in joint.sensors:
            text = (
                f"sensor '{sensor.name}' measures at the fixed joint '{joint.name}', which Gazebo "
                "lumps: the sensor is lost with it; here it works"
            )
            span = sensor.span or joint.span
            _report("robot.lumped-name", text, span, model, joint.child, diagnostics)


def _check_gravity(model: Model, heads: dict[str, str], diagnostics: Diagnostics) -> None:
    floating: dict[str, list[Link]] = {}
    for name, head in heads.items():
        link, body = model.link(name), model.link(head)
        if link is not None and body is not None and body.gravity and not link.gravity:
            floating.setdefault(head, []).append(link)
    for head, links in floating.items():
        names = " and ".join(f"'{link.name}'" for link in links[:3])
        names += f" and {len(links) - 3} more" if len(links) > 3 else ""
        text = (
            f"gravity is switched off for {names}, which Gazebo lumps into '{head}': there all of "
            f"'{head}' floats; here it is {names} alone"
        )
        _report("robot.lumped-value", text, links[0].span, model, links[0].name, diagnostics)


def _check_watched_collisions(
    root: Tag, model: Model, heads: dict[str, str], diagnostics: Diagnostics
) -> None:
    by_link = collision_names(root, model)
    known = {name for names in by_link.values() for name in names}
    for block in root.find_all("gazebo"):
        for tag in block.walk():
            if tag.name != "contact":
                continue
            for item in tag.find_all("collision"):
                name = item.text.strip()
                owner = _owner(name, by_link, root)
                if not name or name in known or owner not in heads:
                    continue
                meant = " or ".join(f"'{one}'" for one in by_link[owner])
                text = (
                    f"a contact sensor watches '{name}'. Gazebo lumps link '{owner}' into "
                    f"'{heads[owner]}' and calls the collision {meant}: the sensor would never "
                    "report a contact there; here it does"
                )
                fix = f"write {meant}, or preserve the joint: {_preserve(model, owner)}"
                diagnostics.report("robot.lumped-collision", text, item.span, fix=fix)


def _owner(name: str, by_link: dict[str, tuple[str, ...]], root: Tag) -> str:
    """Return the link whose collision is meant by the name that it has before lumping."""
    for tag in root.find_all("link"):
        link = tag.attributes.get("name", "").strip()
        own = {item.attributes.get("name", "").strip() for item in tag.find_all("collision")}
        if name.startswith(f"{link}_collision") or name == link or name in own - {""}:
            return link if by_link.get(link) else ""
    return ""


def _named(plugin: PluginTag, names: set[str]) -> Iterator[tuple[Tag, str]]:
    """Yield the parameters that look up a link or joint; frames of tf are names only."""
    for tag in plugin.parameters.walk():
        key = tag.name.lower()
        looks_up = ("body" in key or "link" in key or "joint" in key) and "frame" not in key
        name = tag.text.strip()
        if (looks_up or tag.name == "frameName") and name in names:
            yield tag, name


def _report(
    code: str,
    text: str,
    span: SourceSpan | None,
    model: Model,
    child: str,
    diagnostics: Diagnostics,
) -> None:
    fix = f"for Gazebo preserve the joint: {_preserve(model, child)}"
    diagnostics.report(code, text, span, fix=fix)


def _preserve(model: Model, child: str) -> str:
    joint = lumped_joints(model)[child].name
    words = f'<gazebo reference="{joint}"><preserveFixedJoint>true</preserveFixedJoint></gazebo>'
    link = model.link(child)
    if link is not None and (link.inertial is None or link.inertial.estimated):
        words += f", and give '{child}' an <inertial>: preserved links without one are dropped"
    return words
