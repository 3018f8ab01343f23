"""From words to the tree of a Lua file."""

from __future__ import annotations

from gazelle.nodes.slam.cartographer.lua_syntax import (
    Assign,
    Binary,
    Block,
    Call,
    Constant,
    Do,
    Expression,
    Field,
    Function,
    If,
    Index,
    Local,
    Name,
    Return,
    Statement,
    TableOf,
    Unary,
)
from gazelle.nodes.slam.cartographer.lua_tokens import Token, failure, tokens_of

__all__ = ["parse"]

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
            since = f" (to close '{opened.text}' at line {opened.place.line})" if opened else ""
            raise failure(
                f"'{text}' expected{since} near '{token.text}'", token.place, f"write {text}"
            )
        return self._take()

    def _name(self) -> Token:
        token = self._next
        if token.kind != "name":
            raise failure(f"<name> expected near '{token.text}'", token.place, "write a name")
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
            raise failure(f"'{token.text}' is not understood in a configuration", token.place,
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
        target: Name | Index = Name(name.text, name.place)
        while self._has("."):
            name = self._name()
            target = Index(target, Constant(name.text, name.place), name.place)
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
            raise failure(f"syntax error near '{token.text}'", token.place,
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
                "an expression is nested too deeply", self._next.place, "write it in parts"
            )
        token = self._next
        left: Expression
        if token.kind in ("symbol", "keyword") and token.text in _UNARY:
            self._take()
            left = Unary(token.text, self._expression(_UNARY_STRENGTH), token.place)
        else:
            left = self._simple()
        while self._next.kind in ("symbol", "keyword") and self._next.text in _BINARY:
            to_left, to_right = _BINARY[self._next.text]
            if to_left <= strength:
                break
            operator = self._take()
            left = Binary(operator.text, left, self._expression(to_right), operator.place)
        self._depth -= 1
        return left

    def _simple(self) -> Expression:
        token = self._next
        if token.kind == "number":
            number = float(int(token.text, 16) if token.text[:2] in ("0x", "0X") else token.text)
            return Constant(number, self._take().place)
        if token.kind == "string":
            return Constant(token.text, self._take().place)
        if token.kind == "keyword" and token.text in _CONSTANTS:
            return Constant(_CONSTANTS[token.text], self._take().place)
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
            value = Name(self._take().text, token.place)
        else:
            raise failure(f"unexpected symbol near '{token.text}'", token.place, "write a value")
        while True:
            token = self._next
            if self._has("."):
                name = self._name()
                value = Index(value, Constant(name.text, name.place), name.place)
            elif self._has("["):
                value = Index(value, self._expression(), token.place)
                self.expect("]", token)
            elif self._has(":"):
                method = self._name()
                value = Call(value, self._arguments(), method.text, method.place)
            elif self._is("(", "{") or token.kind == "string":
                value = Call(value, self._arguments(), "", token.place)
            else:
                return value

    def _arguments(self) -> tuple[Expression, ...]:
        token = self._next
        if token.kind == "string":
            return (Constant(token.text, self._take().place),)
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
        return TableOf(tuple(fields), opened.place)

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
            return Field(Constant(token.text, token.place), self._expression())
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
        return Function(tuple(names), body, opened.place)
