"""What sdformat checks of finished graphs: how many edges each vertex has, cycles, dead ends."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.gz_sdf.checks.frame_attached_to_graph import body_of
from gazelle.description.sdformat_emulation.gz_sdf.checks.frame_graph import Kind, Scope
from gazelle.description.sdformat_emulation.gz_sdf.checks.pose_relative_to_graph import check_places
from gazelle.description.sdformat_emulation.gz_sdf.console import Code, SdfError

__all__ = ["validate_attached", "validate_relative"]

_MODELS = (Kind.MODEL, Kind.STATIC_MODEL)


def validate_attached(scope: Scope, errors: list[SdfError]) -> None:
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


def validate_relative(scope: Scope, errors: list[SdfError]) -> None:
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
