"""Correction of the theme's search, which finds nothing for some inputs.

lunr keeps the words of all pages as a graph of letters, and merges nodes with equal texts. The text of a node has each
of its letters, followed by the number of the node that the letter leads to: where letters are digits, two different
nodes may have equal texts ("1" to 23, "12" to 3). The graph then has words that no page has, such as "x1.4", and a
search that reaches one of them ends without a result. A comma after each number separates the two.
"""

from __future__ import annotations

import re

NODE_TEXT = re.compile(r"(TokenSet\.prototype\.toString=function\(\)\{[^{}]*\{[^{}]*\.id)\}")


def mended_search(script: str) -> str:
    """Returns the search script of the theme with a comma after each number. Raises ValueError for another script."""
    mended, count = NODE_TEXT.subn(r'\1+","}', script)
    if count != 1:
        raise ValueError(
            f"The script of the theme's search names its nodes in {count} places that NODE_TEXT knows, not in one. See "
            "TokenSet.prototype.toString in it, and mend docs/site/site_search.py."
        )
    return mended
