"""Which material card a command uses: the laboratory's, or the paper's ply."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from nptcs.errors import InputError
from nptcs.files import read_model
from nptcs.tables.laboratory.material_card import PLY_CONSTANTS, PUBLISHED_PLY, MaterialCard

PUBLISHED = "published"
CARD = "results/material_card.json"
"""Where a run writes the card; a command that is typed in the project folder uses it."""


@dataclass(frozen=True)
class ChosenMaterials:
    """The ply that a command computes with, and the tested rubbers that it may name.

    Parameters
    ----------
    ply : dict of str to float
        The nine constants.
    source : str
        Where they come from, in words.
    c10_mpa : dict of str to float
        By the names of the rubbers of the card.
    """

    ply: dict[str, float]
    source: str
    c10_mpa: dict[str, float] = field(default_factory=dict)

    def rubber(self, value: float | str, argument: str) -> float:
        """Return C10 in MPa: the number itself, or that of a rubber of the card.

        Raises
        ------
        InputError
            For a rubber that the card does not have.
        """
        if not isinstance(value, str):
            return value
        if value not in self.c10_mpa:
            named = f", or one of: {', '.join(self.c10_mpa)}" if self.c10_mpa else ""
            raise InputError(
                f"{argument}: the card has no such rubber", f"give C10 in MPa{named}", value=value
            )
        return self.c10_mpa[value]


def choose_materials(card: str | None, ply: str | None) -> ChosenMaterials:
    """Read the card that a command was given, or the one of the last run, or take the paper's ply.

    Parameters
    ----------
    card : str, optional
        A card's file, or ``published``; by default `CARD` if there is one, else the paper's ply.
    ply : str, optional
        Name of a ply of the card; not needed if it has only one.

    Raises
    ------
    InputError
        For a card that cannot be read, or a ply that it does not have or that must be named.
    """
    if card == PUBLISHED or (card is None and not Path(CARD).is_file()):
        if ply is not None:
            raise InputError(
                "--ply names a ply of a material card, but the published ply is used",
                f"give --card, or run the study so that {CARD} exists",
                value=ply,
            )
        why = "" if card == PUBLISHED else f"; there is no {CARD} here"
        return ChosenMaterials(dict(PUBLISHED_PLY), f"table 2 of the paper{why}")
    path = card or CARD
    content = read_model(path, MaterialCard, by_hand=True)
    chosen = content.plies[_name(path, list(content.plies), ply)]
    if missing := [name for name in PLY_CONSTANTS if name not in chosen.constants]:
        raise InputError(
            f"the ply {chosen.name} has no {', '.join(missing)}",
            "complete the card, or give --card published",
            path,
        )
    measured = sum(quantity.origin == "measured" for quantity in chosen.constants.values())
    origin = f"{measured} of {len(chosen.constants)} constants measured"
    synthetic = ", SYNTHETIC data" if chosen.synthetic else ""
    rubbers = {
        name: rubber.constants["c10_mpa"].value
        for name, rubber in content.rubbers.items()
        if "c10_mpa" in rubber.constants
    }
    source = f"ply {chosen.name} of {path} ({origin}{synthetic})"
    return ChosenMaterials(chosen.values(), source, rubbers)


def _name(path: str, plies: list[str], asked: str | None) -> str:
    """Return the ply that was named, or the only one."""
    if asked is None and len(plies) == 1:
        return plies[0]
    if not plies:
        raise InputError("the card has no ply", "give --card published, or another card", path)
    if asked is None:
        raise InputError(
            "the card has several plies", f"add --ply, one of {', '.join(plies)}", path
        )
    if asked not in plies:
        raise InputError(
            "the card does not have this ply",
            f"choose one of {', '.join(plies)}",
            path,
            value=asked,
        )
    return asked
