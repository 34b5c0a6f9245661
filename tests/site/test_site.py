"""Tests of the site's generator without mkdocs and doxygen: lists, links, navigation, reference, search, checks."""

from __future__ import annotations

import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/site"))

from markdown_dialect import to_python_markdown  # noqa: E402
from python_reference import write_python_reference  # noqa: E402
from site_check import problems_of  # noqa: E402
from site_nav import navigation  # noqa: E402
from site_pages import Pages  # noqa: E402
from site_search import mended_search  # noqa: E402

HEADERS = {"motionrack/sim/kernel.hpp": "reference/headers/sim.md#kernelhpp"}


def leaves(nav: object) -> list[str]:
    """Returns all pages of a navigation."""
    if isinstance(nav, dict):
        return [page for each in nav.values() for page in leaves(each)]
    if isinstance(nav, list):
        return [page for each in nav for page in leaves(each)]
    return [str(nav)]


class Dialect(unittest.TestCase):
    def test_a_list_begins_behind_an_empty_line_and_is_nested_by_four_blanks(self) -> None:
        text = "From the top:\n- one\n  goes on\n- two\n  - inner\n    goes on\n\nnext"
        wanted = "From the top:\n\n- one\n    goes on\n- two\n    - inner\n        goes on\n\nnext"
        self.assertEqual(to_python_markdown(text), wanted)

    def test_a_table_begins_behind_an_empty_line(self) -> None:
        self.assertEqual(to_python_markdown("words\n| a |\n|---|\n| b |"), "words\n\n| a |\n|---|\n| b |")

    def test_code_stays_as_it_is(self) -> None:
        text = "words\n\n```text\nx\n- y\n| z |\n```\n\n    code\n    - more"
        self.assertEqual(to_python_markdown(text), text)


class Links(unittest.TestCase):
    def setUp(self) -> None:
        self.pages = Pages(ROOT, HEADERS)

    def link(self, text: str) -> str:
        return self.pages.with_links("docs/howto/panel.md", "howto/panel.md", text)

    def test_a_page_outside_docs_is_in_the_site(self) -> None:
        self.assertEqual(self.link("[change it](../../CONTRIBUTING.md)"), "[change it](../contributing.md)")
        self.assertEqual(
            self.link("[rules](../../motionrack/cards/mcx314/RULES.md)"), "[rules](../motionrack/cards/mcx314/RULES.md)"
        )

    def test_the_name_of_a_page_becomes_its_title(self) -> None:
        title = self.pages.titles["docs/howto/homing.md"]
        self.assertEqual(self.link("[homing.md](homing.md)"), f"[{title}](homing.md)")

    def test_an_example_gets_a_page_and_a_source_stays_a_name(self) -> None:
        self.assertEqual(self.link("[line](../../examples/mcx314/line.cpp)"), "[line](../examples/mcx314/line.cpp.md)")
        self.assertEqual(
            self.link("[the test](../../tests/docs_test.cpp)"),
            '<span class="source" title="tests/docs_test.cpp">the test</span>',
        )

    def test_a_header_leads_to_its_section_of_the_reference(self) -> None:
        self.assertEqual(
            self.link("[kernel](../../motionrack/sim/kernel.hpp)"), "[kernel](../reference/headers/sim.md#kernelhpp)"
        )

    def test_code_and_other_hosts_are_left_alone(self) -> None:
        text = "```md\n[a](b.md)\n```\n[x](https://example.org/)"
        self.assertEqual(self.link(text), text)


class Navigation(unittest.TestCase):
    def test_every_page_is_in_it_once(self) -> None:
        pages = Pages(ROOT, HEADERS)
        nav = navigation(pages, [], [])
        self.assertEqual(sorted(leaves(nav)), sorted(pages.names.values()))

    def test_its_sections_are_those_of_the_index(self) -> None:
        index = (ROOT / "docs/README.md").read_text()
        wanted = dict.fromkeys(re.findall(r"^\*\*(.+?)\*\*", index, re.MULTILINE))
        names = [name for each in navigation(Pages(ROOT, HEADERS), [], []) if isinstance(each, dict) for name in each]
        self.assertLessEqual(set(wanted) - {"Start here"}, set(names))


class Reference(unittest.TestCase):
    def test_the_python_package_has_a_page_for_each_module_with_its_names(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            pages = write_python_reference(ROOT, Path(folder))
            text = (Path(folder) / "reference/python/rack.md").read_text()
        self.assertIn("reference/python/rack.md", pages)
        self.assertIn("## Rack", text)
        self.assertIn("### Rack.run", text)
        self.assertNotIn(":meth:", text)


class Search(unittest.TestCase):
    SCRIPT = (
        't.TokenSet.prototype.toString=function(){if(this._str)return this._str;for(var e=this.final?"1":"0",'
        "r=Object.keys(this.edges).sort(),n=r.length,i=0;i<n;i++){var s=r[i],o=this.edges[s];e=e+s+o.id}return e},"
        "t.TokenSet.prototype.intersect=function(e){}"
    )

    def test_the_numbers_of_nodes_end_with_a_comma(self) -> None:
        wanted = self.SCRIPT.replace("e=e+s+o.id}", 'e=e+s+o.id+","}')
        self.assertEqual(mended_search(self.SCRIPT), wanted)

    def test_a_script_of_another_theme_is_refused(self) -> None:
        for other in ("", self.SCRIPT + self.SCRIPT):
            self.assertRaises(ValueError, mended_search, other)


class Check(unittest.TestCase):
    def problems(self, body: str, css: str = "") -> list[str]:
        with tempfile.TemporaryDirectory() as folder:
            site = Path(folder)
            (site / "search").mkdir()
            (site / "search/search_index.json").write_text(
                '{"docs":[{"location":"a.html#b","title":"Look-ahead","text":""}]}'
            )
            (site / "index.html").write_text(f"<html><body id='top'>{body}</body></html>")
            (site / "site.css").write_text(css)
            return problems_of(site, [("look-ahead", "a.html")])

    def test_a_sound_site_has_no_problems(self) -> None:
        self.assertEqual(self.problems("<a href='#top'>up</a><a href='https://example.org/'>away</a>"), [])

    def test_it_finds_files_that_are_loaded_from_elsewhere(self) -> None:
        for body in (
            "<script src='https://cdn.example/x.js'></script>",
            "<img src='//cdn.example/x.png'>",
            "<link rel='preconnect' href='https://fonts.example'>",
        ):
            self.assertEqual(len(self.problems(body)), 1, body)
        self.assertEqual(len(self.problems("", "@font-face { src: url(https://fonts.example/a.woff2) }")), 1)

    def test_it_finds_scripts_and_styles_in_pages(self) -> None:
        for body in ("<script>go()</script>", "<style>p {}</style>", "<p style='color: red'>", "<p onclick='go()'>"):
            self.assertEqual(len(self.problems(body)), 1, body)

    def test_it_finds_broken_links(self) -> None:
        for body in ("<a href='gone.html'>", "<a href='#gone'>", "<a href='../outside.html'>"):
            self.assertEqual(len(self.problems(body)), 1, body)


if __name__ == "__main__":
    unittest.main()
