"""The section ``laboratory:`` of the configuration: what a laboratory's own page says."""

from __future__ import annotations

from datetime import date
from typing import Self

from pydantic import Field, model_validator

from nptcs.config.base import Strict
from nptcs.language import ENGLISH, Language


class Signature(Strict):
    """One line of the signature block."""

    role: str = Field(description="Such as 'Tested by', 'Approved by'")
    name: str = Field("", description="Who signs; empty: left to be written by hand")


class Laboratory(Strict):
    """Who made the study, for whom and when; shown at the head of report and workbook.

    None of it changes a number: a change rewrites report and workbook, nothing else.
    """

    name: str = Field("", description="Name of the laboratory, shown under the title")
    address: str = Field("", description="Its address, on one line or several")
    logo: str | None = Field(
        None, description="PNG or SVG file of at most 500 kB, shown at the head of the report"
    )
    customer: str = Field("", description="For whom the study was made")
    operator: str = Field("", description="Who ran the tests")
    report_number: str = Field("", description="Number or title under which it is filed")
    dates: dict[str, date] = Field(
        default_factory=dict,
        description="What happened when, such as {Specimens received: 2026-03-02, Report: "
        "2026-04-17}, in this order",
    )
    signatures: tuple[Signature, ...] = Field(
        (), description="Lines of the signature block; none: no such block"
    )
    language: Language = Field(
        ENGLISH,
        description="Language of report, explorer, workbook and comparisons: en, English; zh, "
        "simplified Chinese",
    )

    @model_validator(mode="after")
    def _dates_are_named(self) -> Self:
        if any(not name.strip() for name in self.dates):
            raise ValueError("dates: each date needs a name, such as 'Report: 2026-04-17'")
        return self

    @property
    def has_cover(self) -> bool:
        """Tell whether there is anything to show besides the name."""
        shown = (self.address, self.logo, self.customer, self.operator, self.report_number)
        return any((*shown, self.dates, self.signatures))
