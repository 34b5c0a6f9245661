"""Mends the search of the theme, which finds nothing at some letters.

lunr keeps the words of all pages as a graph of letters, and takes nodes with equal texts for one. The text of a node
has each of its letters and, at once behind it, the number of the node that the letter leads to: where letters are
digits, two different nodes may have equal texts ("1" to 23, "12" to 3). The graph then has words that no page has, as
"x1.4", and a search that comes to one of them ends without a result. A comma behind each number tells them apart.
"""

from __future__ import annotations

import re

NODE_TEXT = re.compile(r"(TokenSet\.prototype\.toString=function\(\)\{[^{}]*\{[^{}]*\.id)\}")


def mended_search(script: str) -> str:
    """The theme's script of the search, with a comma behind each number. Raises ValueError if it is another one."""
    mended, count = NODE_TEXT.subn(r'\1+","}', script)
    if count != 1:
        raise ValueError(
            f"The script of the theme's search names its nodes in {count} places that NODE_TEXT knows, not in one. See "
            "TokenSet.prototype.toString in it, and mend docs/site/site_search.py."
        )
    return mended
