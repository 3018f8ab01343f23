"""The verdict on a document, as ``ign sdf -k`` gives it."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf.checks.element_checks import (
    check_light,
    check_unique,
)
from gazelle.description.sdformat_emulation.gz_sdf.checks.entities import (
    Joint,
    ModelScope,
    WorldScope,
)
from gazelle.description.sdformat_emulation.gz_sdf.checks.frame_attached_to_graph import (
    attached_graph,
    body_of,
)
from gazelle.description.sdformat_emulation.gz_sdf.checks.frame_graph import Scope
from gazelle.description.sdformat_emulation.gz_sdf.checks.loading import (
    Loader,
    load_model,
    load_world,
)
from gazelle.description.sdformat_emulation.gz_sdf.checks.names import shared_names
from gazelle.description.sdformat_emulation.gz_sdf.checks.pose_relative_to_graph import (
    relative_graph,
)
from gazelle.description.sdformat_emulation.gz_sdf.checks.validation import (
    validate_attached,
    validate_relative,
)
from gazelle.description.sdformat_emulation.gz_sdf.console import Code, Console, SdfError
from gazelle.description.sdformat_emulation.gz_sdf.model_config import version_numbers
from gazelle.description.sdformat_emulation.gz_sdf.printer import to_text
from gazelle.description.sdformat_emulation.gz_sdf.records import Document
from gazelle.description.sdformat_emulation.gz_sdf.specification import specification

__all__ = ["Loaded", "check", "load", "name_problems"]


@dataclass(slots=True)
class Loaded:
    """A document as objects.

    Attributes:
        worlds: all of them.
        model: the one outside of worlds.
        errors: everything found.
        console: lines written while loading.
    """

    console: Console
    worlds: list[WorldScope] = field(default_factory=list)
    model: ModelScope | None = None
    errors: list[SdfError] = field(default_factory=list)


def load(document: Document) -> Loaded:
    """Return a document's worlds or model with every error in them.

    Args:
        document: of sdformat 12; its root must not be None.
    """
    root = document.root
    assert root is not None
    loaded = Loaded(Console(document.console.release))
    version = version_numbers(document.original_version)
    loader = Loader(loaded.console, {**document.versions, id(root): version})
    graphs: dict[int, Scope] = {}
    for element in root.find_all("world"):
        _load_world(element, version, loader, loaded, graphs)
    _load_root_model(root, version, loader, loaded, graphs)
    _check_alone(root, "light", loaded)
    _check_alone(root, "actor", loaded)
    for model in _checked_models(loaded):
        _check_ends(model, graphs[id(model)], loaded.errors)
    return loaded


def check(document: Document) -> tuple[SdfError, ...]:
    """Return what ``ign sdf -k`` prints with codes; empty for a document without errors.

    Names that siblings share come without codes: see `name_problems`.
    """
    if document.root is None:
        return document.errors
    return (*document.errors, *load(document).errors)


def name_problems(document: Document) -> list[str]:
    """Return the lines about siblings that share a name; ``ign sdf -k`` is not content then."""
    if document.root is None:
        return []
    release = document.console.release
    found = shared_names(document.root, specification(release))
    return [f"Error: Non-unique names detected in {to_text(one, release)}" for one in found]


def _load_world(
    element: SdfElement,
    version: tuple[int, ...],
    loader: Loader,
    loaded: Loaded,
    graphs: dict[int, Scope],
) -> None:
    errors: list[SdfError] = []
    world = load_world(element, version, loader, errors)
    graph = attached_graph(world, errors)
    validate_attached(graph, errors)
    validate_relative(relative_graph(world, errors), errors)
    for model in world.models:
        graphs[id(model)] = graph.child(model.name)
    if errors:
        errors.append(SdfError(Code.ELEMENT_INVALID, "Failed to load a world."))
    elif any(other.name == world.name for other in loaded.worlds):
        message = (
            f"World with name[{world.name}] already exists. Each world must have a unique name. "
            "Skipping this world."
        )
        errors.append(SdfError(Code.DUPLICATE_NAME, message))
    loaded.errors += errors
    loaded.worlds.append(world)


def _load_root_model(
    root: SdfElement,
    version: tuple[int, ...],
    loader: Loader,
    loaded: Loaded,
    graphs: dict[int, Scope],
) -> None:
    models: list[ModelScope] = []

    def load_one(element: SdfElement, errors: list[SdfError]) -> None:
        models.append(load_model(element, version, loader, errors))

    kept = check_unique(root, "model", load_one, loaded.errors)
    if not kept:
        return
    if len(kept) > 1:
        message = "Root object can only contain one model. Using the first one found"
        loaded.errors.append(SdfError(Code.ELEMENT_INCORRECT_TYPE, message))
    model = loaded.model = models[0]
    graph = attached_graph(model, loaded.errors)
    validate_attached(graph, loaded.errors)
    validate_relative(relative_graph(model, loaded.errors), loaded.errors)
    graphs[id(model)] = graph.child(model.name)


def _check_alone(root: SdfElement, name: str, loaded: Loaded) -> None:
    kept = check_unique(
        root, name, check_light if name == "light" else lambda one, errors: None, loaded.errors
    )
    if len(kept) > 1:
        message = f"Root object can only contain one {name}. Using the first one found."
        loaded.errors.append(SdfError(Code.ELEMENT_INCORRECT_TYPE, message))
    others = ("model",) if name == "light" else ("model", "light")
    if kept and any(root.find(other) is not None for other in others):
        message = (
            "Root object can only contain one of model, light or actor, but found more than one "
            f"type of element. Skipping this {name}."
        )
        loaded.errors.append(SdfError(Code.ELEMENT_INCORRECT_TYPE, message))


def _checked_models(loaded: Loaded) -> list[ModelScope]:
    outside = [loaded.model] if loaded.model is not None else []
    return outside + [model for world in loaded.worlds for model in world.models]


def _check_ends(model: ModelScope, scope: Scope, errors: list[SdfError]) -> None:
    """Report joints whose ends are nothing, or one and the same."""
    known = {link.name for link in model.links}
    known |= {joint.name for joint in model.joints} | {frame.name for frame in model.frames}
    nested = {one.name for one in model.models}
    place = f"in model with name[{model.name}]"
    for joint in model.joints:
        _check_names(joint, known, nested, scope, place, errors)
        child = body_of(scope, joint.child, errors)
        parent = "world" if joint.parent == "world" else body_of(scope, joint.parent, errors)
        if child == parent:
            message = (
                f"joint with name[{joint.name}] {place} specified parent frame [{joint.parent}] "
                f"and child frame [{joint.child}] that both resolve to [{child}], but they should "
                "resolve to different values."
            )
            errors.append(SdfError(Code.JOINT_PARENT_SAME_AS_CHILD, message))


def _check_names(
    joint: Joint,
    known: set[str],
    nested: set[str],
    scope: Scope,
    place: str,
    errors: list[SdfError],
) -> None:
    def exists(name: str) -> bool:
        return name in known or ("::" in name and scope.has(name))

    parent, child = joint.parent, joint.child
    said = f"specified by joint with name[{joint.name}]"
    if parent != "world" and not exists(parent):
        message = f"parent frame with name[{parent}] {said} not found {place}."
        errors.append(SdfError(Code.JOINT_PARENT_LINK_INVALID, message))
    if child == "world":
        message = f"invalid child name[world] {said} {place}."
        errors.append(SdfError(Code.JOINT_CHILD_LINK_INVALID, message))
    if not exists(child) and child not in nested:
        message = f"child frame with name[{child}] {said} not found {place}."
        errors.append(SdfError(Code.JOINT_CHILD_LINK_INVALID, message))
    for end, word, code in (
        (child, "child", Code.JOINT_CHILD_LINK_INVALID),
        (parent, "parent", Code.JOINT_PARENT_LINK_INVALID),
    ):
        if end == joint.name:
            message = (
                f"joint with name[{joint.name}] {place} must not specify its own name as the "
                f"{word} frame."
            )
            errors.append(SdfError(code, message))
