"""``$(find|env|optenv|arg|anon|eval|dirname …)`` in roslaunch attributes."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.documents import Budget, LimitError, compile_limited
from gazelle.errors import NotFoundError
from gazelle.graph.names import anonymous_name
from gazelle.workspace import Workspace

__all__ = ["REPORTED", "UNREADABLE", "Substitution", "SubstitutionError"]

# The value of an argument whose own text has no value; no XML text holds this character.
UNREADABLE = "\0"
# The code of what follows from a mistake that is reported already.
REPORTED = ""

_CALL = re.compile(r"\$\(([^()]*(?:\([^()]*\)[^()]*)*)\)")
_FIND = re.compile(r"\$\(find([^()]*)\)")
_WORDS = ("find", "env", "optenv", "arg", "anon", "eval", "dirname")


class SubstitutionError(Exception):
    """A ``$(…)`` has no value.

    Attributes:
        code: the diagnostic's code.
        fix: what to do, or empty for the catalogue's advice.
        phrase: what roslaunch prints, or empty for the catalogue's.
    """

    def __init__(self, code: str, message: str, fix: str = "", phrase: str = "") -> None:
        self.code = code
        self.phrase = phrase
        self.fix = fix
        super().__init__(message)


@dataclass(frozen=True, slots=True)
class Substitution:
    """Evaluates the expressions of one file (wiki: roslaunch/XML, substitution args).

    Attributes:
        workspace: answers ``$(find …)``.
        args: values of the file's arguments; None for a declared one without value.
        directory: answers ``$(dirname)``.
        environ: answers ``$(env …)``.
        anonymous: names handed out by ``$(anon …)``, the same id gives the same name.
    """

    workspace: Workspace
    args: Mapping[str, str | None]
    directory: str
    environ: Mapping[str, str]
    anonymous: dict[str, str]

    def apply(self, text: str) -> str:
        """Return the text with every ``$(…)`` replaced.

        Raises:
            SubstitutionError: one of them has no value.
        """
        if "$(" not in text:
            return text
        if text.startswith("$(eval ") and text.endswith(")"):
            return str(self._eval(text[len("$(eval ") : -1]))
        # roslaunch resolves $(find …) last, so that other values may complete it:
        # $(find $(arg robot)_description), or a '$' of its own before '(find …)'.
        text = _CALL.sub(self._call_unless_find, text)
        return _FIND.sub(lambda match: self._find(match.group(1).split()), text)

    def _call_unless_find(self, match: re.Match[str]) -> str:
        body = match.group(1)
        if body.split()[:1] != ["find"]:
            return self._call(body)
        return f"$({_CALL.sub(self._call_unless_find, body)})"

    def _call(self, body: str) -> str:
        word, *rest = body.split() or [""]
        if word == "eval":
            raise SubstitutionError(
                "launch.substitution",
                f"$(eval …) must be the whole attribute, not a part: '$({body})'",
                "put the text around it into the expression: $(eval 'a' + arg('b'))",
            )
        handlers: dict[str, Callable[[list[str]], str]] = {
            "find": self._find,
            "env": self._env,
            "optenv": self._optenv,
            "arg": self._arg,
            "anon": self._anon,
            "dirname": lambda _rest: self.directory,
        }
        if word not in handlers:
            raise SubstitutionError(
                "launch.substitution",
                f"unknown substitution '$({body})'; known are {', '.join(_WORDS)}",
                did_you_mean(word, _WORDS),
            )
        return handlers[word](rest)

    def _find(self, rest: list[str]) -> str:
        name = _one(rest, "find")
        try:
            return str(self.workspace.package(name).share)
        except NotFoundError as error:
            raise _not_found(name, error) from error

    def _env(self, rest: list[str]) -> str:
        name = _one(rest, "env")
        if name not in self.environ:
            message = f"environment variable '{name}' is not set"
            fix = f"export it before, or write a default: $(optenv {name} …)"
            raise SubstitutionError("launch.env-missing", message, fix, message)
        return self.environ[name]

    def _optenv(self, rest: list[str]) -> str:
        if not rest:
            raise SubstitutionError("launch.substitution", "$(optenv) needs a variable name")
        return self.environ.get(rest[0], " ".join(rest[1:]))

    def _arg(self, rest: list[str]) -> str:
        return self.arg(_one(rest, "arg"))

    def _anon(self, rest: list[str]) -> str:
        name = _one(rest, "anon")
        return self.anonymous.setdefault(name, anonymous_name(name))

    def arg(self, name: str) -> str:
        """Return an argument's value.

        Raises:
            SubstitutionError: it is not declared or has no value.
        """
        if name not in self.args:
            hint = did_you_mean(name, self.args)
            message = f"arg '{name}' is used but not declared above"
            raise SubstitutionError("launch.arg-undeclared", message, hint)
        value = self.args[name]
        if value is None:
            message = f"required arg '{name}' has no value"
            fix = f"give it on the command line: {name}:=…"
            phrase = f"RLException: requires the '{name}' arg to be set"
            raise SubstitutionError("launch.arg-missing", message, fix, phrase)
        if value == UNREADABLE:
            raise SubstitutionError(REPORTED, f"arg '{name}' could not be read")
        return value

    def _eval(self, expression: str) -> Any:
        """Evaluate a Python expression with roslaunch's names and without double underscores."""
        if "__" in expression:
            message = "$(eval ...) may not contain double underscore expressions"
            raise SubstitutionError("launch.substitution", f"{message}: '{expression}'")
        names: dict[str, Any] = {
            key: _eval_value(value)
            for key, value in self.args.items()
            if value not in {None, UNREADABLE}
        }
        names.update(_EVAL_NAMES)
        names["arg"] = lambda name: _eval_value(self.arg(name))
        names["env"] = lambda name: self._env([name])
        names["optenv"] = lambda name, default="": self.environ.get(name, default)
        names["find"] = lambda name: self._find([name])
        names["anon"] = lambda name: self._anon([name])
        names["dirname"] = lambda: self.directory
        try:
            code, budget = compile_limited(expression.strip(), "<eval>"), Budget()
            value = eval(code, {"__builtins__": budget.names}, names)  # noqa: S307 - as roslaunch
            return budget.checked(value)
        except SubstitutionError:
            raise
        except LimitError as error:
            raise SubstitutionError(
                "limits.expression", f"$(eval {expression}): {error}"
            ) from error
        except NameError as error:
            name = error.name or ""
            if name in self.args:
                # It is declared, and has no value; that is told in the words for it.
                self.arg(name)
            raise _failed(expression, error) from error
        except Exception as error:  # the user's expression may raise anything
            raise _failed(expression, error) from error


