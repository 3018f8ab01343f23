"""The graph of poses: which frame each pose is relative to."""

from __future__ import annotations

from collections.abc import Iterable, Set
from functools import reduce

from gazelle.description.sdformat_emulation.gz_sdf_command.checks.frame_semantics import (
    Edge,
    Graph,
    Kind,
    Scope,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.scopes import (
    Frame,
    Joint,
    Link,
    ModelScope,
    WorldScope,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Code, SdfError
from gazelle.geometry import Pose

__all__ = ["check_places", "placed_pose", "pose_in_scope", "relative_graph"]

_NO_POSE = Pose()
_IN_MODEL = "a nested model, link, joint, or frame name"
_IN_WORLD = "a model or frame name"


def relative_graph(subject: ModelScope | WorldScope, errors: list[SdfError]) -> Scope:
    """Return the graph of a model or a world; errors of building it are appended."""
    scope = Scope(Graph())
    if isinstance(subject, ModelScope):
        return _add_root_model(scope, subject, errors)
    return _add_world(scope, subject, errors)


def pose_in_scope(scope: Scope, vertex: int, errors: list[SdfError]) -> Pose | None:
    """Return the pose of a vertex in the scope's own frame; None, with errors, if unknown."""
    path = _path(scope, vertex, errors, set())
    return None if path is None else reduce(lambda pose, edge: edge.pose @ pose, path, _NO_POSE)


def check_places(scope: Scope, vertices: Iterable[int], errors: list[SdfError]) -> None:
    """Append what keeps vertices from having a pose in the scope's own frame."""
    # A chain of many frames is not gone along to its end for each of them.
    placed: set[int] = set()
    for vertex in vertices:
        path = _path(scope, vertex, errors, placed)
        placed.update(edge.head for edge in path or ())


def placed_pose(model: ModelScope, errors: list[SdfError]) -> Pose:
    """Return a model's pose, its placement frame taken into account."""
    inner = _add_model(Scope(Graph()), model, [])
    return _placed(inner, model, errors)


def _path(scope: Scope, vertex: int, errors: list[SdfError], placed: Set[int]) -> list[Edge] | None:
    """Return the edges from a vertex to the scope, or to one of `placed`, which have a way."""
    graph = scope.graph
    path: list[Edge] = []
    current, visited = vertex, {vertex}
    while current != scope.vertex and current not in placed:
        edges = graph.into(current)
        if not edges:
            message = (
                "PoseRelativeToGraph unable to find path to source vertex when starting from "
                f"vertex with id [{vertex}]."
            )
            errors.append(SdfError(Code.POSE_RELATIVE_TO_GRAPH_ERROR, message))
            return None
        if len(edges) > 1:
            message = (
                "PoseRelativeToGraph error: multiple incoming edges to current vertex "
                f"[{graph.names[current]}]."
            )
            errors.append(SdfError(Code.POSE_RELATIVE_TO_GRAPH_ERROR, message))
            return None
        path.append(edges[0])
        current = edges[0].tail
        if current in visited:
            message = (
                "PoseRelativeToGraph cycle detected, already visited vertex "
                f"[{graph.names[current]}]."
            )
            errors.append(SdfError(Code.POSE_RELATIVE_TO_CYCLE, message))
            return None
        visited.add(current)
    return path


def _add_world(scope: Scope, world: WorldScope, errors: list[SdfError]) -> Scope:
    scope = scope.opened("", "__root__", "world", Kind.WORLD)
    root = scope.vertex
    scope = scope.opened("", "world", "world", Kind.WORLD)
    scope.graph.add_edge(root, scope.vertex, _NO_POSE)
    where = f"in world with name [{world.name}]"
    for model in world.models:
        if _is_new(scope, "Model", model.name, where, errors):
            _add_model(scope, model, errors)
    for frame in world.frames:
        if _is_new(scope, "Frame", frame.name, where, errors):
            _add_frame(scope, frame)
    location = f"in world with name[{world.name}]"
    for model in world.models:
        _relate_model(scope, model, "model", _IN_WORLD, location, errors)
    for frame in world.frames:
        _relate_frame(scope, frame, _IN_WORLD, location, errors)
    return scope


def _add_root_model(scope: Scope, model: ModelScope, errors: list[SdfError]) -> Scope:
    scope = scope.opened("", "__root__", "__model__", Kind.MODEL)
    inner = _add_model(scope, model, errors)
    number = scope.number(model.name)
    pose = _placed(inner, model, errors)
    scope.graph.add_edge(scope.vertex, number, pose)
    return scope


def _add_model(scope: Scope, model: ModelScope, errors: list[SdfError]) -> Scope:
    number = scope.add(model.name, Kind.MODEL)
    inner = scope.opened(model.name, "__model__", "__model__", Kind.MODEL)
    scope.graph.add_edge(number, inner.vertex, _NO_POSE, weight=0)
    _add_parts(inner, model, errors)
    location = f"in model with name[{model.name}]"
    for link in model.links:
        if link.relative_to:
            _relate(inner, link, "link", link.relative_to, _IN_MODEL, location, errors)
    for joint in model.joints:
        target = joint.relative_to or joint.child
        _relate(inner, joint, "joint", target, _IN_MODEL, location, errors)
    for frame in model.frames:
        _relate_frame(inner, frame, _IN_MODEL, location, errors)
    for nested in model.models:
        _relate_model(inner, nested, "nested model", _IN_MODEL, location, errors)
    return inner


def _add_parts(scope: Scope, model: ModelScope, errors: list[SdfError]) -> None:
    where = f"in model with name [{model.name}]"
    for link in model.links:
        if _is_new(scope, "Link", link.name, where, errors):
            number = scope.add(link.name, Kind.LINK)
            if not link.relative_to:
                scope.graph.add_edge(scope.vertex, number, link.pose)
    for joint in model.joints:
        if _is_new(scope, "Joint", joint.name, where, errors):
            scope.add(joint.name, Kind.JOINT)
    for frame in model.frames:
        if _is_new(scope, "Frame", frame.name, where, errors):
            _add_frame(scope, frame)
    for nested in model.models:
        if _is_new(scope, "Nested model", nested.name, where, errors):
            _add_model(scope, nested, errors)


def _add_frame(scope: Scope, frame: Frame) -> None:
    number = scope.add(frame.name, Kind.FRAME)
    if not frame.relative_to and not frame.attached_to:
        scope.graph.add_edge(scope.vertex, number, frame.pose)


def _relate_frame(
    scope: Scope, frame: Frame, what: str, location: str, errors: list[SdfError]
) -> None:
    target = frame.relative_to or frame.attached_to
    if target:
        word = "relative_to" if frame.relative_to else "attached_to"
        _relate(scope, frame, "frame", target, what, location, errors, word=word)


def _relate_model(
    scope: Scope, model: ModelScope, kind: str, what: str, location: str, errors: list[SdfError]
) -> None:
    target = model.relative_to
    if target and not _target_exists(scope, model, kind, target, what, location, errors):
        return
    tail = scope.number(target) if target else scope.vertex
    pose = _placed(scope.child(model.name), model, errors)
    scope.graph.add_edge(tail, scope.number(model.name), pose)


def _relate(
    scope: Scope,
    item: Link | Joint | Frame,
    kind: str,
    target: str,
    what: str,
    location: str,
    errors: list[SdfError],
    *,
    word: str = "relative_to",
) -> None:
    if _target_exists(scope, item, kind, target, what, location, errors, word=word):
        scope.graph.add_edge(scope.number(target), scope.number(item.name), item.pose)


def _target_exists(
    scope: Scope,
    item: Link | Joint | Frame | ModelScope,
    kind: str,
    target: str,
    what: str,
    location: str,
    errors: list[SdfError],
    *,
    word: str = "relative_to",
) -> bool:
    if not scope.has(target):
        code = Code.FRAME_ATTACHED_TO_INVALID
        if word == "relative_to":
            code = Code.POSE_RELATIVE_TO_INVALID
        message = (
            f"{word} name[{target}] specified by {kind} with name[{item.name}] does not match "
            f"{what} {location}."
        )
        errors.append(SdfError(code, message))
        return False
    if item.name == target:
        message = (
            f"relative_to name[{target}] is identical to {kind} name[{item.name}], causing a "
            f"graph cycle {location}."
        )
        errors.append(SdfError(Code.POSE_RELATIVE_TO_CYCLE, message))
    return True


def _placed(inner: Scope, model: ModelScope, errors: list[SdfError]) -> Pose:
    """Return a model's pose, for which its placement frame stands where the pose says."""
    if not model.placement_frame:
        return model.pose
    number = inner.number(model.placement_frame)
    if number is None:
        message = (
            "PoseRelativeToGraph unable to find unique frame with name "
            f"[{model.placement_frame}] in graph."
        )
        errors.append(SdfError(Code.POSE_RELATIVE_TO_INVALID, message))
        return model.pose
    placement = pose_in_scope(inner, number, errors)
    return model.pose if placement is None else model.pose @ placement.inverse()


def _is_new(scope: Scope, kind: str, name: str, where: str, errors: list[SdfError]) -> bool:
    if not scope.has(name):
        return True
    message = f"{kind} with non-unique name [{name}] detected {where}."
    errors.append(SdfError(Code.DUPLICATE_NAME, message))
    return False
