"""Tables that a person reads on a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from tabulate import tabulate


def text_table(
    headings: Sequence[str], rows: Iterable[Sequence[str]], numeric: Sequence[bool]
) -> str:
    r"""Write a table of finished texts, with numbers aligned right.

    Parameters
    ----------
    headings : sequence of str
        A line break within a heading is kept, for a unit below a name.
    rows : iterable of sequence of str
        Texts, one per heading.
    numeric : sequence of bool
        Which columns contain numbers.

    Examples
    --------
    >>> print(text_table(["case", "load\n(N)"], [["a", "5000"]], [False, True]))
    case      load
               (N)
    ------  ------
    a         5000
    """
    sides = ["right" if number else "left" for number in numeric]
    return tabulate(
        [list(row) for row in rows],
        headers=list(headings),
        tablefmt="simple",
        colalign=sides if rows else None,
        headersglobalalign=None,
        headersalign=sides,
        disable_numparse=True,
    )