_EVAL_NAMES: dict[str, Any] = {
    **{name: getattr(math, name) for name in dir(math) if not name.startswith("_")},
    **{
        value.__name__: value
        for value in (abs, bool, dict, float, int, len, list, max, min, round, str, sum, tuple)
    },
    "True": True,
    "False": False,
    "true": True,
    "false": False,
}


def _failed(expression: str, error: Exception) -> SubstitutionError:
    message = f"$(eval {expression}): {type(error).__name__}: {error}"
    return SubstitutionError("launch.substitution", message)


def _not_found(name: str, error: NotFoundError) -> SubstitutionError:
    """Return an error for a wrong name, and a warning for a package that everybody else has."""
    from gazelle.node_specs.unavailable_packages import replacement_of

    what = replacement_of(name, 1)
    if not what:
        return SubstitutionError("launch.package-missing", f"$(find {name}): {error}")
    message = f"$(find {name}): package '{name}' not found; this tag is left out, the rest goes on"
    return SubstitutionError("launch.package-elsewhere", message, what)


def _one(rest: list[str], word: str) -> str:
    if len(rest) != 1:
        message = f"$({word} …) needs exactly one name, found {len(rest)}"
        raise SubstitutionError("launch.substitution", message)
    return rest[0]


def _eval_value(text: str) -> Any:
    """Type an argument as a ``<param>`` would be, since expressions compute with it."""
    for convert in (int, float):
        try:
            return convert(text)
        except ValueError:
            continue
    lowered = text.lower()
    return lowered == "true" if lowered in {"true", "false"} else text


def directory_of(file: str) -> str:
    """Return the folder that ``$(dirname)`` means for a file."""
    return str(Path(file).parent) if file and not file.startswith("<") else os.getcwd()  # noqa: PTH109
