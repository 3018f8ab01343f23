"""How ROS's programs read the same YAML: YAML 1.1, roslaunch's angles, rcl's numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import yaml

from gazelle.diagnostics import SourceSpan
from gazelle.documents.expressions import Budget, compile_limited
from gazelle.documents.yaml.loader import LimitedLoader

__all__ = ["RCL", "ROSPARAM", "YAML_1_1", "Dialect", "PlacedMapping", "loader_of"]

_MAP_TAG = "tag:yaml.org,2002:map"
_FLOAT_TAG = "tag:yaml.org,2002:float"
_DEGREES = re.compile(r"^deg\(([^()]*)\)$")
_RADIANS = re.compile(r"^rad\(([^()]*)\)$")
_ANGLE_TEXT = re.compile(r"^[0-9pi\s.eE+*/-]*$")
# rcl reads these with strtod; YAML 1.1, as PyYAML has it, wants a dot and a sign.
_STRTOD = re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$", re.ASCII)


class PlacedMapping(dict[Any, Any]):
    """A mapping that knows where it is written.

    Attributes:
        span: where it begins.
    """

    def __init__(self, span: SourceSpan) -> None:
        super().__init__()
        self.span = span


@dataclass(frozen=True, slots=True)
class Dialect:
    """What a program adds to YAML 1.1.

    Attributes:
        has_angles: ``deg(90)``, ``rad(pi/2)``, ``!degrees 90`` and ``!radians pi/2`` are numbers,
            in rad.
        has_strtod: ``1e-3`` and ``5e2`` are numbers.
        has_places: mappings are `PlacedMapping`.
        tags: further tags of mappings, and what makes a value of such a mapping.
    """

    has_angles: bool = False
    has_strtod: bool = False
    has_places: bool = False
    tags: tuple[tuple[str, Callable[[dict[Any, Any]], Any]], ...] = ()


YAML_1_1 = Dialect()
"""As PyYAML's ``safe_load`` reads it, which most of ROS's Python programs use."""

ROSPARAM = Dialect(has_angles=True)
"""As ``rosparam`` and roslaunch's ``<rosparam>`` read it."""

RCL = Dialect(has_strtod=True)
"""As rcl reads parameter files of ROS 2."""


@cache
def loader_of(dialect: Dialect) -> type[LimitedLoader]:
    """Return a loader of its own, so that other users of PyYAML keep theirs."""

    class _Loader(LimitedLoader):
        pass

    if dialect.has_angles:
        _Loader.add_constructor("!degrees", _degrees)
        _Loader.add_constructor("!radians", _radians)
        _Loader.add_implicit_resolver("!degrees", _DEGREES, ["d"])
        _Loader.add_implicit_resolver("!radians", _RADIANS, ["r"])
    if dialect.has_places:
        _Loader.add_constructor(_MAP_TAG, _placed)
    if dialect.has_strtod:
        _Loader.add_implicit_resolver(_FLOAT_TAG, _STRTOD, list("-+.0123456789"))
    for tag, made in dialect.tags:
        _Loader.add_constructor(tag, _constructor(made))
    return _Loader


def _placed(loader: LimitedLoader, node: yaml.MappingNode) -> Iterator[PlacedMapping]:
    mark = node.start_mark
    found = PlacedMapping(SourceSpan(str(mark.name), mark.line + 1, mark.column + 1))
    yield found
    found.update(loader.construct_mapping(node))


def _constructor(
    made: Callable[[dict[Any, Any]], Any],
) -> Callable[[LimitedLoader, yaml.MappingNode], Any]:
    return lambda loader, node: made(loader.construct_mapping(node, deep=True))


def _degrees(loader: LimitedLoader, node: yaml.ScalarNode) -> float:
    return math.radians(_angle(loader, node, _DEGREES))


def _radians(loader: LimitedLoader, node: yaml.ScalarNode) -> float:
    return _angle(loader, node, _RADIANS)


def _angle(loader: LimitedLoader, node: yaml.ScalarNode, form: re.Pattern[str]) -> float:
    text = str(loader.construct_scalar(node))
    match = form.match(text)
    expression = match[1] if match else text
    if not _ANGLE_TEXT.match(expression):
        raise yaml.constructor.ConstructorError(
            None, None, f"invalid angle '{text}'", node.start_mark
        )
    return _arithmetic(expression)


def _arithmetic(expression: str) -> float:
    """Evaluate numbers, pi and + - * / (the regular expression let nothing else through)."""
    code, names = compile_limited(expression.strip() or "0"), {"__builtins__": Budget().names}
    return float(eval(code, names, {"pi": math.pi}))  # noqa: S307
