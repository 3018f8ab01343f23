"""The graph of what is attached to what: joints to children, frames to links, models to links."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.gz_sdf_command.checks.frame_semantics import (
    Graph,
    Kind,
    Scope,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.checks.scopes import (
    Frame,
    ModelScope,
    WorldScope,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Code, SdfError
from gazelle.geometry import Pose

__all__ = ["attached_graph", "body_of"]

_NO_POSE = Pose()
_WITHOUT_LINK = SdfError(Code.MODEL_WITHOUT_LINK, "A model must have at least one link.")


def attached_graph(subject: ModelScope | WorldScope, errors: list[SdfError]) -> Scope:
    """Return the graph of a model or a world; errors of building it are appended."""
    scope = Scope(Graph())
    if isinstance(subject, ModelScope):
        return _add_model(scope, subject, errors, is_root=True)
    return _add_world(scope, subject, errors)


def body_of(scope: Scope, name: str, errors: list[SdfError]) -> str:
    """Return the link that a frame is attached to in the end; empty, with errors, if none."""
    vertex = scope.number(name)
    if vertex is None:
        message = f"FrameAttachedToGraph unable to find unique frame with name [{name}] in graph."
        errors.append(SdfError(Code.FRAME_ATTACHED_TO_INVALID, message))
        return ""
    sink = _sink(scope, vertex, errors)
    if sink is None:
        return ""
    problem = _problem_of_sink(scope, sink, name)
    if problem:
        errors.append(SdfError(Code.FRAME_ATTACHED_TO_GRAPH_ERROR, problem))
        return ""
    return scope.local(sink)


def _sink(scope: Scope, vertex: int, errors: list[SdfError]) -> int | None:
    graph = scope.graph
    visited = {vertex}
    edges = graph.out_of(vertex)
    while edges:
        name = graph.names[vertex]
        if len(edges) > 1:
            message = (
                f"FrameAttachedToGraph error: multiple outgoing edges from current vertex [{name}]."
            )
            errors.append(SdfError(Code.FRAME_ATTACHED_TO_GRAPH_ERROR, message))
            return None
        vertex = edges[0].head
        if vertex in visited:
            message = (
                "FrameAttachedToGraph cycle detected, already visited vertex "
                f"[{graph.names[vertex]}]."
            )
            errors.append(SdfError(Code.FRAME_ATTACHED_TO_CYCLE, message))
            return None
        visited.add(vertex)
        edges = graph.out_of(vertex)
    return vertex


def _problem_of_sink(scope: Scope, sink: int, name: str) -> str:
    kind, sink_name = scope.graph.kinds[sink], scope.graph.names[sink]
    start = f"when starting from vertex with name [{name}]"
    if scope.context == "world":
        if kind in (Kind.WORLD, Kind.STATIC_MODEL, Kind.LINK):
            return ""
        return (
            f"Graph has world scope but sink vertex named [{sink_name}] does not have FrameType "
            f"WORLD, LINK or STATIC_MODEL {start}."
        )
    if kind is Kind.MODEL and sink_name == "__model__":
        return (
            f"Graph with __model__ scope has sink vertex named [__model__] {start}, which is not "
            "permitted."
        )
    if kind in (Kind.LINK, Kind.STATIC_MODEL):
        return ""
    return (
        f"Graph has __model__ scope but sink vertex named [{sink_name}] does not have FrameType "
        f"LINK or STATIC_MODEL {start}."
    )


def _add_world(scope: Scope, world: WorldScope, errors: list[SdfError]) -> Scope:
    scope = scope.opened("", "world", "world", Kind.WORLD)
    where = f"in world with name [{world.name}]"
    for model in world.models:
        if _is_new(scope, "Model", model.name, where, errors):
            _add_model(scope, model, errors, is_root=False)
    for frame in world.frames:
        if _is_new(scope, "Frame", frame.name, where, errors):
            scope.add(frame.name, Kind.FRAME)
    for frame in world.frames:
        location = f"in world with name[{world.name}]"
        _attach(scope, frame, "world", "a model or frame name", location, errors)
    return scope


def _add_model(scope: Scope, model: ModelScope, errors: list[SdfError], *, is_root: bool) -> Scope:
    if not model.has_link:
        errors.append(_WITHOUT_LINK)
        return scope
    kind = Kind.STATIC_MODEL if model.is_static else Kind.MODEL
    if is_root:
        scope = scope.opened("", "__root__", "__model__", Kind.STATIC_MODEL)
    number = scope.add(model.name, kind)
    inner = scope.opened(model.name, "__model__", "__model__", kind)
    scope.graph.add_edge(number, inner.vertex, _NO_POSE, weight=0)
    _add_parts(inner, model, errors)
    _add_joint_edges(inner, model, errors)
    for frame in model.frames:
        what = "a nested model, link, joint, or frame name"
        _attach(inner, frame, "__model__", what, f"in model with name[{model.name}]", errors)
    if not model.is_static:
        _attach_model(inner, model, errors)
    return scope


def _add_parts(scope: Scope, model: ModelScope, errors: list[SdfError]) -> None:
    where = f"in model with name [{model.name}]"
    for link in model.links:
        if _is_new(scope, "Link", link.name, where, errors):
            scope.add(link.name, Kind.LINK)
    for joint in model.joints:
        if _is_new(scope, "Joint", joint.name, where, errors):
            scope.add(joint.name, Kind.JOINT)
    for frame in model.frames:
        if _is_new(scope, "Frame", frame.name, where, errors):
            scope.add(frame.name, Kind.FRAME)
    for nested in model.models:
        if _is_new(scope, "Nested model", nested.name, where, errors):
            _add_model(scope, nested, errors, is_root=False)


def _add_joint_edges(scope: Scope, model: ModelScope, errors: list[SdfError]) -> None:
    for joint in model.joints:
        if scope.has(joint.child):
            number = scope.number(joint.name)
            scope.graph.add_edge(number, scope.number(joint.child), _NO_POSE)
            continue
        message = (
            f"Child frame with name[{joint.child}] specified by joint with name[{joint.name}] "
            f"not found in model with name[{model.name}]."
        )
        errors.append(SdfError(Code.JOINT_CHILD_LINK_INVALID, message))


def _attach(
    scope: Scope, frame: Frame, default: str, what: str, location: str, errors: list[SdfError]
) -> None:
    target = frame.attached_to or default
    if not scope.has(target):
        message = (
            f"attached_to name[{target}] specified by frame with name[{frame.name}] does not "
            f"match {what} {location}."
        )
        errors.append(SdfError(Code.FRAME_ATTACHED_TO_INVALID, message))
        return
    if frame.name == frame.attached_to:
        message = (
            f"attached_to name[{target}] is identical to frame name[{frame.name}], causing a "
            f"graph cycle {location}."
        )
        errors.append(SdfError(Code.FRAME_ATTACHED_TO_CYCLE, message))
    scope.graph.add_edge(scope.number(frame.name), scope.number(target), _NO_POSE)


def _attach_model(scope: Scope, model: ModelScope, errors: list[SdfError]) -> None:
    found, name = model.canonical()
    if found or (name and scope.has(name)):
        scope.graph.add_edge(scope.vertex, scope.number(name), _NO_POSE)
    elif name:
        message = f"canonical_link with name[{name}] not found in model with name[{model.name}]."
        errors.append(SdfError(Code.MODEL_CANONICAL_LINK_INVALID, message))
    elif model.models:
        # The first nested model may be static; what it is attached to shows later.
        scope.graph.add_edge(scope.vertex, scope.number(model.models[0].name), _NO_POSE)
    else:
        errors.append(_WITHOUT_LINK)


def _is_new(scope: Scope, kind: str, name: str, where: str, errors: list[SdfError]) -> bool:
    if not scope.has(name):
        return True
    message = f"{kind} with non-unique name [{name}] detected {where}."
    errors.append(SdfError(Code.DUPLICATE_NAME, message))
    return False
