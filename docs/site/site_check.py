"""Rules for every file of the site: site_check.py SITE [WORD PAGE]...

Links lead to a file and a heading of the site. A page loads nothing from another host and has no inline script or
style. The search has an index, and finds each WORD on its PAGE.
"""

from __future__ import annotations

import json
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADS = {
    ("script", "src"),
    ("img", "src"),
    ("link", "href"),
    ("source", "src"),
    ("iframe", "src"),
    ("object", "data"),
    ("audio", "src"),
    ("video", "src"),
    ("img", "srcset"),
    ("input", "src"),
}


class Page(HTMLParser):
    """Anchors, links, loaded files, and inline scripts and styles of a page."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.inline: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        values = {name: value or "" for name, value in attrs}
        self.anchors |= {values[name] for name in ("id", "name") if name in values}
        if tag == "a" and "href" in values:
            self.links.append(values["href"])
        self.loaded += [value for name, value in values.items() if (tag, name) in LOADS]
        runs = tag == "script" and "src" not in values and values.get("type") != "application/json"
        handlers = [name for name in values if name == "style" or name.startswith("on")]
        if runs or tag == "style" or handlers:
            self.inline.append(f"<{tag}> with {', '.join(handlers) or 'its text in the page'}")


def is_foreign(address: str) -> bool:
    return bool(re.match(r"(?!data:)[a-z][a-z0-9+.-]*:|//", address, re.IGNORECASE))


def link_problem(site: Path, page: Path, link: str, pages: dict[Path, Page]) -> str:
    parts = urlsplit(link)
    target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
    if not target.is_relative_to(site) or not target.is_file():
        return f"links to {link}, which is not in the site"
    if parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
        return f"links to {link}, a heading that does not exist"
    return ""


def page_problems(site: Path, path: Path, pages: dict[Path, Page]) -> list[str]:
    page = pages[path]
    found = [f"loads {each} from elsewhere" for each in page.loaded if is_foreign(each)]
    found += [f"has {each}" for each in page.inline]
    inner = [each for each in page.links if not is_foreign(each)]
    inner += [each for each in page.loaded if not is_foreign(each)]
    found += [problem for each in dict.fromkeys(inner) if (problem := link_problem(site, path, each, pages))]
    return [f"{path.relative_to(site)} {each}" for each in found]


def sheet_problems(site: Path, sheet: Path) -> list[str]:
    text = sheet.read_text()
    loaded = [each[1] for each in re.findall(r"url\((['\"]?)(.*?)\1\)", text)]
    loaded += [each[1] for each in re.findall(r"@import\s+(['\"])(.*?)\1", text)]
    wrong = [each for each in loaded if is_foreign(each) or each.startswith("data:")]
    wrong += [each for each in loaded if each not in wrong and not (sheet.parent / each).is_file()]
    return [f"{sheet.relative_to(site)} loads {each}, which is not a file of the site" for each in wrong]


def search_problems(site: Path, wanted: list[tuple[str, str]]) -> list[str]:
    index = site / "search/search_index.json"
    if not index.is_file():
        return ["The search has no index, search/search_index.json"]
    entries = json.loads(index.read_text())["docs"]
    out = []
    for word, page in wanted:
        found = {
            each["location"].split("#")[0]
            for each in entries
            if word.lower() in f"{each['title']} {each['text']}".lower()
        }
        if page not in found:
            out.append(f"The search does not find '{word}' on {page}; it finds it on {len(found)} pages")
    return out


def problems_of(site: Path, wanted: list[tuple[str, str]] | None = None) -> list[str]:
    site = site.resolve()
    pages = {path: Page(path.read_text()) for path in sorted(site.rglob("*.html"))}
    out = [] if site / "index.html" in pages else ["The site has no index.html"]
    for path in pages:
        out += page_problems(site, path, pages)
    for sheet in sorted(site.rglob("*.css")):
        out += sheet_problems(site, sheet)
    return out + search_problems(site, wanted or [])


def main() -> None:
    site, words = Path(sys.argv[1]), sys.argv[2:]
    problems = problems_of(site, list(zip(words[::2], words[1::2])))
    print("\n".join(problems))
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
