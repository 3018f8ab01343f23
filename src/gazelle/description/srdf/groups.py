"""``<group>`` elements, and which of them hold together."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.description.model import Model
from gazelle.description.srdf.model import Chain, Group
from gazelle.description.srdf.names import Names
from gazelle.description.urdf.attributes import check_vocabulary
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics

__all__ = ["read_groups"]


def read_groups(root: Tag, names: Names) -> tuple[Group, ...]:
    """Return the groups that stand directly below the root, without those that cannot be."""
    found: dict[str, Group] = {}
    for tag in root.find_all("group"):
        name = names.required(tag, "name")
        if name in found:
            message = f"a second <group> is named '{name}'; the first one counts, as in MoveIt"
            names.diagnostics.report("srdf.double-name", message, tag.span)
        elif name:
            found[name] = _read_group(tag, name, names)
    return _satisfied(found, names.diagnostics)


def _read_group(tag: Tag, name: str, names: Names) -> Group:
    check_vocabulary(
        tag,
        names.diagnostics,
        attributes=("name",),
        children=("link", "joint", "chain", "group"),
    )
    chains = (_read_chain(child, name, names) for child in tag.find_all("chain"))
    group = Group(
        name,
        _filled(names.link(child, "name") for child in tag.find_all("link")),
        _filled(names.joint(child, "name") for child in tag.find_all("joint")),
        tuple(chain for chain in chains if chain is not None),
        _filled(names.group(child, "name") for child in tag.find_all("group")),
        tag.span,
    )
    if not (group.links or group.joints or group.chains or group.subgroups):
        message = f"group '{name}' has no link, joint, chain or group in it; nothing can be"
        message += " planned for it"
        names.diagnostics.report("srdf.empty-group", message, tag.span)
    return group


def _read_chain(tag: Tag, group: str, names: Names) -> Chain | None:
    check_vocabulary(tag, names.diagnostics, attributes=("base_link", "tip_link"))
    base, tip = names.link(tag, "base_link"), names.link(tag, "tip_link")
    if not base or not tip:
        return None
    if names.robot is not None and not _are_connected(base, tip, names.robot):
        message = f"no joints lead from '{base}' to '{tip}'; the chain is left out of group"
        message += f" '{group}' (Links '{base}' and '{tip}' do not form a chain)"
        names.diagnostics.report("srdf.no-chain", message, tag.span)
        return None
    return Chain(base, tip)


def _are_connected(base: str, tip: str, robot: Model) -> bool:
    parents = {joint.child: joint.parent for joint in robot.joints}

    def above(link: str) -> list[str]:
        found: list[str] = []
        while link and link not in found:
            found.append(link)
            link = parents.get(link, "")
        return found

    return bool(set(above(base)) & set(above(tip)))


def _satisfied(groups: dict[str, Group], diagnostics: Diagnostics) -> tuple[Group, ...]:
    """Leave out groups that hold themselves, by way of their subgroups."""
    known: set[str] = set()
    size = -1
    while len(known) > size:
        size = len(known)
        known |= {group.name for group in groups.values() if known.issuperset(group.subgroups)}
    for group in groups.values():
        if group.name not in known:
            message = f"group '{group.name}' holds itself by way of {', '.join(group.subgroups)};"
            message += f" it is left out (Group '{group.name}' has unsatisfied subgroups)"
            diagnostics.report("srdf.group-ring", message, group.span)
    return tuple(group for group in groups.values() if group.name in known)


def _filled(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(name for name in names if name)
