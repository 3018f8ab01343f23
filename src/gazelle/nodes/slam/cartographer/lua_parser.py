"""Lua 5.2 as configuration files use it: from text to tokens to a tree."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple, TypeAlias

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import UserFileError

__all__ = [
    "KEYWORDS",
    "Assign",
    "Binary",
    "Block",
    "Call",
    "Constant",
    "Do",
    "Expression",
    "Field",
    "Function",
    "If",
    "Index",
    "Local",
    "Name",
    "Return",
    "Statement",
    "TableOf",
    "Token",
    "Unary",
    "failure",
    "parse",
    "tokens_of",
]


Kind = Literal["name", "keyword", "number", "string", "symbol", "end"]

KEYWORDS = frozenset(
    {
        *("and", "break", "do", "else", "elseif", "end", "false", "for", "function", "goto", "if"),
        *("in", "local", "nil", "not", "or", "repeat", "return", "then", "true", "until", "while"),
    }
)

_TOKEN = re.compile(
    r"""
    (?P<space>\s+)
  | (?P<comment>--(?:\[(?P<comment_level>=*)\[.*?\](?P=comment_level)\]|[^\n]*))
  | (?P<long>\[(?P<level>=*)\[.*?\](?P=level)\])
  | (?P<string>"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')
  | (?P<number>0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<symbol>\.\.\.|\.\.|==|~=|<=|>=|::|[-+*/%^\#<>=(){}\[\];:,.])
    """,
    re.VERBOSE | re.DOTALL | re.ASCII,
)

_ESCAPES = {"n": "\n", "t": "\t", "r": "\r", "a": "\a", "b": "\b", "f": "\f", "v": "\v"}


class Token(NamedTuple):
    """A word: its kind, its text (of a string its value), and its place."""

    kind: Kind
    text: str
    span: SourceSpan


def failure(text: str, span: SourceSpan | None, fix: str = "") -> UserFileError:
    """Return what refuses a file."""
    found = Diagnostics()
    found.report("mapping.lua", text, span, fix=fix)
    return UserFileError(tuple(found))


def tokens_of(text: str, file: str) -> Iterator[Token]:
    """Yield the words of a file, and ``end``.

    Raises:
        UserFileError: a character begins no word.
    """
    at, line, line_start = 0, 1, 0
    while at < len(text):
        found = _TOKEN.match(text, at)
        span = SourceSpan(file, line, at - line_start + 1, len(found[0]) if found else 1)
        if found is None:
            raise _unknown(text[at], span)
        kind, word = found.lastgroup, found[0]
        token = _token(kind or "", word, found, span)
        if token is not None:
            yield token
        at = found.end()
        breaks = word.count("\n")
        if breaks:
            line, line_start = line + breaks, at - len(word) + word.rindex("\n") + 1
    yield Token("end", "<eof>", SourceSpan(file, line, at - line_start + 1))


def _unknown(character: str, span: SourceSpan) -> UserFileError:
    if character in "\"'":
        return failure("unfinished string", span, f"close it with {character} in the same line")
    return failure(
        f"unexpected symbol near '{character}'", span, "take it away, or put it into a string"
    )


def _token(kind: str, word: str, found: re.Match[str], span: SourceSpan) -> Token | None:
    if found["string"] is not None:
        return Token("string", _unescaped(word[1:-1]), span)
    if found["long"] is not None:
        skip = len(found["level"]) + 2
        return Token("string", word[skip:-skip].removeprefix("\n"), span)
    if found["number"] is not None:
        return Token("number", word, span)
    if found["name"] is not None:
        return Token("keyword" if word in KEYWORDS else "name", word, span)
    return Token("symbol", word, span) if kind == "symbol" else None


def _unescaped(text: str) -> str:
    def value(found: re.Match[str]) -> str:
        word = found[1]
        if word.isdigit():
            return chr(int(word))
        return _ESCAPES.get(word, word)

    return re.sub(r"\\(\d{1,3}|.)", value, text, flags=re.DOTALL)


@dataclass(frozen=True, slots=True)
class Constant:
    """``nil``, ``true``, ``false``, a number or a string."""

    value: bool | float | str | None
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Name:
    """A variable."""

    name: str
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Index:
    """``owner.key`` or ``owner[key]``."""

    owner: Expression
    key: Expression
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Call:
    """``function(arguments)``; with `method`, ``owner:method(arguments)``."""

    function: Expression
    arguments: tuple[Expression, ...]
    method: str
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Unary:
    """``-x``, ``not x``, ``#x``."""

    operator: str
    value: Expression
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Binary:
    """``a operator b``."""

    operator: str
    left: Expression
    right: Expression
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Field:
    """A field of a table; without a key the next number."""

    key: Expression | None
    value: Expression


@dataclass(frozen=True, slots=True)
class TableOf:
    """``{…}``."""

    fields: tuple[Field, ...]
    span: SourceSpan


@dataclass(frozen=True, slots=True)
class Function:
    """``function (parameters) … end``."""

    parameters: tuple[str, ...]
    body: Block
    span: SourceSpan


Expression: TypeAlias = Constant | Name | Index | Call | Unary | Binary | TableOf | Function


@dataclass(frozen=True, slots=True)
class Assign:
    """``targets = values``."""

    targets: tuple[Name | Index, ...]
    values: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Local:
    """``local names = values``; a local function knows its own name."""

    names: tuple[str, ...]
    values: tuple[Expression, ...]
    knows_itself: bool = False


@dataclass(frozen=True, slots=True)
class If:
    """Conditions with their blocks, the last without a condition for ``else``."""

    branches: tuple[tuple[Expression | None, Block], ...]


@dataclass(frozen=True, slots=True)
class Do:
    """``do … end``."""

    body: Block


@dataclass(frozen=True, slots=True)
class Return:
    """``return values``."""

    values: tuple[Expression, ...]


Statement: TypeAlias = Assign | Local | If | Do | Return | Call

Block: TypeAlias = tuple[Statement, ...]

# How strongly operators bind to the left and to the right (Lua 5.2, 3.4.7).
_BINARY = {
    "or": (1, 1), "and": (2, 2), "<": (3, 3), ">": (3, 3), "<=": (3, 3), ">=": (3, 3),
    "~=": (3, 3), "==": (3, 3), "..": (5, 4), "+": (6, 6), "-": (6, 6), "*": (7, 7),
    "/": (7, 7), "%": (7, 7), "^": (10, 9),
}  # fmt: skip

_UNARY_STRENGTH = 8

_UNARY = frozenset({"not", "-", "#"})

_LOOPS = frozenset({"for", "while", "repeat", "goto", "break"})

_BLOCK_ENDS = frozenset({"end", "else", "elseif", "until", "return"})

_CONSTANTS = {"nil": None, "true": True, "false": False}

_MAX_DEPTH = 60


def parse(text: str, file: str) -> Block:
    """Return the statements of a file.

    Args:
        text: of the file.
        file: its name, for places.

    Raises:
        UserFileError: it is no Lua, or has loops.
    """
    reader = _Reader(tuple(tokens_of(text, file)))
    block = reader.block()
    reader.expect("<eof>")
    return block


class _Reader:
    def __init__(self, tokens: tuple[Token, ...]) -> None:
        self._tokens = tokens
        self._at = 0
        self._depth = 0

    @property
    def _next(self) -> Token:
        return self._tokens[self._at]

    def _take(self) -> Token:
        token = self._next
        self._at = min(self._at + 1, len(self._tokens) - 1)
        return token

    def _is(self, *texts: str) -> bool:
        token = self._next
        return token.text in texts and token.kind in ("symbol", "keyword", "end")

    def _has(self, text: str) -> bool:
        found = self._is(text)
        if found:
            self._take()
        return found

    def expect(self, text: str, opened: Token | None = None) -> Token:
        """Take a word that has to come."""
        token = self._next
        if not self._is(text):
            since = f" (to close '{opened.text}' at line {opened.span.line})" if opened else ""
            raise failure(
                f"'{text}' expected{since} near '{token.text}'", token.span, f"write {text}"
            )
        return self._take()

    def _name(self) -> Token:
        token = self._next
        if token.kind != "name":
            raise failure(f"<name> expected near '{token.text}'", token.span, "write a name")
        return self._take()

    def block(self) -> Block:
        """Read statements up to the end of the block."""
        statements: list[Statement] = []
        while self._next.kind != "end" and not self._is(*_BLOCK_ENDS):
            if not self._has(";"):
                statements.append(self._statement())
        if self._has("return"):
            is_bare = self._next.kind == "end" or self._is(*_BLOCK_ENDS, ";")
            statements.append(Return(() if is_bare else self._expressions()))
            self._has(";")
        return tuple(statements)

    def _statement(self) -> Statement:
        token = self._next
        if token.kind == "keyword" and token.text in _LOOPS:
            raise failure(f"'{token.text}' is not understood in a configuration", token.span,
                 "write the assignments one by one")  # fmt: skip
        if self._has("do"):
            body = self.block()
            self.expect("end", token)
            return Do(body)
        if self._has("if"):
            return self._if(token)
        if self._has("local"):
            return self._local()
        if self._has("function"):
            return self._named_function(token)
        return self._assignment_or_call()

    def _if(self, opened: Token) -> If:
        branches: list[tuple[Expression | None, Block]] = []
        condition: Expression | None = self._expression()
        self.expect("then")
        while True:
            branches.append((condition, self.block()))
            if self._has("elseif"):
                condition = self._expression()
                self.expect("then")
            elif condition is not None and self._has("else"):
                condition = None
            else:
                self.expect("end", opened)
                return If(tuple(branches))

    def _local(self) -> Local:
        opened = self._next
        if self._has("function"):
            name = self._name()
            return Local((name.text,), (self._function(opened),), knows_itself=True)
        names = [self._name().text]
        while self._has(","):
            names.append(self._name().text)
        return Local(tuple(names), self._expressions() if self._has("=") else ())

    def _named_function(self, opened: Token) -> Assign:
        name = self._name()
        target: Name | Index = Name(name.text, name.span)
        while self._has("."):
            name = self._name()
            target = Index(target, Constant(name.text, name.span), name.span)
        return Assign((target,), (self._function(opened),))

    def _assignment_or_call(self) -> Statement:
        first = self._next
        targets = [self._suffixed()]
        while self._has(","):
            targets.append(self._suffixed())
        if len(targets) == 1 and isinstance(targets[0], Call):
            return targets[0]
        named = tuple(one for one in targets if isinstance(one, Name | Index))
        if len(named) != len(targets) or not self._is("="):
            token = first if len(named) != len(targets) else self._next
            raise failure(f"syntax error near '{token.text}'", token.span,
                 "write NAME = VALUE, or a call; comments begin with --")  # fmt: skip
        self._take()
        return Assign(named, self._expressions())

    def _expressions(self) -> tuple[Expression, ...]:
        values = [self._expression()]
        while self._has(","):
            values.append(self._expression())
        return tuple(values)

    def _expression(self, strength: int = 0) -> Expression:
        self._depth += 1
        if self._depth > _MAX_DEPTH:
            raise failure(
                "an expression is nested too deeply", self._next.span, "write it in parts"
            )
        token = self._next
        left: Expression
        if token.kind in ("symbol", "keyword") and token.text in _UNARY:
            self._take()
            left = Unary(token.text, self._expression(_UNARY_STRENGTH), token.span)
        else:
            left = self._simple()
        while self._next.kind in ("symbol", "keyword") and self._next.text in _BINARY:
            to_left, to_right = _BINARY[self._next.text]
            if to_left <= strength:
                break
            operator = self._take()
            left = Binary(operator.text, left, self._expression(to_right), operator.span)
        self._depth -= 1
        return left

    def _simple(self) -> Expression:
        token = self._next
        if token.kind == "number":
            number = float(int(token.text, 16) if token.text[:2] in ("0x", "0X") else token.text)
            return Constant(number, self._take().span)
        if token.kind == "string":
            return Constant(token.text, self._take().span)
        if token.kind == "keyword" and token.text in _CONSTANTS:
            return Constant(_CONSTANTS[token.text], self._take().span)
        if self._is("{"):
            return self._table()
        if self._has("function"):
            return self._function(token)
        return self._suffixed()

    def _suffixed(self) -> Expression:
        token = self._next
        value: Expression
        if self._has("("):
            value = self._expression()
            self.expect(")", token)
        elif token.kind == "name":
            value = Name(self._take().text, token.span)
        else:
            raise failure(f"unexpected symbol near '{token.text}'", token.span, "write a value")
        while True:
            token = self._next
            if self._has("."):
                name = self._name()
                value = Index(value, Constant(name.text, name.span), name.span)
            elif self._has("["):
                value = Index(value, self._expression(), token.span)
                self.expect("]", token)
            elif self._has(":"):
                method = self._name()
                value = Call(value, self._arguments(), method.text, method.span)
            elif self._is("(", "{") or token.kind == "string":
                value = Call(value, self._arguments(), "", token.span)
            else:
                return value

    def _arguments(self) -> tuple[Expression, ...]:
        token = self._next
        if token.kind == "string":
            return (Constant(token.text, self._take().span),)
        if self._is("{"):
            return (self._table(),)
        self.expect("(")
        values = () if self._is(")") else self._expressions()
        self.expect(")", token)
        return values

    def _table(self) -> TableOf:
        opened = self.expect("{")
        fields: list[Field] = []
        while not self._is("}"):
            fields.append(self._field())
            if not (self._has(",") or self._has(";")):
                break
        self.expect("}", opened)
        return TableOf(tuple(fields), opened.span)

    def _field(self) -> Field:
        token = self._next
        if self._has("["):
            key = self._expression()
            self.expect("]", token)
            self.expect("=")
            return Field(key, self._expression())
        after = self._tokens[min(self._at + 1, len(self._tokens) - 1)]
        if token.kind == "name" and after.kind == "symbol" and after.text == "=":
            self._at += 2
            return Field(Constant(token.text, token.span), self._expression())
        return Field(None, self._expression())

    def _function(self, opened: Token) -> Function:
        self.expect("(")
        names: list[str] = []
        while not self._is(")"):
            names.append(self._name().text)
            if not self._has(","):
                break
        self.expect(")")
        body = self.block()
        self.expect("end", opened)
        return Function(tuple(names), body, opened.span)
