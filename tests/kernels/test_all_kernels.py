"""Every kernel of Gazelle does compiled what it does in Python, and is compiled for one kind."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterator
from importlib import import_module
from typing import Any, NamedTuple

import numpy as np
import pytest
from tests.kernels.python_oracle import exact

from gazelle.kernels import Kernel, kernels
from gazelle.kernels.kernel_types import type_of

_WARM_UPS = {
    "sensors": "gazelle.sensors.kernel_warm_up",
    "mapping": "gazelle.mapping.slam.kernel_warm_up",
    "motion": "gazelle.motion.kernel_warm_up",
    "navigation": "gazelle.navigation.kernel_warm_up",
}
_ROUNDED = {
    "navfn_potential": "NumPy's float32 and a number of Python's are a float32",
    "refine_on_lines": "Python's hypot rounds once",
    "score_samples": "Python's hypot rounds once",
    "roll_out": "Python's hypot rounds once",
}
"""Kernels without flags whose results differ in the last digits, and why."""
_NOT_PYTHONS = {
    "render_rows": "a library looks at its memory",
    "sweep": "it makes records, whose fields have no names for Python",
}
"""Kernels that Python cannot run, and why."""
_TOLERANCE = 1e-6


class _Call(NamedTuple):
    """A call: what was given, what the arguments were afterwards, and what came back."""

    given: tuple[Any, ...]
    after: tuple[Any, ...]
    result: Any


class _Recorded(NamedTuple):
    """Of each kernel that Python called: the first call, and the types of all."""

    calls: dict[Kernel, _Call]
    types: dict[Kernel, set[Any]]


@pytest.fixture(scope="module")
def recorded() -> Iterator[_Recorded]:
    calls: dict[Kernel, _Call] = {}
    types: dict[Kernel, set[Any]] = {}
    lock = threading.Lock()
    run = Kernel.__call__

    def recording(kernel: Kernel, *arguments: Any) -> Any:
        with lock:
            types.setdefault(kernel, set()).add(tuple(map(type_of, arguments)))
            is_first = kernel not in calls
            if is_first:
                given = _copied(arguments)
                calls[kernel] = _Call(given, (), None)
        result = run(kernel, *arguments)
        if is_first:
            calls[kernel] = _Call(given, _copied(arguments), _copied(result))
        return result

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Kernel, "__call__", recording)
        for module in _WARM_UPS.values():
            import_module(module).warm_up()
    yield _Recorded(calls, types)


def _copied(value: Any, bases: dict[int, Any] | None = None) -> Any:
    """Return a copy in which arrays that share their memory do so again."""
    bases = {} if bases is None else bases
    if isinstance(value, np.ndarray):
        base = value.base if isinstance(value.base, np.ndarray) else value
        if id(base) not in bases:
            bases[id(base)] = base, base.copy(order="K")
        if base is value or not base.flags.forc:
            return bases[id(base)][1] if base is value else value.copy(order="K")
        offset = value.ctypes.data - base.ctypes.data
        copy = bases[id(base)][1]
        buffer = np.ndarray((copy.nbytes,), np.uint8, copy)
        return np.ndarray(value.shape, value.dtype, buffer, offset, value.strides)
    if isinstance(value, tuple):
        items = [_copied(item, bases) for item in value]
        return tuple(items) if type(value) is tuple else type(value)(*items)
    return value


def _for_python(value: Any) -> Any:
    """Return arguments whose records have their fields as Python finds them."""
    if isinstance(value, np.ndarray) and value.dtype.names is not None:
        return value.view(np.recarray)
    if isinstance(value, tuple):
        items = map(_for_python, value)
        return tuple(items) if type(value) is tuple else type(value)(*items)
    return value


def _is_close(one: Any, other: Any) -> bool:
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(_is_close, one, other))
    if isinstance(one, np.ndarray) and one.dtype.names is not None:
        return bool(one.tobytes() == other.tobytes())
    if one is None or other is None:
        return one is other
    return np.shape(one) == np.shape(other) and bool(
        np.allclose(one, other, rtol=_TOLERANCE, atol=_TOLERANCE, equal_nan=True)
    )


def _differs(kernel: Kernel, call: _Call) -> bool:
    """Run a kernel's function in Python, and tell whether it does something else."""
    there = _copied(call.given)
    with np.errstate(all="ignore"):
        result = kernel.source.function(*_for_python(there))
    found, expected = (call.after, call.result), (there, result)
    if kernel.source.flags or kernel.__name__ in _ROUNDED:
        return not _is_close(found, expected)
    return bool(exact(found) != exact(expected))


def _names(kernel: Kernel) -> set[str]:
    code = kernel.source.function.__code__
    space = kernel.source.function.__globals__
    return {name for name in code.co_names if isinstance(space.get(name), Kernel)}


def _own() -> list[Kernel]:
    return [one for one in kernels() if one.source.function.__module__.startswith("gazelle.")]


