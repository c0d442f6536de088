"""Cells as XML text, in a third of the time: a workbook has some hundred thousand.

openpyxl makes an element of each cell, and a generic writer looks for namespaces in it. Here a
number or a plain text is written as what comes out of that; other cells go openpyxl's way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any
from xml.sax.saxutils import escape

from openpyxl.cell import Cell
from openpyxl.compat import safe_string
from openpyxl.worksheet import _writer

KINDS = {"n": (int, float, type(None)), "s": (str,)}
"""Types of values that are written here, by openpyxl's name for the type of a cell."""


@contextmanager
def quick_cells() -> Iterator[None]:
    """While the block runs, sheets are written with `write_cell`."""
    theirs = _writer.write_cell
    _writer.write_cell = partial(write_cell, theirs)
    try:
        yield
    finally:
        _writer.write_cell = theirs


def write_cell(
    theirs: Callable[..., None], xf: Any, worksheet: Any, cell: Cell, styled: bool = False
) -> None:
    """Write one cell.

    Parameters
    ----------
    theirs : callable
        openpyxl's function with the parameters that follow.
    xf : et_xmlfile's writer
        Another one, such as that of lxml, is given to `theirs`.
    worksheet : Worksheet
    cell : Cell
    styled : bool
        Whether the cell has a style.
    """
    write, value = getattr(xf, "_file", None), cell.value
    if write is None or cell.hyperlink or type(value) not in KINDS.get(cell.data_type, ()):
        theirs(xf, worksheet, cell, styled)
        return
    style = f' s="{cell.style_id}"' if styled else ""
    kind = "n" if cell.data_type == "n" else "inlineStr"
    head = f'<c r="{cell.coordinate}"{style} t="{kind}"'
    if value is None or value == "":
        write(f"{head} />")
    elif kind == "n":
        write(f"{head}><v>{safe_string(value)}</v></c>")
    else:
        outside = value.strip() not in ("", value)
        kept = ' xml:space="preserve"' if outside else ""
        write(f"{head}><is><t{kept}>{escape(value)}</t></is></c>")
