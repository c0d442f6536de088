"""What the page template receives: tables of finished text, figures as SVG, paragraphs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, assert_never

from nptcs.report.sketches import Sketch
from nptcs.report.tables.entries import Entry
from nptcs.tables.result_table import Heading, ReportSection

LONG = 60
"""Characters beyond which a text may wrap."""


@dataclass(frozen=True)
class Cell:
    """One cell: its text, the full number behind it for sorting, the name in the file on hover."""

    text: str
    number: str = ""
    name_in_file: str = ""

    @property
    def css(self) -> str:
        """Return the CSS class of the cell."""
        if self.number or self.text == "–":
            return "number"
        if len(self.text) == 64 and set(self.text) <= set("0123456789abcdef"):
            return "hash"
        return "long" if len(self.text) > LONG else ""


@dataclass(frozen=True)
class TableView:
    """One table of the page.

    Parameters
    ----------
    entry, caption, headings, numeric, rows, synthetic
        What it is, words above it, its columns and whether they hold numbers, the rows that are
        shown with their CSS classes, and whether it rests on synthetic data.
    all_rows : int
        Rows of the whole table; a long one is not shown in full.
    columns : tuple of str
        Names of the columns in the file.
    folded : bool
        Whether it opens on demand.
    notes : tuple of str
        Remarks that apply to all its rows.
    """

    entry: Entry
    caption: str
    headings: tuple[Heading, ...]
    numeric: tuple[bool, ...]
    rows: tuple[tuple[str, tuple[Cell, ...]], ...]
    synthetic: bool = False
    all_rows: int = 0
    columns: tuple[str, ...] = ()
    folded: bool = False
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Plot:
    """One figure of the page.

    Parameters
    ----------
    written : callable
        Returns the figure as SVG, with its text alternative, and the numbers that it shows: CSV,
        deflated, in base64, empty where it has none. The call waits until the figure is drawn.
    alt : str
        The text alternative.
    name : str
        Name of its file, without ending.
    synthetic : bool
        Whether it shows synthetic data.
    """

    written: Callable[[], tuple[str, str]]
    alt: str
    name: str
    synthetic: bool = False

    @property
    def svg(self) -> str:
        """The figure, with its text alternative."""
        return self.written()[0]

    @property
    def data(self) -> str:
        """The numbers that it shows."""
        return self.written()[1]


@dataclass(frozen=True)
class Plots:
    """Figures side by side under one caption.

    Parameters
    ----------
    caption, plots
        Words below them, and the figures.
    shown : int, optional
        How many are in sight; the others open on demand. All by default.
    """

    caption: str
    plots: tuple[Plot, ...]
    shown: int | None = None

    @property
    def in_sight(self) -> tuple[Plot, ...]:
        """The figures that are shown at once."""
        return self.plots[: self.shown]

    @property
    def folded(self) -> tuple[Plot, ...]:
        """The figures that open on demand."""
        return () if self.shown is None else self.plots[self.shown :]

    @property
    def synthetic(self) -> bool:
        """True if any of them shows synthetic data."""
        return any(plot.synthetic for plot in self.plots)

    @property
    def css(self) -> str:
        """Two panels per row where three would leave one alone."""
        return "panels two" if len(self.in_sight) in (2, 4) else "panels"


ParagraphKind = Literal["", "ok", "bad", "warn", "heading"]
"""What a paragraph is: plain, one of three judgements, which have colours, or a heading."""


@dataclass(frozen=True)
class Text:
    """A paragraph."""

    text: str
    kind: ParagraphKind = ""


@dataclass(frozen=True)
class Listing:
    """A list of remarks under a line of words."""

    lead: str
    items: tuple[str, ...]
    kind: ParagraphKind = ""


@dataclass(frozen=True)
class Fact:
    """One result in words: what, the result, the table that holds it."""

    what: str
    result: str
    source: str


@dataclass(frozen=True)
class Facts:
    """Results in words, set so that a phone shows them in full."""

    title: str
    facts: tuple[Fact, ...]


@dataclass(frozen=True)
class Folded:
    """Long text that opens on demand, such as the configuration."""

    title: str
    text: str


@dataclass(frozen=True)
class Finding:
    """One answer of the first screen.

    Parameters
    ----------
    question, answer, words
        What is asked, the result in a few words, and one or two sentences on it.
    source : str
        Tables that hold the numbers.
    section : ReportSection
        Section with the details.
    sketch : Sketch, optional
        A small figure.
    assessed : bool
        False where the run has no answer.
    synthetic : bool
        Whether it rests on synthetic data.
    """

    question: str
    answer: str
    words: str
    source: str
    section: ReportSection
    sketch: Sketch | None = None
    assessed: bool = True
    synthetic: bool = False


@dataclass(frozen=True)
class Findings:
    """The answers of the first screen."""

    findings: tuple[Finding, ...]


@dataclass(frozen=True)
class Interactive:
    """A part of the page that computes: finished HTML with its data, styles and scripts."""

    markup: str


@dataclass(frozen=True)
class MoreTables:
    """Tables that open on demand: they are behind what the section says, not part of it.

    Parameters
    ----------
    title : str
        Says how many there are.
    titles : str
        Titles of the tables.
    tables : tuple of TableView or Text
        The tables; for one that is too long for a page, a text that says where it is.
    """

    title: str
    titles: str
    tables: tuple[TableView | Text, ...]


PageBlock = (
    TableView | Plots | Text | Listing | Facts | Folded | Findings | Interactive | MoreTables
)
BlockMacro = Literal[
    "table", "plots", "text", "listing", "facts", "folded", "findings", "interactive", "more"
]


def macro_of(block: PageBlock) -> BlockMacro:
    """Name the macro of the page template that writes a block."""
    match block:
        case TableView():
            return "table"
        case Plots():
            return "plots"
        case Text():
            return "text"
        case Listing():
            return "listing"
        case Facts():
            return "facts"
        case Folded():
            return "folded"
        case Interactive():
            return "interactive"
        case MoreTables():
            return "more"
        case Findings():
            return "findings"
        case _:
            assert_never(block)


@dataclass(frozen=True)
class Section:
    """One numbered section of the page."""

    identifier: ReportSection
    title: str
    blocks: tuple[PageBlock, ...]
    synthetic: bool = False
