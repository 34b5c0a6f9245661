"""Builds the documentation as a site of static files: build_site.py SOURCE WORK SITE

    docs/, READMEs, headers, Python package ──► WORK/pages/*.md ──mkdocs──► WORK/html ──checked──► SITE

Pages load all their files from the site and have no inline scripts or styles, as the strictest content security policy
requires. Needs the Debian packages mkdocs-material and doxygen, and no network. SITE is replaced only by a site
without problems (site_check.py).
"""

from __future__ import annotations

import hashlib
import importlib.util
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

from cpp_reference import pages_of_headers, write_cpp_reference
from python_reference import write_python_reference
from site_check import problems_of
from site_nav import navigation
from site_pages import Pages
from site_search import mended_search

HERE = Path(__file__).resolve().parent
NOT_SERVED = ("404.html", "sitemap.xml", "sitemap.xml.gz", "assets/javascripts/lunr")
INLINE = re.compile(r"<script>(.*?)</script>", re.DOTALL)
KEPT = re.compile(r"(<pre.*?</pre>)", re.DOTALL)
IMAGE = re.compile(r"""url\((["']?)data:image/svg\+xml;charset=utf-8,(.*?)\1\)""")
TEASER = 600  # characters of a text that the search can show
NO_TOOLS = 77  # exit code of a skipped test


def need_tools() -> None:
    missing = [
        package
        for package, there in (
            (
                "mkdocs-material",
                importlib.util.find_spec("mkdocs") and Path("/usr/share/mkdocs/themes/material").is_dir(),
            ),
            ("doxygen", shutil.which("doxygen")),
        )
        if not there
    ]
    if missing:
        print(f"The site was not built: {' and '.join(missing)} not found. Run: apt-get install {' '.join(missing)}")
        sys.exit(NO_TOOLS)


def write_pages(source: Path, work: Path) -> list[object]:
    """Writes all pages as Markdown; returns the navigation."""
    target = work / "pages"
    shutil.rmtree(target, ignore_errors=True)
    pages = Pages(source, pages_of_headers(source))
    pages.write(target)
    nav = navigation(
        pages, write_cpp_reference(source, work / "doxygen", target), write_python_reference(source, target)
    )
    (target / "assets").mkdir()
    shutil.copy(HERE / "site.css", target / "assets")
    shutil.copy(source / "hmi/src/icon.svg", target / "assets")
    return nav


def run_mkdocs(work: Path, nav: list[object]) -> Path:
    html = work / "html"
    settings = {"INHERIT": str(HERE / "mkdocs.yml"), "docs_dir": str(work / "pages"), "site_dir": str(html), "nav": nav}
    (work / "mkdocs.yml").write_text(json.dumps(settings, indent=1))
    ran = subprocess.run(
        [sys.executable, "-m", "mkdocs", "build", "--quiet", "--strict", "--config-file", str(work / "mkdocs.yml")],
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if ran.returncode != 0:
        sys.exit(f"{ran.stdout}\nThe site was not built: mkdocs lists the mistakes above. Mend them in the pages.")
    return html


def named(folder: Path, text: str, ending: str) -> Path:
    """Writes a file with this text, named by its hash; returns its path."""
    path = folder / f"{hashlib.sha256(text.encode()).hexdigest()[:12]}{ending}"
    folder.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def without_blanks(text: str) -> str:
    """Returns a page without the empty lines and the indents of its templates, which are most of it."""
    parts = KEPT.split(text)
    parts[::2] = [re.sub(r"[ \t]*\n\s*", "\n", part) for part in parts[::2]]
    return "".join(parts)


def move_scripts_out(html: Path) -> None:
    """Moves inline scripts of pages into files, and removes blanks from the pages."""
    folder = html / "assets/javascripts"
    for page in html.rglob("*.html"):
        up = "../" * (len(page.relative_to(html).parts) - 1)

        def moved(found: re.Match[str], up: str = up) -> str:
            return f'<script src="{up}assets/javascripts/{named(folder, found[1], ".js").name}"></script>'

        page.write_text(without_blanks(INLINE.sub(moved, page.read_text())))


def move_images_out(html: Path) -> None:
    """Moves images in style sheets into files, and removes references to source maps."""
    for sheet in (html / "assets/stylesheets").glob("*.css"):

        def moved(found: re.Match[str]) -> str:
            text = re.sub(r"%([0-9A-Fa-f]{2})", lambda byte: chr(int(byte[1], 16)), found[2])
            return f"url(../images/{named(html / 'assets/images', text, '.svg').name})"

        text = IMAGE.sub(moved, sheet.read_text())
        sheet.write_text(re.sub(r"/\*# sourceMappingURL=.*?\*/", "", text))


def words_once(text: str) -> str:
    """Returns the beginning of a text, then each further word once."""
    end = text.rfind(" ", 0, TEASER) if len(text) > TEASER else len(text)
    seen = set(text[:end].split())
    return " ".join([text[:end], *dict.fromkeys(word for word in text[end:].split() if word not in seen)])


def shorten_search(html: Path) -> None:
    """Shortens the index, so that it loads quickly. A page gets the words of its sections: they are shown below it."""
    path = html / "search/search_index.json"
    index = json.loads(path.read_text())
    texts: dict[str, list[str]] = {}
    for entry in index["docs"]:
        entry["text"] = words_once(entry["text"])
        page, _, section = entry["location"].partition("#")
        if section:
            texts.setdefault(page, []).append(f"{entry['title']} {entry['text']}")
    for entry in index["docs"]:
        if entry["location"] in texts:
            entry["text"] = words_once(" ".join(texts[entry["location"]]))
    path.write_text(json.dumps(index, ensure_ascii=False, separators=(",", ":")))


def mend_search(html: Path) -> None:
    """Corrects the search of the theme, see site_search.py."""
    scripts = list((html / "assets/javascripts/workers").glob("search.*.js"))
    if not scripts:
        sys.exit("The site was not built: the theme has no script of its search in assets/javascripts/workers.")
    for script in scripts:
        script.write_text(mended_search(script.read_text()))


def finish(html: Path) -> None:
    for name in NOT_SERVED:
        path = html / name
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)
    for path in html.rglob("*.map"):
        path.unlink()
    for script in html.rglob("*.min.js"):
        script.write_text(re.sub(r"\n?//# sourceMappingURL=.*\n?$", "\n", script.read_text()))
    move_scripts_out(html)
    move_images_out(html)
    shorten_search(html)
    mend_search(html)


def main() -> None:
    source, work, site = (Path(each).resolve() for each in sys.argv[1:4])
    need_tools()
    html = run_mkdocs(work, write_pages(source, work))
    finish(html)
    problems = problems_of(html)
    if problems:
        sys.exit("\n".join(problems) + f"\nThe site was not built: {len(problems)} problems, see above.")
    shutil.rmtree(site, ignore_errors=True)
    site.parent.mkdir(parents=True, exist_ok=True)
    shutil.copytree(html, site)
    print(f"{len(list(site.rglob('*.html')))} pages in {site}")


if __name__ == "__main__":
    main()
