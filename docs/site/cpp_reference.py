"""Reference of the installed C and C++ headers, by Doxygen: a page per folder or C header, a section per header.

    headers ──doxygen──► XML ──► declarations with their comments, in the order of the header ──► Markdown

Private members and bodies are left out.
"""

from __future__ import annotations

import hashlib
import re
import shutil
import subprocess
import textwrap
import xml.etree.ElementTree as ET
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

C_HEADERS = (
    "motionrack/c.h",
    "motionrack/flex2pos.h",
    "motionrack/frontends/mcx314lib/mcx314lib.h",
    "motionrack/frontends/databoard4002lib/databoard4002lib.h",
    "motionrack/frontends/rtc5sim/rtc5sim.h",
)
# Headers that cmake/install.cmake leaves out.
NOT_INSTALLED = re.compile(r"/(test|windows|frontends|report)/|/wire\.hpp$|/(hdf5|nats|dds|late)_library\.hpp$")
# Turns the plain comments of C, before a declaration or behind it in its line, into those of Doxygen.
C_FILTER = r"sed -E 's#([^ ] +)/\* #\1/**< #; s#^( *)/\* ([^-])#\1/** \2#'"
WIDTH = 100
MAX_VALUE = 60  # characters of an initial value; longer ones, such as tables, are left out


@dataclass
class Declaration:
    """One declaration of a header."""

    file: str
    line: int
    text: str  # without a comment
    comment: str
    members: list[Declaration] = field(default_factory=list)
    kind: str = ""  # class, struct, union or enum; empty for a declaration of one line


def installed_headers(source: Path) -> list[str]:
    found = [path.relative_to(source).as_posix() for path in (source / "motionrack").rglob("*.hpp")]
    return sorted(path for path in found if not NOT_INSTALLED.search(path)) + list(C_HEADERS)


def run_doxygen(source: Path, work: Path) -> Path:
    """Makes Doxygen's XML of the installed headers, if one has changed; returns its folder."""
    settings = {
        "INPUT": " ".join(installed_headers(source)),
        "OUTPUT_DIRECTORY": str(work),
        "STRIP_FROM_PATH": str(source),
        "FILTER_PATTERNS": f'*.h="{C_FILTER}"',
        "GENERATE_XML": "YES",
        "GENERATE_HTML": "NO",
        "GENERATE_LATEX": "NO",
        "XML_PROGRAMLISTING": "NO",
        "EXTRACT_ALL": "YES",
        "JAVADOC_AUTOBRIEF": "YES",
        "SHOW_INCLUDE_FILES": "NO",
        "HAVE_DOT": "NO",
        "MACRO_EXPANSION": "YES",
        "EXPAND_ONLY_PREDEF": "YES",
        "PREDEFINED": "MR_API= MCX314_API= RTC5_API=",
        "QUIET": "YES",
        "WARNINGS": "NO",
    }
    text = "".join(f"{key} = {value}\n" for key, value in settings.items())
    work.mkdir(parents=True, exist_ok=True)
    made_of = hashlib.sha256(text.encode())
    for header in installed_headers(source):
        made_of.update((source / header).read_bytes())
    stamp = work / "made-of"
    if stamp.is_file() and stamp.read_text() == made_of.hexdigest():
        return work / "xml"
    shutil.rmtree(work / "xml", ignore_errors=True)
    subprocess.run(["doxygen", "-"], input=text, text=True, cwd=source, check=True, stderr=subprocess.DEVNULL)
    stamp.write_text(made_of.hexdigest())
    return work / "xml"


def words(node: ET.Element | None) -> str:
    """Returns the text of a description, with empty lines between paragraphs."""
    if node is None:
        return ""
    parts = []
    for each in node.iter():
        if each.tag in ("para", "verbatim"):
            text = "".join(each.itertext())
            parts.append(text.strip("\n") if each.tag == "verbatim" else " ".join(text.split()))
    return "\n\n".join(part for part in parts if part)


def comment_of(node: ET.Element) -> str:
    both = [words(node.find("briefdescription")), words(node.find("detaileddescription"))]
    return "\n\n".join(part for part in both if part)


