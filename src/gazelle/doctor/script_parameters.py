"""Which parameters a script in Python reads, as its source names them."""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from gazelle.diagnostics import Diagnostics, Severity, SourceSpan, did_you_mean
from gazelle.doctor.script_topics import module_texts, parsed_script, stands_alone

__all__ = ["ScriptParameters", "read_script_parameters", "report_unread"]

# Functions whose first argument is a name: of rospy, and of a node of rclpy.
_ROSPY = frozenset(
    {"delete_param", "get_param", "get_param_cached", "has_param", "search_param", "set_param"}
)
_RCLPY = frozenset({"declare_parameter", "get_parameter", "get_parameter_or", "has_parameter"})
# What reads parameters by no name, or by names of other files.
_OPAQUE_CALLS = frozenset(
    {"__import__", "eval", "exec", "get_param_names", "get_parameters", "get_parameters_by_prefix",
     "import_module", "set_parameters"}
)  # fmt: skip
_OPAQUE_KEYWORDS = frozenset(
    {"allow_undeclared_parameters", "automatically_declare_parameters_from_overrides"}
)
_OPAQUE_MODULES = ("dynamic_reconfigure", "rosparam")


@dataclass(frozen=True, slots=True)
class ScriptParameters:
    """Parameters of a script.

    Attributes:
        names: as written: ``~speed`` or ``/robot/speed`` of rospy, ``limits.speed`` of rclpy.
        is_complete: these are all; False when a name is computed, or other code may read some.
    """

    names: frozenset[str] = frozenset()
    is_complete: bool = False

    def own_names(self) -> list[str]:
        """Return the names below the node, as they are written there."""
        private = {name[1:].lstrip("/") for name in self.names if name.startswith("~")}
        return sorted(private or {name for name in self.names if not name.startswith("/")})

    def reads(self, name: str, full_name: Callable[[str], str]) -> bool:
        """Tell whether a parameter is read, by itself or with all that is above or below it.

        Args:
            name: of a parameter.
            full_name: makes a name of the script the name of a parameter of the same kind.
        """
        known = (full_name(own).rstrip("/") for own in self.names)
        return any(_is_inside(name, own) or _is_inside(own, name) for own in known)


def read_script_parameters(path: Path) -> ScriptParameters:
    """Read a Python node; one that cannot be read is not complete."""
    try:
        return _read(path, path.read_bytes())
    except (OSError, SyntaxError, ValueError):
        return ScriptParameters()


def report_unread(
    node: str,
    name: str,
    known: ScriptParameters,
    script: str,
    span: SourceSpan | None,
    diagnostics: Diagnostics,
) -> None:
    """Report a parameter that a script never reads; a notice where no name is near.

    Args:
        node: global name of the node.
        name: of the parameter, below the node.
        known: what the script reads.
        script: its name.
        span: where the parameter is set.
        diagnostics: receives ``doctor.parameter-unread``.
    """
    text = f"'{node}': parameter '{name}' is set, and {script} never reads it"
    fix = did_you_mean(name, known.own_names())
    if name in known.names:
        # rospy's get_param("speed") is beside the node.
        text += f": '{name}' there is a parameter of its namespace"
        fix = f"write '~{name}' in {script}"
    severity = Severity.WARNING if fix else Severity.INFO
    code = "doctor.parameter-unread"
    diagnostics.report(code, text, span, fix=fix or "take it out", severity=severity)


@lru_cache(maxsize=64)
def _read(path: Path, source: bytes) -> ScriptParameters:
    tree = parsed_script(source)
    texts = module_texts(tree)
    names: set[str] = set()
    is_complete = stands_alone(tree, path) and not _is_opaque(tree)
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        called = node.func.attr if isinstance(node.func, ast.Attribute) else ""
        called = node.func.id if isinstance(node.func, ast.Name) else called
        if called in _ROSPY | _RCLPY:
            found = _text(_first(node), texts)
            names |= {found} if found is not None else set()
            if found is not None and called == "search_param" and found[:1] not in "~/":
                # Upwards, from the node on.
                names.add(f"~{found}")
            is_complete = is_complete and found is not None
        elif called == "declare_parameters":
            listed = _listed(node, texts)
            names |= set(listed or ())
            is_complete = is_complete and listed is not None
        elif called in _OPAQUE_CALLS:
            is_complete = False
    return ScriptParameters(frozenset(names), is_complete)


def _is_opaque(tree: ast.Module) -> bool:
    for node in ast.walk(tree):
        if isinstance(node, ast.keyword) and node.arg in _OPAQUE_KEYWORDS:
            return True
        modules: list[str] = []
        if isinstance(node, ast.Import):
            modules = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            modules = [node.module or ""]
        if any(module.startswith(_OPAQUE_MODULES) for module in modules):
            return True
    return False


def _first(node: ast.Call) -> ast.expr | None:
    if node.args:
        return node.args[0]
    named = ("name", "param_name", "key")
    return next((one.value for one in node.keywords if one.arg in named), None)


def _listed(node: ast.Call, texts: dict[str, str]) -> list[str] | None:
    """Return the names of ``declare_parameters(namespace, [(name, …), …])``."""
    given = {one.arg: one.value for one in node.keywords}
    space = node.args[0] if node.args else given.get("namespace")
    rows = node.args[1] if len(node.args) > 1 else given.get("parameters")
    prefix = _text(space, texts)
    if prefix is None or not isinstance(rows, ast.List | ast.Tuple):
        return None
    found = []
    for row in rows.elts:
        inside = row.elts[0] if isinstance(row, ast.Tuple | ast.List) and row.elts else None
        name = _text(inside, texts)
        if name is None:
            return None
        found.append(f"{prefix}.{name}" if prefix else name)
    return found


def _text(node: ast.expr | None, texts: dict[str, str]) -> str | None:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    return texts.get(node.id) if isinstance(node, ast.Name) else None


def _is_inside(name: str, other: str) -> bool:
    return name == other or name.startswith((f"{other}/", f"{other}."))
