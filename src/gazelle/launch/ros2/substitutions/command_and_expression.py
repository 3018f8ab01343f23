"""command, eval."""

from __future__ import annotations

import importlib
import shlex
import shutil
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from gazelle.documents import LimitError
from gazelle.documents.command_output import CommandResult, run_limited
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.frontend import expose_substitution
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.substitutions.substitution_failure import (
    SubstitutionFailure,
    counted,
    described,
)
from gazelle.launch.ros2.user_spans import keep_explanation
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["Command", "PythonExpression"]

_ON_STDERR = ("fail", "ignore", "warn", "capture")


@expose_substitution("command")
class Command(Substitution):
    """What a command prints.

    Attributes:
        command: its words, joined as they are.
        on_stderr: what is done when it prints errors: fail, ignore, warn or capture.
    """

    def __init__(
        self, command: SomeSubstitutionsType, *, on_stderr: SomeSubstitutionsType = "fail"
    ) -> None:
        super().__init__()
        self.command = normalize_to_list_of_substitutions(command)
        self.on_stderr = normalize_to_list_of_substitutions(on_stderr)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[Command], dict[str, Any]]:
        """Return class and arguments of a ``$(command 'words' on_stderr)``."""
        names = ("command", "on_stderr")
        return cls, dict(zip(names, counted(data, 1, 2, "command"), strict=False))

    def describe(self) -> str:
        """Return a text for people."""
        return f"Command({described(self.command)})"

    def perform(self, context: LaunchContext) -> str:
        """Return what the command prints.

        Raises:
            SubstitutionFailure: it does not exist, fails, or prints errors.
        """
        line = perform_substitutions(context, self.command)
        on_stderr = perform_substitutions(context, self.on_stderr)
        if on_stderr not in _ON_STDERR:
            raise SubstitutionFailure(
                "expected 'on_stderr' to be one of: 'fail', 'ignore', 'warn' or 'capture'"
            )
        try:
            result = run_limited(shlex.split(line), joined=on_stderr == "capture")
        except (OSError, ValueError, IndexError) as error:
            what = "file not found" if isinstance(error, FileNotFoundError) else "cannot run"
            failure = SubstitutionFailure(f"{what}: {error}. Command: {line}")
            raise failure.explained(fix=_missing_blank(line)) from error
        except LimitError as error:
            raise SubstitutionFailure(f"{error}. Command: {line}") from error
        _check(result, line, on_stderr)
        return result.stdout


def _check(result: CommandResult, line: str, on_stderr: str) -> None:
    if result.returncode != 0:
        message = f"executed command failed. Command: {line}"
        if result.stderr:
            message += f"\nCaptured stderr output: {result.stderr}"
        raise _failed(message, f"the command failed with exit code {result.returncode}", result)
    if not result.stderr or on_stderr == "ignore":
        return
    message = f"executed command showed stderr output. Command: {line}"
    message += f"\nCaptured stderr output:\n{result.stderr}"
    if on_stderr == "fail":
        raise _failed(message, "the command wrote to stderr, which counts as failure", result)
    launch_logging.get_logger().warning(message)


def _failed(message: str, what: str, result: CommandResult) -> SubstitutionFailure:
    """Return the error about a command: what it wrote stands in the log line above."""
    line = shlex.join(result.argv)
    first = (result.stderr or result.stdout).strip().partition("\n")[0]
    return SubstitutionFailure(message).explained(
        short=f"{what}: {line}" + (f": {first}" if first else ""),
        fix=f"run it by hand: {line}",
    )


def _missing_blank(line: str) -> str:
    """Return what to write when a command and its first argument are one word."""
    program = line.partition("/")[0]
    if program.strip() == program and program and shutil.which(program):
        return f"Command joins its words as they are: write '{program} ', with a blank behind it"
    return ""


@expose_substitution("eval")
class PythonExpression(Substitution):
    """What a Python expression comes to, as a text.

    The names of ``math`` are known in it, and the modules that are asked for.

    Attributes:
        expression: the expression.
        python_modules: names of the modules.
    """

    def __init__(
        self,
        expression: SomeSubstitutionsType,
        python_modules: SomeSubstitutionsType = ("math",),
    ) -> None:
        super().__init__()
        self.expression = normalize_to_list_of_substitutions(expression)
        self.python_modules = normalize_to_list_of_substitutions(python_modules)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[PythonExpression], dict[str, Any]]:
        """Return class and arguments of an ``$(eval 'expression' 'module, module')``."""
        data = counted(data, 1, 2, "eval")
        kwargs: dict[str, Any] = {"expression": data[0]}
        if len(data) > 1:
            modules = "".join(sub.text for sub in data[1]).split(",")
            kwargs["python_modules"] = [module.strip() for module in modules]
        return cls, kwargs

    def describe(self) -> str:
        """Return a text for people."""
        modules = ", ".join(sub.describe() for sub in self.python_modules)
        return f"PythonExpr({described(self.expression)}, [{modules}])"

    def perform(self, context: LaunchContext) -> str:
        """Return the value as a text."""
        names: dict[str, Any] = {}
        for name in [context.perform_substitution(sub) for sub in self.python_modules]:
            module = importlib.import_module(name)
            if name == "math":
                names.update(vars(module))
            names[name] = module
        expression = perform_substitutions(context, self.expression)
        try:
            # A launch file is a program anyway: this reads what it says.
            return str(eval(expression, {}, names))  # noqa: S307
        except Exception as error:
            kind, fix = type(error).__name__, ""
            if isinstance(error, NameError):
                fix = f"if '{error.name}' is a text, put quotes around it in the expression"
            keep_explanation(error, f"{kind}: {error}, in the expression: {expression}", fix)
            raise