def tidy(text: str) -> str:
    """Returns C++ with the blanks of handwritten code: `Result<void>`, not `Result< void >`."""
    text = re.sub(r"< ", "<", text)
    text = re.sub(r" >", ">", text)
    text = re.sub(r" ?=(0|default)$", r" = \1", text)
    return re.sub(r" +([*&]+)", r"\1 ", text).replace("  ", " ").replace("( ", "(").replace("& )", "&)").strip()


def text_of(node: ET.Element | None) -> str:
    return "".join(node.itertext()).strip() if node is not None else ""


def place(node: ET.Element) -> tuple[str, int]:
    at = node.find("location")
    return ("", 0) if at is None else (at.get("file", ""), int(at.get("line", "0")))


def enumeration(node: ET.Element) -> Declaration:
    file, line = place(node)
    name = text_of(node.find("name"))
    name = "" if name.startswith("@") else name
    kind = "enum class" if node.get("strong") == "yes" else "enum"
    base = text_of(node.find("type"))
    head = " ".join(f"{kind} {name}{f' : {base}' if base else ''}".split())
    values = []
    for each in node.findall("enumvalue"):
        value = f"{text_of(each.find('name'))} {text_of(each.find('initializer'))}".strip()
        values.append(Declaration(file, line, f"{value},", comment_of(each)))
    return Declaration(file, line, head, comment_of(node), values, "enum")


def declaration(node: ET.Element, owner: str) -> Declaration:
    """Returns the declaration of a function, variable or type of an owner such as "motionrack::control::Move"."""
    if node.get("kind") == "enum":
        return enumeration(node)
    file, line = place(node)
    parameters = [
        text_of(each.find("type")) + " " + text_of(each.find("declname"))
        for each in node.findall("templateparamlist/param")
    ]
    template = f"template <{', '.join(each.strip() for each in parameters)}> " if parameters else ""
    text = text_of(node.find("definition")).replace(f"{owner}::", "") + text_of(node.find("argsstring"))
    if node.get("explicit") == "yes":
        text = f"explicit {text}"
    if node.get("kind") == "variable":
        value = text_of(node.find("initializer"))
        text += f" {value if len(value) < MAX_VALUE else '= ...'}"
    return Declaration(file, line, tidy(template + text) + ";", comment_of(node))


def is_deleted(node: ET.Element) -> bool:
    return re.search(r"= ?delete$", text_of(node.find("argsstring"))) is not None


class Reference:
    """All declarations of the headers, by header."""

    def __init__(self, xml: Path) -> None:
        self.headers: dict[str, list[Declaration]] = defaultdict(list)
        for path in sorted(xml.glob("*.xml")):
            if re.match(r"(class|struct|union|namespace).*|.*_8h\.xml", path.name):
                for node in ET.parse(path).getroot().findall("compounddef"):
                    self.take(node)

    def take(self, node: ET.Element) -> None:
        kind, owner = node.get("kind"), text_of(node.find("compoundname"))
        if "@" in owner:
            return  # unnamed
        if kind in ("class", "struct", "union") and node.get("prot", "public") == "public":
            found = self.structure(node, kind, owner)
            self.headers[found.file].append(found)
        elif kind in ("namespace", "file"):
            for each in node.findall("sectiondef/memberdef"):
                if each.get("kind") != "define":
                    one = declaration(each, owner if kind == "namespace" else "")
                    self.headers[one.file].append(one)

    @staticmethod
    def structure(node: ET.Element, kind: str, owner: str) -> Declaration:
        file, line = place(node)
        bases = ", ".join(
            f"public {text_of(each).split('::')[-1]}"
            for each in node.findall("basecompoundref")
            if each.get("prot") == "public"
        )
        short = re.sub(r"^(motionrack::)?([a-z0-9_]+::)*", "", owner)
        members = [
            declaration(each, owner)
            for each in node.findall("sectiondef/memberdef")
            if each.get("prot") == "public" and each.get("kind") != "friend" and not is_deleted(each)
        ]
        members.sort(key=lambda one: one.line)
        head = f"{kind} {short}" + (f" : {bases}" if bases else "")
        return Declaration(file, line, head, comment_of(node), members, kind)