@pytest.mark.parametrize("area", _WARM_UPS)
def test_kernels_do_compiled_what_they_do_in_python(recorded: _Recorded, area: str) -> None:
    names = f"gazelle.{area}."
    calls = {
        kernel: call
        for kernel, call in recorded.calls.items()
        if kernel.__module__.startswith(names)
    }
    assert len(calls) > 1
    assert [
        kernel.source.name
        for kernel, call in calls.items()
        if kernel.__name__ not in _NOT_PYTHONS and _differs(kernel, call)
    ] == []


def test_every_kernel_is_compiled_for_one_kind_of_arguments(recorded: _Recorded) -> None:
    several = {one.source.name: len(found) for one, found in recorded.types.items()}
    assert {name: count for name, count in several.items() if count > 1} == {}


def test_every_kernel_is_warmed_up_or_called_by_another(recorded: _Recorded) -> None:
    own = _own()
    assert len(own) > 90
    called = set().union(*map(_names, own))
    idle = [
        one.source.name for one in own if one not in recorded.calls and one.__name__ not in called
    ]
    assert idle == []


# Other arguments than those of the warm-up

_Vary = Callable[[tuple[Any, ...], np.random.Generator], tuple[Any, ...]]


def _other_costs(given: tuple[Any, ...], random: np.random.Generator) -> tuple[Any, ...]:
    costs = random.choice(np.array([0, 0, 0, 1, 60, 130, 252, 253, 254, 255], np.uint8), (40, 40))
    # Where the searches begin and end.
    costs.ravel()[[410, 1230]] = 0
    return costs, *given[1:]


def _other_seeds(given: tuple[Any, ...], random: np.random.Generator) -> tuple[Any, ...]:
    return random.random((40, 40)) < 0.02, *given[1:]


def _other_graph(given: tuple[Any, ...], random: np.random.Generator) -> tuple[Any, ...]:
    tails, heads = random.integers(0, 30, (2, 80))
    return tails, heads, random.random(80), 30, 3


def _other_points(given: tuple[Any, ...], random: np.random.Generator) -> tuple[Any, ...]:
    return random.uniform(-2, 2, (5, 3)), random.uniform(-1, 1, (6, 3))


def _other_particles(given: tuple[Any, ...], random: np.random.Generator) -> tuple[Any, ...]:
    particles, ends = random.uniform(-0.5, 4.5, (27, 3)), random.uniform(-2, 2, (8, 2))
    used, field = random.random(8) < 0.7, random.random((40, 40)).astype(np.float32)
    return particles, ends, used, field, *given[4:6], np.zeros(27)


def _other_controls(given: tuple[Any, ...], random: np.random.Generator) -> tuple[Any, ...]:
    return given[0], random.uniform(-1, 1, (8, 3)), *given[2:]


def _other_angles(given: tuple[Any, ...], random: np.random.Generator) -> tuple[Any, ...]:
    return given[0], random.uniform(-math.pi, math.pi, 1), *given[2:]


def _other_place(given: tuple[Any, ...], random: np.random.Generator) -> tuple[Any, ...]:
    places = [np.float64(number) for number in random.uniform(-2, 2, 3)]
    return *given[:2], *places


def _other_picture(given: tuple[Any, ...], random: np.random.Generator) -> tuple[Any, ...]:
    return random.integers(0, 60, (8, 8, 3)).astype(np.uint8), *given[1:]


_VARIED: dict[str, _Vary] = {
    "navigation.planners.astar_kernels.astar": _other_costs,
    "navigation.planners.astar_kernels.theta_star": _other_costs,
    "navigation.controllers.dwa_dwb_kernels.distance_field": _other_costs,
    "navigation.costmap.costmap_kernels.inflate_window": _other_costs,
    "navigation.costmap.costmap_kernels.fill_polygon": _other_costs,
    "navigation.costmap.costmap_kernels.squared_distances": _other_seeds,
    "navigation.localization.amcl_kernels.log_sums": _other_particles,
    "navigation.controllers.mppi_kernels.roll_out": _other_controls,
    "mapping.loop_detection.shortest_path_kernels.shortest_ways": _other_graph,
    "mapping.scan_matching.matching_kernels.mean_value": _other_place,
    "motion.collision.gjk_kernels.outside_m": _other_points,
    "motion.kinematics.kernels.chain_pose": _other_angles,
    "motion.kinematics.kernels.tree": _other_angles,
    "sensors.pixel_kernels.mark_edges": _other_picture,
}


@pytest.mark.parametrize("name", _VARIED)
def test_kernels_do_the_same_with_what_comes_by_chance(recorded: _Recorded, name: str) -> None:
    (found,) = (one for one in recorded.calls if one.source.name == f"gazelle.{name}")
    random = np.random.default_rng(7)
    for _ in range(2):
        given = _VARIED[name](recorded.calls[found].given, random)
        here = _copied(given)
        result = found(*here)
        assert not _differs(found, _Call(given, here, result))
