"""Generator of sources that contain all small mistakes a test should detect, each behind its number (mutant.hpp)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from clang.cindex import Cursor, CursorKind, Index, TokenKind, TypeKind

COMPARED = {"<": "less", "<=": "less_equal", ">": "greater", ">=": "greater_equal"}
COUNTED = {"+": "plus", "-": "minus"}
STATEMENTS = {
    CursorKind.CALL_EXPR,
    CursorKind.BINARY_OPERATOR,
    CursorKind.COMPOUND_ASSIGNMENT_OPERATOR,
    CursorKind.UNARY_OPERATOR,
    CursorKind.BREAK_STMT,
    CursorKind.CONTINUE_STMT,
}
CONDITIONS_OF = {
    CursorKind.IF_STMT,
    CursorKind.WHILE_STMT,
    CursorKind.DO_STMT,
    CursorKind.FOR_STMT,
    CursorKind.CONDITIONAL_OPERATOR,
}
FUNCTIONS = {
    CursorKind.FUNCTION_DECL,
    CursorKind.CXX_METHOD,
    CursorKind.CONSTRUCTOR,
    CursorKind.DESTRUCTOR,
    CursorKind.CONVERSION_FUNCTION,
    CursorKind.LAMBDA_EXPR,
}
# Macros whose calls are statements.
MACROS = (b"MOTIONRACK_CHECK(",)


@dataclass
class Edit:
    """Replacement of `length` bytes at an offset of the file by a text."""

    at: int
    length: int
    text: str
    depth: float  # order of edits at one offset, ascending


@dataclass
class Mutant:
    number: int
    file: Path
    line: int
    column: int
    what: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.what}"


@dataclass
class Mutation:
    """One file of a module: its edits and its mutants."""

    file: Path
    text: bytes
    first: int
    edits: list[Edit] = field(default_factory=list)
    mutants: list[Mutant] = field(default_factory=list)
    negated: set[tuple[int, int]] = field(default_factory=set)
    left_out: set[int] = field(default_factory=set)  # offsets of statements that have a mutant without them

    def mutant(self, cursor: Cursor, what: str) -> int:
        number = self.first + len(self.mutants)
        start = cursor.extent.start
        self.mutants.append(Mutant(number, self.file, start.line, start.column, what))
        return number

    def written(self, cursor: Cursor) -> bytes:
        return self.text[cursor.extent.start.offset : cursor.extent.end.offset]

    def shown(self, cursor: Cursor) -> str:
        shown = " ".join(self.written(cursor).decode().split())
        return shown if len(shown) <= 60 else shown[:57] + "..."

    def wrap(self, cursor: Cursor, before: str, after: str, depth: float) -> None:
        self.edits.append(Edit(cursor.extent.start.offset, 0, before, depth))
        self.edits.append(Edit(cursor.extent.end.offset, 0, after, -depth))

    def negate(self, cursor: Cursor, depth: int) -> None:
        span = (cursor.extent.start.offset, cursor.extent.end.offset)
        if span in self.negated or not self.is_here(cursor) or not self.is_plain(cursor):
            return
        self.negated.add(span)
        number = self.mutant(cursor, f"not ({self.shown(cursor)})")
        self.wrap(cursor, f"(mutant::on({number}) != static_cast<bool>(", "))", depth)

    def is_here(self, cursor: Cursor) -> bool:
        start, end = cursor.extent.start, cursor.extent.end
        return bool(start.file) and Path(start.file.name) == self.file and start.offset < end.offset

    def is_plain(self, cursor: Cursor) -> bool:
        """Returns whether the code is written here, not by a macro: its tokens begin and end where its extent does."""
        tokens = list(cursor.get_tokens())
        if not tokens:
            return False
        first, last = tokens[0].extent.start.offset, tokens[-1].extent.end.offset
        return first == cursor.extent.start.offset and last == cursor.extent.end.offset

    def operator(self, cursor: Cursor, left: Cursor, right: Cursor) -> tuple[str, int] | None:
        """Returns the operator between two operands and its offset; None if there is none."""
        for token in cursor.get_tokens():
            inside = left.extent.end.offset <= token.extent.start.offset < right.extent.start.offset
            if inside and token.kind == TokenKind.PUNCTUATION and token.spelling not in "()":
                return token.spelling, token.extent.start.offset
        return None

    def continues(self, cursor: Cursor, operator: str) -> bool:
        """Returns whether the operand is a chain of the same operator, as `a && b` in `a && b && c`."""
        while cursor.kind == CursorKind.UNEXPOSED_EXPR and len(list(cursor.get_children())) == 1:
            cursor = next(cursor.get_children())
        children = list(cursor.get_children())
        if cursor.kind != CursorKind.BINARY_OPERATOR or len(children) != 2:
            return False
        found = self.operator(cursor, *children)
        return found is not None and found[0] == operator

    # ---- the mistakes

    def walk(self, cursor: Cursor, parent: Cursor | None = None, depth: int = 0, inside: bool = False) -> None:
        if cursor.kind in FUNCTIONS:
            if "constexpr" in head_of(cursor) or "consteval" in head_of(cursor):
                return
            inside = True
        if is_constant(cursor) or cursor.kind == CursorKind.STATIC_ASSERT:
            return
        if inside and self.is_here(cursor):
            self.conditions(cursor, depth)
            self.operators(cursor, depth)
            self.statement(cursor, parent, depth)
        for child in cursor.get_children():
            self.walk(child, cursor, depth + 1, inside)

    def conditions(self, cursor: Cursor, depth: int) -> None:
        children = list(cursor.get_children())
        if cursor.kind in CONDITIONS_OF:
            for child in condition_of(cursor, children):
                self.negate(child, depth + 1)
        if cursor.kind == CursorKind.RETURN_STMT and children and is_truth(children[0]):
            self.negate(children[0], depth + 1)
        if cursor.kind == CursorKind.BINARY_OPERATOR and len(children) == 2:
            found = self.operator(cursor, *children)
            if found and found[0] in ("&&", "||"):
                for child in children:
                    if not self.continues(child, found[0]):
                        self.negate(child, depth + 1)
            if found and (found[0] in ("==", "!=") or found[0] in COMPARED) and is_truth(cursor):
                self.negate(cursor, depth)
            if found and found[0] == "=" and is_truth(children[1]):
                self.negate(children[1], depth + 1)

    def operators(self, cursor: Cursor, depth: int) -> None:
        children = list(cursor.get_children())
        if cursor.kind != CursorKind.BINARY_OPERATOR or len(children) != 2 or not self.is_plain(cursor):
            return
        found = self.operator(cursor, *children)
        if not found or not all(is_number(child) for child in children):
            return
        name = COMPARED.get(found[0]) or COUNTED.get(found[0])
        if not name:
            return
        number = self.mutant(cursor, f"{name} in {self.shown(cursor)}")
        self.wrap(cursor, f"mutant::{name}({number}, ", ")", depth + 0.5)
        self.edits.append(Edit(found[1], len(found[0]), ",", 0))

    def statement(self, cursor: Cursor, parent: Cursor | None, depth: int) -> None:
        start, stop = cursor.extent.start.offset, cursor.extent.end.offset
        macro = self.text[start:].startswith(MACROS)
        if parent is None or not is_statement_of(cursor, parent) or not (macro or self.can_be_left_out(cursor)):
            return
        end = self.text.find(b";", stop - 1 if macro else stop)
        if end < 0 or (not macro and self.text[stop:end].strip()) or start in self.left_out:
            return
        self.left_out.add(start)
        number = self.mutant(cursor, f"without {self.shown(cursor)}")
        self.edits.append(Edit(start, 0, f"{{ if (!mutant::on({number})) ", depth - 0.5))
        self.edits.append(Edit(end + 1, 0, " }", -depth))

    def can_be_left_out(self, cursor: Cursor) -> bool:
        returns_nothing = cursor.kind == CursorKind.RETURN_STMT and not list(cursor.get_children())
        known = cursor.kind in STATEMENTS and not self.sets_truth(cursor)
        return (known or returns_nothing) and self.is_plain(cursor)

    def sets_truth(self, cursor: Cursor) -> bool:
        """Returns whether it assigns a literal, as in `known = true`: the negated value is a mutant already."""
        children = list(cursor.get_children())
        return cursor.kind == CursorKind.BINARY_OPERATOR and children[1].kind == CursorKind.CXX_BOOL_LITERAL_EXPR

    def text_with_mutants(self, header: Path) -> bytes:
        out, at = bytearray(f'#include "{header}"\n#line 1\n'.encode()), 0
        # At one offset, ends come before beginnings; the outer beginning and the inner end come first.
        for edit in sorted(self.edits, key=lambda one: (one.at, one.length == 0 and not is_end(one), one.depth)):
            out += self.text[at : edit.at] + edit.text.encode()
            at = edit.at + edit.length
        return bytes(out + self.text[at:])


def is_end(edit: Edit) -> bool:
    return edit.text.startswith((")", " }"))


def head_of(function: Cursor) -> str:
    """Returns the tokens of a function before its body, separated by spaces."""
    words = []
    for token in function.get_tokens():
        if token.spelling == "{":
            break
        words.append(token.spelling)
    return " ".join(words)


def is_constant(cursor: Cursor) -> bool:
    if cursor.kind not in (CursorKind.VAR_DECL, CursorKind.FIELD_DECL):
        return False
    return any(token.spelling in ("constexpr", "constinit") for token in cursor.get_tokens())


def condition_of(cursor: Cursor, children: list[Cursor]) -> Iterator[Cursor]:
    """Yields the condition among the children of a statement, which libclang does not mark; all candidates of `for`."""
    if cursor.kind == CursorKind.DO_STMT:
        yield children[-1]
    elif cursor.kind in (CursorKind.WHILE_STMT, CursorKind.CONDITIONAL_OPERATOR):
        yield children[0]
    elif cursor.kind == CursorKind.IF_STMT:
        if all(child.kind != CursorKind.VAR_DECL for child in children):  # a declared condition cannot be wrapped
            yield next(child for child in children if child.kind.is_expression())
    elif cursor.kind == CursorKind.FOR_STMT:
        for child in children[:-1]:
            if is_truth(child):
                yield child


def is_truth(cursor: Cursor) -> bool:
    return cursor.kind.is_expression() and cursor.type.get_canonical().kind == TypeKind.BOOL


def is_number(cursor: Cursor) -> bool:
    kind = cursor.type.get_canonical().kind
    return TypeKind.CHAR_U.value <= kind.value <= TypeKind.LONGDOUBLE.value


def is_statement_of(cursor: Cursor, parent: Cursor) -> bool:
    """Returns whether the statement stands alone, so that its value is unused."""
    if parent.kind == CursorKind.COMPOUND_STMT:
        return True
    parts = list(parent.get_children())
    if parent.kind == CursorKind.IF_STMT:
        condition = next(condition_of(parent, parts), None)
        return condition is None or cursor.extent.start.offset > condition.extent.end.offset
    if parent.kind in (CursorKind.FOR_STMT, CursorKind.WHILE_STMT, CursorKind.CXX_FOR_RANGE_STMT):
        return bool(cursor == parts[-1])
    return False


def mutate(file: Path, source: Path, flags: list[str], first: int) -> Mutation:
    """Returns all mutants of `file`, parsed as when `source` is compiled; `first` is the number of the first mutant."""
    unit = Index.create().parse(str(source), flags)
    wrong = [str(one) for one in unit.diagnostics if one.severity >= 3]
    if wrong:
        raise SystemExit(f"{source} cannot be read: {wrong[0]}")
    mutation = Mutation(file, file.read_bytes(), first)
    for cursor in unit.cursor.get_children():
        if mutation.is_here(cursor):
            mutation.walk(cursor)
    return mutation
