"""Conditions that the machine and the cards of a rack report."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Condition:
    """One report of a card or part, as mr_conditions returns it in C."""

    number: int  #: from 1; a gap shows that older ones were dropped
    seconds: float  #: virtual time at which it happened
    source: str  #: name of the card or part, "rack" if neither
    code: int  #: of this kind of card
    text: str  #: a sentence
