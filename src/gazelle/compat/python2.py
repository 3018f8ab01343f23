"""Python 2 sources run by Python 3: translated in memory, the file stays as it is.

`fissix` (the maintained 2to3) rewrites the syntax and the renamed builtins; the division of two
integers keeps Python 2's meaning through a change of the syntax tree.
"""

from __future__ import annotations

import ast
import builtins
import hashlib
import os
import re
import sys
from types import CodeType
from typing import Any

from gazelle.cache_folders import is_trusted, is_usable, tell_not_kept
from gazelle.compat.warn_once import is_first_time
from gazelle.user_folders import cache_folder

__all__ = ["compile_source", "is_python2", "translated"]

_DIVIDE = "_gazelle_python2_divide"
_OLD_NAMES = frozenset(
    {"raw_input", "xrange", "unicode", "basestring", "long", "unichr", "execfile", "reduce"}
)
_SAYS_3 = re.compile(rb"^#!.*python3")
_FUTURE_DIVISION = re.compile(r"^\s*from\s+__future__\s+import\s+.*\bdivision\b", re.MULTILINE)


def compile_source(source: bytes, file: str) -> CodeType:
    """Compile a module; a Python 2 one is translated first, and that is said once.

    Raises:
        SyntaxError: it is neither Python 3 nor Python 2; the error is the one of Python 3.
    """
    try:
        tree = ast.parse(source, file)
    except (SyntaxError, ValueError) as error:
        return _compile_python2(source, file, error)
    if _SAYS_3.match(source) or not _uses_old_names(tree):
        return compile(tree, file, "exec", dont_inherit=True)
    return _compile_python2(source, file, None)


def is_python2(source: bytes) -> bool:
    """Return whether a source needs translation: no Python 3 syntax, or Python 2's builtins."""
    try:
        return not _SAYS_3.match(source) and _uses_old_names(ast.parse(source))
    except (SyntaxError, ValueError):
        return True


def _translation(source: str) -> str:
    """Translate Python 2 source to Python 3.

    Raises:
        SyntaxError: it is not Python 2 either.
    """
    from fissix import refactor
    from fissix.pgen2.parse import ParseError
    from fissix.pgen2.tokenize import TokenError

    fixers = [
        name
        for name in refactor.get_fixers_from_package("fissix.fixes")
        if name.rsplit(".", 1)[-1] not in {"fix_idioms", "fix_buffer", "fix_ws_comma"}
    ]
    tool = refactor.RefactoringTool(fixers)
    try:
        return str(tool.refactor_string(source.rstrip() + "\n", "<python2>"))
    except (ParseError, TokenError) as error:
        raise SyntaxError(str(error)) from error


def _compile_python2(source: bytes, file: str, error: Exception | None) -> CodeType:
    text = _decoded(source)
    try:
        tree = ast.parse(translated(text), file)
    except (SyntaxError, ValueError):
        if error is not None:
            raise error from None
        raise
    _tell(file)
    if not _FUTURE_DIVISION.search(text):
        setattr(builtins, _DIVIDE, _divide)
        tree = ast.fix_missing_locations(_KeepDivision().visit(tree))
    return compile(tree, file, "exec", dont_inherit=True)


def _divide(left: Any, right: Any) -> Any:
    """Divide as Python 2 does: two integers give an integer."""
    if isinstance(left, int) and isinstance(right, int):
        return left // right
    return left / right


class _KeepDivision(ast.NodeTransformer):
    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        return self._call(node, node.left, node.right) if isinstance(node.op, ast.Div) else node

    def visit_AugAssign(self, node: ast.AugAssign) -> ast.AST:
        self.generic_visit(node)
        if not isinstance(node.op, ast.Div) or not isinstance(node.target, ast.Name):
            return node
        value = self._call(node, ast.Name(node.target.id, ast.Load()), node.value)
        return ast.copy_location(ast.Assign([node.target], value), node)

    def _call(self, node: ast.AST, left: ast.expr, right: ast.expr) -> ast.expr:
        call = ast.Call(ast.Name(_DIVIDE, ast.Load()), [left, right], [])
        return ast.copy_location(call, node)


def _uses_old_names(tree: ast.AST) -> bool:
    used: set[str] = set()
    defined: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            (used if isinstance(node.ctx, ast.Load) else defined).add(node.id)
        elif isinstance(node, ast.alias):
            defined.add((node.asname or node.name).split(".")[0])
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            defined.add(node.name)
        elif isinstance(node, ast.arg):
            defined.add(node.arg)
    return bool((used - defined) & _OLD_NAMES)


def translated(source: str) -> str:
    """Return Python 2 source as Python 3 source, line numbers kept where possible.

    It takes half a second, so it is kept for the next time.

    Raises:
        SyntaxError: it is not Python 2 either.
    """
    root = cache_folder() / "python2"
    key = hashlib.sha256(source.encode()).hexdigest()[:24]
    cached = root / f"{key}.py"
    if is_trusted(root) and cached.is_file():
        return cached.read_text(encoding="utf-8")
    result = _translation(source)
    # Where nothing can be kept it is done again.
    if is_usable(root):
        part = root / f"{key}.{os.getpid()}"
        try:
            part.write_text(result, encoding="utf-8")
            part.replace(cached)
        except OSError as error:
            tell_not_kept("translated sources", root, error)
            part.unlink(missing_ok=True)
    return result


def _decoded(source: bytes) -> str:
    from importlib.util import decode_source

    try:
        return decode_source(source)
    except (SyntaxError, UnicodeDecodeError):
        # Python 2 read sources without a coding line as bytes.
        return source.decode("latin-1")


def _tell(file: str) -> None:
    text = f"{file}: info: Python 2 source, translated on the fly; the file stays as it is "
    if is_first_time(text):
        sys.stderr.write(f"{text}[launch.python2]\n")
