"""What a callback uses is there before anybody can call it: others may at once."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "gazelle"
# What others call from the moment on when it is made.
_OFFERS = frozenset({
    "ActionServer", "NodeParameters", "SimpleActionServer", "create_service", "create_subscription",
    "node_parameters", "offer_parameters",
})  # fmt: skip
_BLOCKS = ast.If | ast.For | ast.With | ast.Try | ast.While | ast.FunctionDef


def early_callbacks(text: str) -> Iterator[str]:
    """Yield where a constructor offers a method that uses what is set only afterwards."""
    for one in ast.walk(ast.parse(text)):
        if isinstance(one, ast.ClassDef):
            yield from _of_class(one)


def _of_class(owner: ast.ClassDef) -> Iterator[str]:
    methods = {one.name: one for one in owner.body if isinstance(one, ast.FunctionDef)}
    if "__init__" not in methods:
        return
    steps = list(_steps(methods["__init__"].body))
    for number, step in enumerate(steps):
        wanted: set[str] = set()
        for name in _offered(step, methods):
            _uses(name, methods, wanted)
        before = set().union(*map(_assigned, steps[:number]))
        later = set().union(*map(_assigned, steps[number:])) - before
        if wanted & later:
            yield f"{step.lineno}: {owner.name} uses {', '.join(sorted(wanted & later))} too early"


def _steps(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    for one in body:
        if isinstance(one, _BLOCKS):
            for part in ("body", "orelse", "finalbody"):
                yield from _steps(getattr(one, part, []))
        else:
            yield one


def _offered(step: ast.stmt, methods: dict[str, ast.FunctionDef]) -> set[str]:
    """Return the methods that a statement hands to something that others call."""
    found: set[str] = set()
    for call in ast.walk(step):
        if not isinstance(call, ast.Call):
            continue
        name = call.func.attr if isinstance(call.func, ast.Attribute) else ast.unparse(call.func)
        if name in _OFFERS:
            handed = [*call.args, *(one.value for one in call.keywords)]
            found |= {own for one in handed for own in _own(one) if own in methods}
    return found


def _uses(name: str, methods: dict[str, ast.FunctionDef], found: set[str]) -> None:
    """Add the attributes that a method and those it calls use."""
    for own in set(_own(methods[name])) - found:
        found.add(own)
        if own in methods:
            _uses(own, methods, found)


def _assigned(step: ast.stmt) -> set[str]:
    targets = step.targets if isinstance(step, ast.Assign) else []
    if isinstance(step, ast.AnnAssign) and step.value is not None:
        targets = [step.target]
    return {own for one in targets for own in _own(one)}


def _own(tree: ast.AST) -> Iterator[str]:
    for one in ast.walk(tree):
        if isinstance(one, ast.Attribute) and ast.unparse(one.value) == "self":
            yield one.attr


_EARLY = """
class Listener:
    def __init__(self, node):
        self._node = node
        node.create_subscription("a", None, self._take)
        {after}

    def _take(self, message):
        self._tell(message)

    def _tell(self, message):
        self._heard.append(message)
"""


def test_a_callback_that_uses_what_is_set_later_is_found() -> None:
    assert list(early_callbacks(_EARLY.format(after="self._heard = []"))) == [
        "5: Listener uses _heard too early"
    ]
    assert not list(early_callbacks(_EARLY.format(after="self._other = []")))


def test_no_constructor_offers_a_callback_too_early() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{line}"
        for path in sorted(SOURCE.rglob("*.py"))
        for line in early_callbacks(path.read_text(encoding="utf-8"))
    ]
    assert not found, "\n".join(found)
