"""What went wrong in a launch, as diagnostics: in plain words, with the user's lines."""

from __future__ import annotations

import builtins
import inspect
import os
import re
import shutil
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

from gazelle.diagnostics import Diagnostic, Diagnostics, SourceSpan, did_you_mean
from gazelle.documents.files import is_folder
from gazelle.documents.yaml import ProblemKind, PyYamlError, YamlProblem, problem_of
from gazelle.launch.environment import ROS_COMMANDS
from gazelle.launch.ros2.conditions import InvalidConditionExpressionError
from gazelle.launch.ros2.invalid_launch_file_error import InvalidLaunchFileError
from gazelle.launch.ros2.substitutions.substitution_failure import SubstitutionFailure
from gazelle.launch.ros2.user_spans import is_the_users, kept_explanation, kept_span, raising_span
from gazelle.node_specs.unavailable_packages import replacement_of
from gazelle.workspace.ament_index import PackageNotFoundError

__all__ = ["Explained", "diagnose", "explain", "explain_yaml", "not_started", "with_diagnostic"]

_QUOTES = "put the value into quotes: YAML takes it for a number or a bool"
# What an error of the launch itself says, its code, and what to do where the code says too little.
_PHRASES = (
    ("Required launch argument", "ros2_launch.argument-missing", ""),
    (
        "Included launch description missing required argument",
        "ros2_launch.argument-missing",
        "",
    ),
    ("is not valid. Valid options are", "ros2_launch.argument-choice", ""),
    ("Unrecognized entity of the type", "ros2_launch.bad-element", ""),
    ("Unknown substitution", "ros2_launch.bad-element", ""),
    ("Unexpected attribute(s) found", "ros2_launch.bad-element", ""),
    ("Unexpected key(s) found", "ros2_launch.bad-element", ""),
    ("Unexpected nested ", "ros2_launch.bad-element", ""),
    ("launch files include each other without end", "ros2_launch.include-cycle", ""),
    ("Expected 'launch' as root tag", "ros2_launch.bad-file", "begin the file with launch"),
    ("Expected only one root", "ros2_launch.bad-file", "begin the file with launch"),
    ("Expected entity `launch` to have children", "ros2_launch.bad-file", "put '- ' before each"),
    ("must be a dictionary with only one key", "ros2_launch.bad-file", "put '- ' before each"),
    (
        "does not contain the required function",
        "ros2_launch.bad-file",
        "write it, or correct its name",
    ),
    (
        ", not a LaunchDescription",
        "ros2_launch.bad-file",
        "end it with return LaunchDescription([…])",
    ),
    ("expected to be of type '<class 'str'>', got", "ros2_launch.bad-element", _QUOTES),
    ("not well-formed XML", "ros2_launch.bad-file", ""),
    ("Invalid node name: ", "ros2_launch.bad-name", ""),
    ("Invalid namespace: ", "ros2_launch.bad-name", ""),
    ("The resulting namespace is invalid", "ros2_launch.bad-name", ""),
    ("as yaml. If the parameter is meant to be a string", "ros2_launch.parameter-value", ""),
    ("has an unexpected type for parameter value", "ros2_launch.parameter-value", ""),
    ("Allowed value types are bytes", "ros2_launch.parameter-value", ""),
    ("executed more than once", "ros2_launch.exception", "make a second one for the second place"),
)
_EXCEPTION = "ros2_launch.exception"
_SUBSTITUTION = "ros2_launch.substitution"
_NOT_IN_MODULE = re.compile(r"cannot import name '(\w+)' from '([\w.]+)'")
_MISSING_ATTRIBUTE = re.compile(r"Attribute '([\w-]+)' .*not found in Entity '(\w+)'")
_MISSING_KEY = re.compile(r"Can not find attribute '([\w-]+)' in Entity '(\w+)'")
# What ROS 1 and haste call attributes.
_MEANT = {"exec": "ROS 1's type= is exec= here", "message": "its text goes into message="}
_TABS = "indent with blanks: YAML takes no tabs"
_YAML_FIXES = {
    ProblemKind.TAB: _TABS,
    ProblemKind.TAB_INDENT: _TABS,
    ProblemKind.MAPPING_VALUE: "put the value into quotes: it holds ': '",
}
_MODULES = (
    "launch",
    "launch.actions",
    "launch.conditions",
    "launch.event_handlers",
    "launch.events",
    "launch.launch_description_sources",
    "launch.substitutions",
    "launch_ros.actions",
    "launch_ros.descriptions",
    "launch_ros.parameter_descriptions",
    "launch_ros.substitutions",
)
_INSTALL = "put its package into the workspace's src, or source an installed ROS 2 that has it"
_ATTRIBUTE = "_gazelle_diagnostic"
_MAX_LETTERS = 3


