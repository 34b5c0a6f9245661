"""Reference of the Python package, from the docstrings and stubs of python/motionrack: a page per module."""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROLE = re.compile(r":\w+:`~?([^`]+)`")
PACKAGE = "python/motionrack"


def prose(text: str | None) -> str:
    """Returns a docstring as Markdown."""
    if not text:
        return ""
    text = ROLE.sub(r"`\1`", text).replace("``", "`")
    return re.sub(r"::(?=\n|$)", ":", text)


def signature(node: ast.FunctionDef, name: str) -> str:
    """Returns the signature without self: `run(program: str, *, faults: Sequence[str] = ()) -> Outcome`."""
    arguments = ast.unparse(node.args)
    arguments = re.sub(r"^(self|cls)(, |$)", "", arguments)
    result = f" -> {ast.unparse(node.returns)}" if node.returns and node.name != "__init__" else ""
    return f"{name}({arguments}){result}"


def decorators(node: ast.FunctionDef) -> set[str]:
    return {ast.unparse(each).split(".")[-1] for each in node.decorator_list}


def member(owner: str, node: ast.FunctionDef) -> str:
    """Returns the section of a method or property; "" for private ones, setters and overloads."""
    kinds = decorators(node)
    if "setter" in kinds or "overload" in kinds or (node.name.startswith("_") and node.name != "__init__"):
        return ""
    if node.name == "__init__":
        if not ast.get_docstring(node):
            return ""  # other calls make these objects
        return f"```python\n{signature(node, owner)}\n```\n\n{prose(ast.get_docstring(node))}\n\n"
    shown = signature(node, node.name)
    if "property" in kinds:
        shown = f"{node.name}: {ast.unparse(node.returns)}" if node.returns else node.name
    kind = "".join(f"@{each}\n" for each in sorted(kinds & {"classmethod", "staticmethod"}))
    text = prose(ast.get_docstring(node))
    return f"### {owner}.{node.name}\n\n```python\n{kind}{shown}\n```\n\n{text}\n\n"


def fields(node: ast.ClassDef, lines: list[str]) -> str:
    """Returns the annotated members of a class as in its source, with the comments beside them."""
    found = [
        lines[each.lineno - 1].strip()
        for each in node.body
        if isinstance(each, ast.AnnAssign) and isinstance(each.target, ast.Name) and each.target.id[:1] != "_"
    ]
    return "```python\n" + "\n".join(found) + "\n```\n\n" if found else ""


def thing(node: ast.stmt, lines: list[str]) -> str:
    """Returns the section of a class or function of the package; `lines`: the source of its module."""
    if isinstance(node, ast.FunctionDef):
        return f"## {node.name}\n\n```python\n{signature(node, node.name)}\n```\n\n{prose(ast.get_docstring(node))}\n\n"
    if not isinstance(node, ast.ClassDef):
        return ""
    bases = ", ".join(ast.unparse(base) for base in node.bases)
    out = f"## {node.name}\n\n" + (f"A kind of `{bases}`.\n\n" if bases else "")
    out += prose(ast.get_docstring(node)) + "\n\n" + fields(node, lines)
    return out + "".join(member(node.name, each) for each in node.body if isinstance(each, ast.FunctionDef))


def public_names(tree: ast.Module) -> dict[str, list[str]]:
    """Returns the names that the package imports from each module; "" is the package itself."""
    out: dict[str, list[str]] = {"": []}
    for node in tree.body:
        if isinstance(node, ast.ImportFrom) and node.module and node.level == 1 and node.module != "_version":
            out.setdefault(node.module, []).extend(each.name for each in node.names)
        elif isinstance(node, ast.FunctionDef):
            out[""].append(node.name)
    return out


def write_python_reference(source: Path, target: Path) -> list[str]:
    """Writes the pages into target/reference/python; returns their names in the site."""
    folder = source / PACKAGE
    package = ast.parse((folder / "__init__.py").read_text())
    names = public_names(package)
    rows, written = [], []
    for module, wanted in sorted(names.items()):
        if not module or not wanted:
            continue
        file = folder / ("_core.pyi" if module == "_core" else f"{module}.py")
        lines = file.read_text().split("\n")
        tree = ast.parse(file.read_text())
        nodes = {each.name: each for each in tree.body if isinstance(each, (ast.ClassDef, ast.FunctionDef))}
        title = "drivers" if module == "_core" else module
        intro = "" if module == "_core" else prose(ast.get_docstring(tree))
        body = "".join(thing(nodes[name], lines) for name in wanted if name in nodes)
        page = f"reference/python/{title}.md"
        (target / page).parent.mkdir(parents=True, exist_ok=True)
        (target / page).write_text(f"# Python: {title}\n\n{intro}\n\nAll names are those of `motionrack`.\n\n{body}")
        links = ", ".join(f"[`{name}`]({title}.md#{name.lower()})" for name in wanted if name in nodes)
        rows.append(f"| [{title}]({title}.md) | {links} |")
        written.append(page)
    own = "".join(thing(each, []) for each in package.body if isinstance(each, ast.FunctionDef))
    text = f"# The Python package\n\n{prose(ast.get_docstring(package))}\n\n| page | names |\n|---|---|\n"
    (target / "reference/python/index.md").write_text(text + "\n".join(rows) + "\n\n" + own)
    return ["reference/python/index.md", *written]
