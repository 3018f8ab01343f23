"""What the page changes of a config package: a part's new value, checked and put in."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gazelle.studio.errors import StudioError
from gazelle.studio.request_params import Params

if TYPE_CHECKING:
    from gazelle.description.model import Model
    from gazelle.motion.setup_assistant import SetupAssistantConfig

__all__ = ["edited"]

_TYPES = ("fixed", "floating", "planar")
_KINDS = ("position", "velocity", "effort")


def edited(
    config: SetupAssistantConfig, model: Model, part: str, value: Any
) -> SetupAssistantConfig:
    """Return a configuration with another value of a part.

    Raises:
        StudioError: there is no such part, or the value cannot be one.
    """
    change = _PARTS.get(part)
    if change is None:
        raise StudioError(f"there is no part '{part}' of a config package", known=list(_PARTS))
    return change(config, model, value)


def _pairs(config: SetupAssistantConfig, model: Model, value: Any) -> SetupAssistantConfig:
    from gazelle.description.srdf import CollisionPair

    links = _links(model)
    rows = tuple(
        CollisionPair(row.name("link1", links), row.name("link2", links), row.text("reason"))
        for row in _rows("pairs", value)
    )
    return replace(config, srdf=replace(config.srdf, disabled_pairs=rows))


def _virtual_joints(config: SetupAssistantConfig, model: Model, value: Any) -> SetupAssistantConfig:
    from gazelle.description.srdf import VirtualJoint

    links = _links(model)
    rows = tuple(
        VirtualJoint(
            row.word("name"),
            row.name("type", _TYPES),  # type: ignore[arg-type]
            row.word("parent_frame"),
            row.name("child_link", links),
        )
        for row in _rows("virtual_joints", value)
    )
    return replace(config, srdf=replace(config.srdf, virtual_joints=rows))


def _groups(config: SetupAssistantConfig, model: Model, value: Any) -> SetupAssistantConfig:
    from gazelle.description.srdf import Chain, Group
    from gazelle.motion.setup_assistant import KinematicsChoice, regrouped

    links = _links(model)
    joints = [joint.name for joint in model.joints]
    rows = _rows("groups", value)
    names = [row.word("name") for row in rows]
    if len(set(names)) < len(names):
        raise StudioError("two groups have the same name")
    groups = [
        Group(
            name,
            row.names("links", links),
            row.names("joints", joints),
            tuple(
                Chain(chain.name("base_link", links), chain.name("tip_link", links))
                for chain in _rows("chains", row.values.get("chains", []))
            ),
            row.names("subgroups", names),
        )
        for name, row in zip(names, rows, strict=True)
    ]
    effectors = [
        item
        for item in config.srdf.end_effectors
        if item.group in names and (not item.parent_group or item.parent_group in names)
    ]
    changed = regrouped(config, model, groups, effectors)
    solvers = {
        name: replace(changed.kinematics.get(name, KinematicsChoice()), solver=row.text("solver"))
        for name, row in zip(names, rows, strict=True)
        if row.text("solver", "")
    }
    known = {group.name for group in config.srdf.groups}
    proposed = {key: item for key, item in changed.kinematics.items() if key not in known}
    return replace(changed, kinematics={**proposed, **solvers})


def _states(config: SetupAssistantConfig, model: Model, value: Any) -> SetupAssistantConfig:
    from gazelle.description.srdf import GroupState

    groups = [group.name for group in config.srdf.groups]
    joints = [joint.name for joint in model.joints]
    rows: list[GroupState] = []
    for row in _rows("states", value):
        given = row.object("values")
        unknown = [name for name in given if name not in joints]
        if unknown:
            raise StudioError(f"the robot has no joint '{unknown[0]}'", known=joints)
        values = {name: (Params("states", given).number(name),) for name in given}
        rows.append(GroupState(row.word("name"), row.name("group", groups), values))
    return replace(config, srdf=replace(config.srdf, states=tuple(rows)))


def _end_effectors(config: SetupAssistantConfig, model: Model, value: Any) -> SetupAssistantConfig:
    from gazelle.description.srdf import EndEffector

    groups = [group.name for group in config.srdf.groups]
    rows = tuple(
        EndEffector(
            row.word("name"),
            row.name("group", groups),
            row.name("parent_link", _links(model)),
            row.name("parent_group", ["", *groups]),
        )
        for row in _rows("end_effectors", value)
    )
    return replace(config, srdf=replace(config.srdf, end_effectors=rows))


def _passive_joints(config: SetupAssistantConfig, model: Model, value: Any) -> SetupAssistantConfig:
    joints = [joint.name for joint in model.joints]
    names = _Row("passive_joints", {"joints": value}).names("joints", joints)
    return replace(config, srdf=replace(config.srdf, passive_joints=names))


def _controllers(config: SetupAssistantConfig, model: Model, value: Any) -> SetupAssistantConfig:
    from gazelle.motion.setup_assistant import ControllerChoice

    joints = [joint.name for joint in model.joints]
    old = {item.name: item for item in config.controllers}
    rows: list[ControllerChoice] = []
    for row in _rows("controllers", value):
        name, plugin = row.word("name"), row.word("plugin")
        kind, action = row.word("type"), row.text("action_ns")
        kept = old.get(name)
        made = ControllerChoice(name, kind, row.names("joints", joints), plugin, action)
        if kept is not None:
            same = kept.plugin == plugin
            made = replace(
                made,
                default=kept.default,
                others=kept.others,
                parameters=kept.parameters if same else {},
            )
        rows.append(made)
    return replace(config, controllers=tuple(rows))


def _interfaces(config: SetupAssistantConfig, model: Model, value: Any) -> SetupAssistantConfig:
    joints = [joint.name for joint in model.joints]
    found: dict[str, tuple[str, ...]] = {}
    for row in _rows("interfaces", value):
        kinds = row.names("kinds", _KINDS)
        if kinds:
            found[row.name("joint", joints)] = kinds
    added = tuple(joint for joint in config.added_joints if joint in found)
    return replace(config, command_interfaces=found, added_joints=added)


def _author(config: SetupAssistantConfig, _model: Model, value: Any) -> SetupAssistantConfig:
    from gazelle.motion.setup_assistant import Author

    row = _Row("author", value)
    return replace(config, author=Author(row.word("name"), row.word("email")))


def _package_name(config: SetupAssistantConfig, _model: Model, value: Any) -> SetupAssistantConfig:
    from gazelle.workspace.scaffold import ScaffoldError, check_package_name

    try:
        check_package_name(str(value))
    except ScaffoldError as error:
        raise StudioError(str(error)) from error
    return replace(config, package_name=str(value))


class _Row(Params):
    """A row of a part."""

    def word(self, name: str) -> str:
        """Return a text that is not empty, without spaces around."""
        found = self.text(name, "").strip()
        if not found:
            raise StudioError(f"{self.where}: '{name}' is empty")
        return found

    def name(self, name: str, known: list[str] | tuple[str, ...]) -> str:
        """Return one of the names that are known."""
        found = self.text(name, "")
        if found not in known:
            raise StudioError(f"{self.where}: there is no {name} '{found}'", known=list(known))
        return found

    def names(self, name: str, known: list[str] | tuple[str, ...]) -> tuple[str, ...]:
        """Return several of the names that are known."""
        found = self.texts(name, [])
        unknown = [item for item in found if item not in known]
        if unknown:
            raise StudioError(
                f"{self.where}: '{unknown[0]}' is none of the {name} there are", known=list(known)
            )
        return tuple(found)


def _rows(where: str, value: Any) -> list[_Row]:
    if not isinstance(value, list):
        raise StudioError(f"{where}: a list is needed")
    return [_Row(where, row) for row in value]


def _links(model: Model) -> list[str]:
    from gazelle.description.srdf import link_names

    return link_names(model)


_PARTS: Mapping[str, Callable[[SetupAssistantConfig, Model, Any], SetupAssistantConfig]] = {
    "author": _author,
    "controllers": _controllers,
    "end_effectors": _end_effectors,
    "groups": _groups,
    "interfaces": _interfaces,
    "package_name": _package_name,
    "pairs": _pairs,
    "passive_joints": _passive_joints,
    "states": _states,
    "virtual_joints": _virtual_joints,
}
