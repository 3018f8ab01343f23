"""Which names of a kernel keep their value, and when a function is another one."""

from __future__ import annotations

import ast
import math
import textwrap
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest

from gazelle.kernels import External, kernel
from gazelle.kernels.source import KernelSource, digest_of, fingerprint, settled_names, tree_of


def _settled(body: str) -> set[str]:
    head = "def f(a, b):\n"
    (function,) = ast.parse(head + textwrap.indent(textwrap.dedent(body).strip(), "    ")).body
    assert isinstance(function, ast.FunctionDef)
    return set(settled_names(function))


@pytest.mark.parametrize(
    ("body", "settled"),
    [
        ("return a + b", "ab"),
        ("x = a\nreturn x", "abx"),
        ("x = a\nx = b\nreturn x", "ab"),
        ("x = a\nx += b\nreturn x", "ab"),
        ("a += 1\nreturn a", "b"),
        ("a[0] += 1\nreturn a", "ab"),
        ("a.x = b\nreturn a", "ab"),
        ("x = y = a\nreturn x + y", "abxy"),
        ("x, (y, z) = a\nreturn x + y + z", "abxyz"),
        ("a, b = b, a\nreturn a", ""),
        ("if a:\n    x = b\n    y = x\nreturn 1", "abxy"),
        ("if a:\n    x = b\nreturn x", "ab"),
        ("if a:\n    x = 1\nelse:\n    x = 2\nreturn x", "ab"),
        ("if a:\n    x = 1\nelse:\n    y = 2\n    b = y", "axy"),
        ("x = a\nif b:\n    return x\nreturn x", "abx"),
        ("for k in range(a):\n    x = k\n    b[x] = k", "abkx"),
        ("for k in range(a):\n    b[0] = k\nreturn k", "ab"),
        ("for k in range(a):\n    if k > 0:\n        b[0] = x\n    x = k", "abk"),
        ("for k in range(a):\n    b[k] = 0\nfor k in range(a):\n    b[k] = 0", "ab"),
        ("x = 0\nwhile x < a:\n    x += 1", "ab"),
        ("x = 0\nwhile a > x:\n    a -= 1", "bx"),
        ("while a:\n    x = b\n    a = x", "bx"),
        ("for a in range(b):\n    pass", "b"),
        ("x = a if b else 1\nreturn (x, x)", "abx"),
    ],
)
def test_a_name_is_settled_that_is_given_a_value_once_before_and_around_its_uses(
    body: str, settled: str
) -> None:
    assert _settled(body) == set(settled)


def _function(body: str, name: str = "f") -> Callable[..., Any]:
    space: dict[str, Any] = {}
    exec(f"def {name}(a):\n    {body}", space)
    made: Callable[..., Any] = space[name]
    made.__module__ = __name__
    return made


def test_the_digest_of_a_function_changes_with_its_code() -> None:
    bodies = ("return a + 1", "return a + 2", "return a + 1.0", "return a - 1", "return min(a, 1)")
    digests = {digest_of(KernelSource(_function(body))) for body in (*bodies, "return max(a, 1)")}
    assert len(digests) == 6


def test_the_digest_of_a_function_changes_with_its_flags() -> None:
    function = _function("return a + 1")
    digests = {digest_of(KernelSource(function, flags)) for flags in ("", "fast", "nsz")}
    assert len(digests) == 3


def test_the_digest_of_a_function_does_not_change_with_its_place_or_comments() -> None:
    one = _function("return a + 1")
    other = _function("# nothing\n\n    return a + 1  # the next one")
    assert digest_of(KernelSource(one)) == digest_of(KernelSource(other))


class _Pair(NamedTuple):
    a: float
    b: float


@kernel
def _twice(x):
    return 2 * x


@pytest.mark.parametrize(
    "thing",
    [1, 1.0, True, (1, 2), (1, 2.0), np.float32(1), np.int8(1), np.dtype("f4"), "f4", np.float32,
     External("f", 1), External("f", 2), External("g", 1), _Pair, _twice, math.sqrt, math.log, min,
     np.zeros, np.ones, np.float64],
)  # fmt: skip
def test_what_is_compiled_in_has_a_fingerprint_of_its_own(thing: object) -> None:
    others = [1, 1.0, True, (1, 2), (1, 2.0), np.float32(1), np.int8(1), np.dtype("f4"), "f4"]
    others += [External("f", 1), External("f", 2), External("g", 1), _Pair, _twice, np.float32]
    others += [math.sqrt, math.log, min, np.zeros, np.ones, np.float64]
    assert fingerprint(thing)
    assert [fingerprint(other) for other in others].count(fingerprint(thing)) == 1


def test_a_module_stands_for_what_is_taken_of_it() -> None:
    assert fingerprint(math) == fingerprint(np) == ""


def test_a_kernels_tree_is_found_below_its_decorators() -> None:
    assert tree_of(_twice.source).name == "_twice"
    assert tree_of(KernelSource(_settled)).name == "_settled"


def test_a_function_that_is_not_where_it_was_is_told() -> None:
    nameless = kernel(lambda x: x)
    line = nameless.source.function.__code__.co_firstlineno
    nowhere = kernel(_function("return a"))
    for run, place in ((nameless, f"{__file__}:{line}"), (nowhere, "<string>:1")):
        with pytest.raises(TypeError) as error:
            run(1)
        assert str(error.value) == f"the source of the kernel {run.source.name} is not at {place}"


def test_a_kernel_is_named_with_its_module() -> None:
    assert _twice.source.name == "tests.kernels.test_source._twice"
    assert repr(_twice) == "<kernel tests.kernels.test_source._twice>"
    assert _twice.__name__ == "_twice"
    assert _twice.__wrapped__(2) == _twice.source.function(2) == 4  # type: ignore[attr-defined]