class Explained(NamedTuple):
    """What an error means.

    Attributes:
        code: of the finding.
        message: in words; empty for those of the error.
        fix: what to do; empty for that of the code.
    """

    code: str
    message: str = ""
    fix: str = ""


def explain(error: BaseException) -> Explained | None:
    """Return what is known about an error, None when its own words have to do."""
    message, fix = kept_explanation(error)
    if message or fix:
        is_known = isinstance(error, SubstitutionFailure)
        return Explained(_SUBSTITUTION if is_known else _EXCEPTION, message, fix)
    for kind, function in _KINDS:
        if isinstance(error, kind):
            found = function(error)
            if found is not None:
                return found
    if type(error).__name__ == "XacroException":
        return _xacro(error)
    text = str(error)
    if isinstance(error, KeyError | NameError) or _raised_by_the_user(error):
        return None
    for phrase, code, fix in _PHRASES:
        if phrase in text:
            return Explained(code, fix=fix)
    return None


def explain_yaml(problem: YamlProblem) -> Explained:
    """Say shortly what is wrong with a YAML launch file; the place is shown anyway."""
    if not problem.has_place:
        return Explained("ros2_launch.bad-file")
    message = f"not YAML: {' '.join(filter(None, (problem.what, problem.context)))}"
    return Explained("ros2_launch.bad-file", message, _YAML_FIXES.get(problem.kind, ""))


def with_diagnostic(
    error: Exception,
    code: str,
    message: str,
    span: SourceSpan | None = None,
    *,
    fix: str = "",
) -> Exception:
    """Return an error that brings its own finding along, to be raised."""
    diagnostics = Diagnostics()
    diagnostics.report(code, message, span, fix=fix)
    setattr(error, _ATTRIBUTE, next(iter(diagnostics)))
    return error


def diagnose(error: BaseException) -> list[Diagnostic]:
    """Return what an error means for the user's files: the innermost causes and their lines."""
    found = Diagnostics()
    for cause in _causes(error):
        own: Diagnostic | None = getattr(cause, _ATTRIBUTE, None)
        if own is not None:
            found.add(own)
            continue
        known = explain(cause) or Explained(_code(cause))
        message = known.message or f"{type(cause).__name__}: {cause}"
        found.report(known.code, message, _span(cause, error), fix=known.fix)
    return list(found)


def not_started(
    error: Exception, cmd: Sequence[str], cwd: str | None, span: SourceSpan | None
) -> Diagnostic:
    """Return the finding about a process that cannot be started."""
    program = cmd[0] if cmd else ""
    fix = ""
    if cwd is not None and not is_folder(Path(cwd)):
        message = f"'{program}' cannot be started: its folder '{cwd}' does not exist"
    elif " " in program.strip() and shutil.which(program.split()[0]):
        message = f"'{program}' is no program: cmd is a list of words, and this is one word"
        fix = f"cmd={program.split()!r}, or shell=True"
    elif len(cmd) > _MAX_LETTERS and all(len(word) == 1 for word in cmd):
        message = f"'{''.join(cmd)}' was given as one text, which is taken letter by letter"
        fix = f"cmd={''.join(cmd).split()!r}"
    elif isinstance(error, FileNotFoundError):
        message = f"the program '{program}' is not on the PATH"
        fix = did_you_mean(program, ROS_COMMANDS)
    else:
        message = f"'{program}' cannot be started: {error}"
    found = Diagnostics()
    found.report("ros2_launch.process-not-started", message, span, fix=fix)
    return next(iter(found))


def _raised_by_the_user(error: BaseException) -> bool:
    frames = [frame for frame, _line in traceback.walk_tb(error.__traceback__)]
    return bool(frames) and is_the_users(frames[-1].f_code.co_filename)


def _package(error: BaseException) -> Explained:
    name = re.search(r"package '([^']*)'", str(error))
    fix = replacement_of(name.group(1)) if name and "did you mean" not in str(error) else ""
    return Explained("ros2_launch.package-missing", fix=fix)


def _module(error: BaseException) -> Explained:
    assert isinstance(error, ModuleNotFoundError)
    name = error.name or ""
    top, _, rest = name.partition(".")
    if rest and top in sys.modules:
        return Explained("ros2_launch.import", fix=did_you_mean(name, _modules_of(top)))
    return Explained("ros2_launch.import", fix=_where_to_get(top))


def _modules_of(top: str) -> list[str]:
    return sorted(name for name in sys.modules if name.startswith(f"{top}."))


def _where_to_get(module: str) -> str:
    from gazelle.launch.environment import drop_in_folder

    known = {path.stem for path in drop_in_folder().iterdir() if path.is_dir()}
    hint = did_you_mean(module, sorted(known | set(sys.stdlib_module_names)))
    replaced = replacement_of(module)
    if hint or replaced:
        return hint or replaced
    if module.endswith(
        ("_msgs", "_interfaces", "_common", "_utils", "_ros", "_launch", "_bringup")
    ):
        return f"if it is ROS's, {_INSTALL}"
    return f"a package of Python: pip install {module}; a package of ROS: {_INSTALL}"