def commented(one: Declaration, indent: str) -> list[str]:
    """Returns the lines of a one-line declaration, with its comment beside or above it."""
    body = textwrap.wrap(one.text, WIDTH, subsequent_indent="    ", break_long_words=False) or [""]
    lines = [indent + line for line in body]
    flat = " ".join(one.comment.split())
    if not flat:
        return lines
    if len(lines) == 1 and len(lines[0]) + len(flat) + 4 <= WIDTH and not one.text.endswith(");"):
        return [f"{lines[0]}  // {flat}"]
    above = []
    for paragraph in one.comment.split("\n\n"):
        above += textwrap.wrap(paragraph, WIDTH - len(indent) - 3) or [""]
    return [f"{indent}// {line}".rstrip() for line in above] + lines


def block(one: Declaration, indent: str = "") -> list[str]:
    """Returns the lines of a declaration as the header has it."""
    if not one.kind:
        return commented(one, indent)
    if indent:  # inside a class, where it has no section of its own
        lines = [f"{indent}// {line}" for line in textwrap.wrap(one.comment, WIDTH)]
    else:
        lines = []
    lines.append(f"{indent}{one.text} {{")
    for each in one.members:
        inner = block(each, indent + "    ")
        lines += [""] if len(inner) > 1 and lines[-1][-1:] != "{" else []
        lines += inner
    return [*lines, f"{indent}}};"]


def fence(lines: list[str], language: str) -> str:
    return f"```{language}\n" + "\n".join(lines) + "\n```\n\n"


def heading_comment(text: str) -> str:
    """Returns the comment at the beginning of a header as Markdown; drawings stay as they are."""
    found = re.match(r"((?://.*\n)+)", text)
    if found:
        lines = [line[3:] for line in found[1].split("\n")]
    else:
        found = re.match(r"/\*(.*?)\*/", text, re.DOTALL)
        lines = [re.sub(r"^ ?\*? ?", "", line) for line in found[1].split("\n")] if found else []
    out = []
    for part in re.split(r"\n\s*\n", "\n".join(lines).strip("\n")):
        drawn = re.search(r"^ |[─│►◄▲▼┌└├┴┬╌]|\S   +\S", part, re.MULTILINE)
        out.append(f"```text\n{textwrap.dedent(part)}\n```" if drawn else re.sub(r"([<*_])", r"\\\1", part))
    return "\n\n".join(out) + "\n\n"


def section(header: str, text: str, declared: list[Declaration]) -> str:
    """Returns the section of a header on its page."""
    out = f"## {Path(header).name}\n\n{heading_comment(text)}"
    language = "c" if header in C_HEADERS else "cpp"
    loose: list[str] = []
    for one in sorted(declared, key=lambda each: each.line):
        if not one.kind or one.text == "enum":
            loose += ([""] if loose and one.comment else []) + block(one)
            continue
        if loose:
            out, loose = out + fence(loose, language), []
        name = re.sub(r"^(class|struct|union|enum class|enum) | :.*", "", one.text)
        comment = re.sub(r"([<*_])", r"\\\1", one.comment)
        out += f"### {name}\n\n{comment}\n\n" + fence(block(one), language)
    return out + (fence(loose, language) if loose else "")


def anchor(header: str) -> str:
    return re.sub(r"[^\w-]", "", Path(header).name.lower())


def page_of(header: str) -> str:
    """Returns the page of a header: that of its folder, or its own for a C header."""
    if header in C_HEADERS:
        return f"reference/headers/{Path(header).name}.md"
    folder = Path(header).parent.as_posix().removeprefix("motionrack/")
    return f"reference/headers/{folder}.md"


def pages_of_headers(source: Path) -> dict[str, str]:
    """Returns the page and anchor of each header."""
    return {header: f"{page_of(header)}#{anchor(header)}" for header in installed_headers(source)}


def write_cpp_reference(source: Path, work: Path, target: Path) -> list[str]:
    """Writes the pages; returns their names in the site."""
    reference = Reference(run_doxygen(source, work))
    pages: dict[str, str] = {}
    for header in installed_headers(source):
        page = page_of(header)
        if page not in pages:
            title = f"C: {Path(header).name}" if header in C_HEADERS else Path(header).parent.as_posix()
            pages[page] = f"# {title}\n\n"
        pages[page] += section(header, (source / header).read_text(), reference.headers[header])
    order = sorted(pages, key=lambda name: (not name.endswith(".h.md"), name))
    for name in order:
        (target / name).parent.mkdir(parents=True, exist_ok=True)
        (target / name).write_text(pages[name])
    return order
