"""The verdict on a document, as ``ign sdf -k`` gives it; checks of finished graphs."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.element_checks import (
    check_light,
    check_unique,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.frame_attached_to_graph import (
    attached_graph,
    body_of,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.frame_semantics import Kind, Scope
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.pose_relative_to_graph import (
    check_places,
    relative_graph,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.scopes import (
    Joint,
    Loader,
    ModelScope,
    WorldScope,
    load_model,
    load_world,
    shared_names,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Code, Console, SdfError
from gazelle.description.sdformat_emulation.gz_sdf_command.element_reader import Document
from gazelle.description.sdformat_emulation.gz_sdf_command.model_config import version_numbers
from gazelle.description.sdformat_emulation.gz_sdf_command.printer import to_text
from gazelle.description.sdformat_emulation.gz_sdf_command.specification import specification

__all__ = [
    "Loaded",
    "check",
    "load",
    "name_problems",
]

_MODELS = (Kind.MODEL, Kind.STATIC_MODEL)


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


def _validate_attached(scope: Scope, errors: list[SdfError]) -> None:
    """Append what is wrong with a graph of attachments."""
    if scope.vertex is None:
        context = f"scope context name[{scope.context}]"
        message = f"FrameAttachedToGraph error: {context} does not match __model__ or world."
        errors.append(SdfError(Code.FRAME_ATTACHED_TO_GRAPH_ERROR, message))
        return
    for vertex in range(len(scope.graph.names)):
        for problem in _attached_problems(scope, vertex):
            message = f"FrameAttachedToGraph error, {problem}"
            errors.append(SdfError(Code.FRAME_ATTACHED_TO_GRAPH_ERROR, message))
    for name in scope.names():
        body_of(scope, name, errors)


def _validate_relative(scope: Scope, errors: list[SdfError]) -> None:
    """Append what is wrong with a graph of poses."""
    assert scope.vertex is not None
    for vertex in range(len(scope.graph.names)):
        for problem in _relative_problems(scope, vertex):
            message = f"PoseRelativeToGraph error, {problem}"
            errors.append(SdfError(Code.POSE_RELATIVE_TO_GRAPH_ERROR, message))
    numbers = (scope.number(name) for name in scope.names() if name != "__root__")
    check_places(scope, (number for number in numbers if number is not None), errors)


def _attached_problems(scope: Scope, vertex: int) -> list[str]:
    assert scope.vertex is not None
    graph = scope.graph
    name, kind, count = scope.local(vertex), graph.kinds[vertex], len(graph.out_of(vertex))
    in_model = graph.kinds[scope.vertex] in _MODELS
    problems = [] if name else ["vertex with empty name detected."]
    if count > 1:
        problems.append(f"too many outgoing edges at a vertex with name [{name}].")
    elif name != "__root__":
        problems += _attached_problem(scope, vertex, name, kind, in_model=in_model)
    return problems


def _attached_problem(
    scope: Scope, vertex: int, name: str, kind: Kind, *, in_model: bool
) -> list[str]:
    edges = scope.graph.out_of(vertex)
    where = f"in {'MODEL' if in_model else 'WORLD'} attached_to graph."
    if kind is Kind.WORLD and in_model:
        return [f"vertex with name [{name}]should not have type WORLD {where}"]
    if kind is Kind.WORLD:
        return [f"WORLD vertices should have no outgoing edges {where}"] if edges else []
    if kind is Kind.LINK:
        if not edges:
            return []
        return [f"LINK vertex with name [{name}] should have no outgoing edges {where}"]
    if kind is Kind.STATIC_MODEL:
        if not any(edge.weight for edge in edges):
            return []
        return [f"STATIC_MODEL vertex with name [{name}] should have no outgoing edges {where}"]
    if edges:
        return []
    if in_model:
        return [
            f"Non-LINK vertex with name [{name}] is disconnected; it should have 1 outgoing edge "
            f"{where}"
        ]
    return [
        f"Non-LINK vertex with name [{name}] has 0 outgoing edges; it should only have 1 "
        f"outgoing edge {where}"
    ]


def _relative_problems(scope: Scope, vertex: int) -> list[str]:
    assert scope.vertex is not None
    graph = scope.graph
    name, count = scope.local(vertex), len(graph.into(vertex))
    in_model = graph.kinds[scope.vertex] is Kind.MODEL
    where = f"in {'MODEL' if in_model else 'WORLD'} relative_to graph."
    problems = [] if name else ["vertex with empty name detected."]
    if count > 1:
        problems.append(f"too many incoming edges at a vertex with name [{name}].")
    elif name == "__root__":
        if count:
            problems.append(f"__root__ vertex should have no incoming edges {where}")
    elif count == 0 and vertex != scope.vertex:
        label = "Vertex" if in_model else "MODEL / FRAME vertex"
        problems.append(
            f"{label} with name [{name}] is disconnected; it should have 1 incoming edge {where}"
        )
    return problems


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
    _validate_attached(graph, errors)
    _validate_relative(relative_graph(world, errors), errors)
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
    _validate_attached(graph, loaded.errors)
    _validate_relative(relative_graph(model, loaded.errors), loaded.errors)
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
    location = f"in model with name[{model.name}]"
    for joint in model.joints:
        _check_names(joint, known, nested, scope, location, errors)
        child = body_of(scope, joint.child, errors)
        parent = "world" if joint.parent == "world" else body_of(scope, joint.parent, errors)
        if child == parent:
            message = (
                f"joint with name[{joint.name}] {location} specified parent frame [{joint.parent}] "
                f"and child frame [{joint.child}] that both resolve to [{child}], but they should "
                "resolve to different values."
            )
            errors.append(SdfError(Code.JOINT_PARENT_SAME_AS_CHILD, message))


def _check_names(
    joint: Joint,
    known: set[str],
    nested: set[str],
    scope: Scope,
    location: str,
    errors: list[SdfError],
) -> None:
    def exists(name: str) -> bool:
        return name in known or ("::" in name and scope.has(name))

    parent, child = joint.parent, joint.child
    said = f"specified by joint with name[{joint.name}]"
    if parent != "world" and not exists(parent):
        message = f"parent frame with name[{parent}] {said} not found {location}."
        errors.append(SdfError(Code.JOINT_PARENT_LINK_INVALID, message))
    if child == "world":
        message = f"invalid child name[world] {said} {location}."
        errors.append(SdfError(Code.JOINT_CHILD_LINK_INVALID, message))
    if not exists(child) and child not in nested:
        message = f"child frame with name[{child}] {said} not found {location}."
        errors.append(SdfError(Code.JOINT_CHILD_LINK_INVALID, message))
    for end, word, code in (
        (child, "child", Code.JOINT_CHILD_LINK_INVALID),
        (parent, "parent", Code.JOINT_PARENT_LINK_INVALID),
    ):
        if end == joint.name:
            message = (
                f"joint with name[{joint.name}] {location} must not specify its own name as the "
                f"{word} frame."
            )
            errors.append(SdfError(code, message))
