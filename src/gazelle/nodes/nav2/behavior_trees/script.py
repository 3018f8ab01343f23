"""The scripts of BehaviorTree.CPP 4: ``Script``, ``ScriptCondition``, and attributes of all nodes.

Those are the pre- and postconditions ``_skipIf``, ``_while``, ``_onSuccess`` ….
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping
from typing import Any

from gazelle.errors import GazelleError
from gazelle.nodes.nav2.behavior_trees.tree_node import Blackboard, Decorator, Status

__all__ = ["Conditioned", "ScriptError", "check_script", "conditions_of", "evaluate"]


_TOKEN = re.compile(
    r"\s*(?:(?P<number>0x[0-9a-fA-F]+|\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+)"
    r"|(?P<text>'[^']*')|(?P<name>@?[A-Za-z_][\w.]*)"
    r"|(?P<op>:=|==|!=|<=|>=|&&|\|\||\+=|-=|\*=|/=|\.\.|[-+*/<>=!?:();&|^~]))"
)

_BINARY: tuple[dict[str, Callable[[Any, Any], Any]], ...] = (
    {"||": lambda a, b: bool(a) or bool(b)},
    {"&&": lambda a, b: bool(a) and bool(b)},
    {"==": operator.eq, "!=": operator.ne, "<": operator.lt, "<=": operator.le,
     ">": operator.gt, ">=": operator.ge},
    {"|": lambda a, b: int(a) | int(b), "^": lambda a, b: int(a) ^ int(b),
     "&": lambda a, b: int(a) & int(b)},
    {"+": operator.add, "-": operator.sub, "..": lambda a, b: f"{a}{b}"},
    {"*": operator.mul, "/": operator.truediv},
)  # fmt: skip

_ASSIGN = {":=": None, "=": None, "+=": operator.add, "-=": operator.sub,
           "*=": operator.mul, "/=": operator.truediv}  # fmt: skip
_WORDS = {"true": True, "false": False}
_MAX_LENGTH = 10_000
_MAX_DEPTH = 40

_BEFORE = (
    ("_failureIf", Status.FAILURE),
    ("_successIf", Status.SUCCESS),
    ("_skipIf", Status.SKIPPED),
)

_NAMES = frozenset(
    {"_failureIf", "_successIf", "_skipIf", "_while", "_onSuccess", "_onFailure", "_onHalted",
     "_post"}
)  # fmt: skip


class ScriptError(GazelleError):
    """A script cannot be read, or a key in it has no value."""


class Conditioned(Decorator):
    """Runs scripts before and after its child.

    Attributes:
        conditions: scripts by attribute.
    """

    conditions: Mapping[str, str] = {}

    def tick(self) -> Status:
        """Ask the scripts that come before, tick, run those that come after."""
        if self.child.status is not Status.RUNNING:
            for name, status in _BEFORE:
                if self._holds(name):
                    return status
        if "_while" in self.conditions and not self._holds("_while"):
            self.halt_child(self.child)
            return Status.SKIPPED
        status = self.child.execute()
        if status.is_done:
            self._run("_onSuccess" if status is Status.SUCCESS else "_onFailure")
            self._run("_post")
        return status

    def halted(self) -> None:
        """Run the script of an end by somebody else."""
        self._run("_onHalted")
        self._run("_post")

    def _holds(self, name: str) -> bool:
        script = self.conditions.get(name)
        return script is not None and bool(evaluate(script, self.ports.blackboard))

    def _run(self, name: str) -> None:
        if name in self.conditions:
            evaluate(self.conditions[name], self.ports.blackboard)


class _Reader:
    """Reads and runs in one pass; without a blackboard keys are 0 and nothing is changed."""

    def __init__(self, script: str, blackboard: Blackboard | None) -> None:
        self._script = script
        self._blackboard = blackboard
        self._tokens = _split(script)
        self._at = 0
        self._depth = 0
        self._idle = 0

    def run(self) -> Any:
        value: Any = None
        while self._at < len(self._tokens):
            if self._take(";"):
                continue
            value = self._statement()
            if self._at < len(self._tokens) and not self._take(";"):
                raise self._error(f"'{self._tokens[self._at][1]}' is not expected")
        return value

    def _statement(self) -> Any:
        if self._at + 1 < len(self._tokens) and self._tokens[self._at][0] == "name":
            (_, name), (_, op) = self._tokens[self._at : self._at + 2]
            if op in _ASSIGN:
                self._at += 2
                return self._assign(name, op, self._choice())
        return self._choice()

    def _assign(self, name: str, op: str, value: Any) -> Any:
        combine = _ASSIGN[op]
        if combine is not None:
            value = self._apply(op, combine, self._key(name), value)
        if self._blackboard is not None:
            if op == "=" and not self._blackboard.has(name):
                raise self._error(f"the key '{name}' does not exist; := would make it")
            self._blackboard.set(name, value)
        return value

    def _choice(self) -> Any:
        self._depth += 1
        if self._depth > _MAX_DEPTH:
            raise self._error("it is nested too deeply")
        value = self._binary(0)
        if self._take("?"):
            first = self._choice()
            if not self._take(":"):
                raise self._error("a ':' is missing after '?'")
            second = self._choice()
            value = first if value else second
        self._depth -= 1
        return value

    def _binary(self, level: int) -> Any:
        if level == len(_BINARY):
            return self._unary()
        value = self._binary(level + 1)
        while self._at < len(self._tokens) and self._tokens[self._at][1] in _BINARY[level]:
            kind, op = self._tokens[self._at]
            if kind != "op":
                break
            self._at += 1
            # What is not asked for must not fail: `a && b` with a false.
            rests = (op == "&&" and not value) or (op == "||" and bool(value))
            self._idle += rests
            other = self._binary(level + 1)
            self._idle -= rests
            value = self._apply(op, _BINARY[level][op], value, other)
        return value

    def _unary(self) -> Any:
        for op, apply in (("!", operator.not_), ("-", operator.neg), ("~", operator.invert)):
            if self._take(op):
                self._depth += 1
                if self._depth > _MAX_DEPTH:
                    raise self._error("it is nested too deeply")
                value = self._unary()
                self._depth -= 1
                return self._apply(op, _one_sided(apply), value, None)
        return self._primary()

    def _primary(self) -> Any:
        if self._take("("):
            value = self._choice()
            if not self._take(")"):
                raise self._error("a ')' is missing")
            return value
        if self._at >= len(self._tokens):
            raise self._error("it ends too early")
        kind, text = self._tokens[self._at]
        self._at += 1
        if kind == "number":
            return float(int(text, 16)) if text.startswith("0x") else float(text)
        if kind == "text":
            return text[1:-1]
        if kind == "name":
            return _WORDS[text] if text in _WORDS else self._key(text)
        raise self._error(f"'{text}' is not expected")

    def _key(self, name: str) -> Any:
        if self._blackboard is None or self._idle:
            return 0.0
        if not self._blackboard.has(name):
            raise self._error(f"the key '{name}' of the blackboard is not set")
        return self._blackboard.get(name)

    def _apply(self, op: str, do: Callable[[Any, Any], Any], a: Any, b: Any) -> Any:
        if self._blackboard is None or self._idle:
            return 0.0
        try:
            return do(a, b)
        except (TypeError, ValueError, ZeroDivisionError, OverflowError) as error:
            raise self._error(f"{a!r} {op} {b!r}: {error}") from error

    def _take(self, op: str) -> bool:
        found = self._at < len(self._tokens) and self._tokens[self._at] == ("op", op)
        self._at += found
        return found

    def _error(self, text: str) -> ScriptError:
        return ScriptError(f"script '{self._script}': {text}")


def evaluate(script: str, blackboard: Blackboard) -> Any:
    """Run a script and return the value of its last statement.

    Raises:
        ScriptError: it cannot be read, a key has no value, or the types do not fit.
    """
    return _Reader(script, blackboard).run()


def check_script(script: str) -> str:
    """Return what is wrong with a script's grammar, empty when nothing is."""
    try:
        _Reader(script, None).run()
    except ScriptError as error:
        return str(error)
    return ""


def conditions_of(attributes: Mapping[str, str]) -> dict[str, str]:
    """Return the conditions among a node's attributes."""
    return {name: text for name, text in attributes.items() if name in _NAMES}


def _one_sided(apply: Callable[[Any], Any]) -> Callable[[Any, Any], Any]:
    return lambda value, _nothing: apply(value)


def _split(script: str) -> list[tuple[str, str]]:
    if len(script) > _MAX_LENGTH:
        raise ScriptError(f"a script of {len(script)} characters is too long")
    found, at = [], 0
    text = script.rstrip()
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise ScriptError(f"script '{script}': '{text[at:].strip()[:10]}' is not understood")
        kind = str(match.lastgroup)
        found.append((kind, match.group(kind)))
        at = match.end()
    return found