def _import(error: BaseException) -> Explained | None:
    """Name modules as users know them, and say where a name is that a module does not have."""
    found = _NOT_IN_MODULE.search(str(error))
    if found is None:
        return None
    name, module = found.groups()
    public = _public_name(module)
    message = f"ImportError: cannot import name '{name}' from '{public}'"
    inside = vars(sys.modules[module]) if module in sys.modules else {}
    hint = _imported_from(name) or did_you_mean(name, sorted(inside))
    return Explained("ros2_launch.import", message, hint)


def _public_name(module: str) -> str:
    if not module.startswith("gazelle."):
        return module
    places = [
        name
        for name, one in list(sys.modules.items())
        if getattr(one, "__name__", "") == module and not name.startswith("gazelle.")
    ]
    return min(places, key=len, default=module)


def _imported_from(name: str) -> str:
    """Return the import that a name of launch needs, empty for other names."""
    for module in _MODULES:
        if inspect.isclass(vars(import_module(module)).get(name)):
            return f"from {module} import {name}"
    return ""


def _name(error: BaseException) -> Explained | None:
    assert isinstance(error, NameError)
    name = error.name or ""
    frames = [frame for frame, _line in traceback.walk_tb(error.__traceback__)]
    if not frames:
        return None
    known = {*frames[-1].f_locals, *frames[-1].f_globals, *vars(builtins)}
    near = did_you_mean(name, sorted(one for one in known if not one.startswith("__")))
    wanted = _imported_from(name)
    fix = f"an import is missing: {wanted}" if wanted else near
    return Explained(_EXCEPTION, fix=fix)


def _key(error: BaseException) -> Explained | None:
    """Tell of a variable of the environment that is not set."""
    frames = [frame for frame, _line in traceback.walk_tb(error.__traceback__)]
    if not frames or frames[-1].f_code.co_filename != os.environ.__getitem__.__code__.co_filename:
        return None
    name = str(error.args[0])
    return Explained(
        "ros2_launch.exception",
        f"KeyError: '{name}': the environment variable {name} is not set",
        f"export {name}=… in the shell before the launch",
    )


def _type(error: BaseException) -> Explained | None:
    if "generate_launch_description() missing" in str(error):
        fix = "it takes no arguments; a function with a context goes into an OpaqueFunction"
        return Explained("ros2_launch.bad-file", fix=fix)
    return None


def _attribute(error: BaseException) -> Explained | None:
    found = _MISSING_ATTRIBUTE.search(str(error)) or _MISSING_KEY.search(str(error))
    if found is None:
        return None
    name, element = found.groups()
    message = f"{element} lacks its attribute {name}: {error}"
    hint = _MEANT.get(name, "")
    return Explained(
        "ros2_launch.bad-element", message, f"add {name}" + (f"; {hint}" if hint else "")
    )


def _yaml(error: BaseException) -> Explained:
    assert isinstance(error, PyYamlError)
    return explain_yaml(problem_of(error, ""))


def _xacro(error: BaseException) -> Explained:
    files = getattr(sys.modules.get("xacro"), "filestack", None)
    if not files:
        return Explained(_EXCEPTION)
    message = f"XacroException: {str(error).strip()}, in '{files[-1]}'"
    return Explained(_EXCEPTION, message, f"`xacro {files[0]}` shows the place")


def _bad_file(_error: BaseException) -> Explained:
    return Explained("ros2_launch.bad-file")


def _causes(error: BaseException) -> Iterator[BaseException]:
    """Yield the errors that readers gave up for, else the error itself."""
    likely = getattr(error, "likely_errors", ())
    if not likely:
        yield error
        return
    # What the reader for the file's own extension says; the others only say that it is not theirs.
    yield from _causes(likely[0])


def _code(error: BaseException) -> str:
    if isinstance(error, SubstitutionFailure):
        return "ros2_launch.substitution"
    if isinstance(error, InvalidConditionExpressionError):
        return "ros2_launch.bad-condition"
    if isinstance(error, FileNotFoundError) and raising_span(error) is None:
        return "ros2_launch.file-missing"
    return "ros2_launch.exception"


def _span(cause: BaseException, error: BaseException) -> SourceSpan | None:
    return raising_span(cause) or kept_span(cause) or kept_span(error)


_KINDS: tuple[tuple[type[BaseException], Callable[[BaseException], Explained | None]], ...] = (
    (PackageNotFoundError, _package),
    (ModuleNotFoundError, _module),
    (ImportError, _import),
    (NameError, _name),
    (KeyError, _key),
    (TypeError, _type),
    (AttributeError, _attribute),
    (PyYamlError, _yaml),
    (SyntaxError, _bad_file),
    (InvalidLaunchFileError, _bad_file),
)
