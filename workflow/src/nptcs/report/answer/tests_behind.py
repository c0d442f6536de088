"""How sound are the tests behind it? Scatter, deviations from the standards, synthetic data."""

from __future__ import annotations

from nptcs.language import tr, tr_count
from nptcs.report.blocks import Finding
from nptcs.report.data import Results
from nptcs.report.sketches import Share, bar_of_shares
from nptcs.tables.laboratory.flags import FlagsTable
from nptcs.tables.laboratory.statistics import StatisticsTable
from nptcs.tables.result_table import ReportSection

MODULUS = "modulus"


def tests_finding(results: Results) -> Finding:
    """Count the specimens by what a reader must know about them, and say how moduli scatter."""
    total = len(results.sheet)
    if not total:
        return Finding(
            _question(),
            tr("Not assessed"),
            tr("The specimen sheet has no specimen that can be used."),
            "specimens.csv",
            ReportSection.SPECIMENS,
            assessed=False,
        )
    deviating = deviating_specimens(results)
    left_out, failed = results.left_out(), set(results.failed())
    out = set(left_out) | failed
    used = total - len(out)
    flagged = len(deviating - out)
    parts = [
        Share(tr("as the standard requires"), used - flagged, "good"),
        Share(tr("deviate from it"), flagged, "warn"),
        Share(tr("left out by the sheet"), len(set(left_out) - failed), "soft"),
        Share(tr("could not be read"), len(failed), "bad"),
    ]
    return Finding(
        _question(),
        tr_count(
            "{count} of {total} specimens used deviates from its standard",
            "{count} of {total} specimens used deviate from their standard",
            flagged,
            total=used,
        ),
        " ".join([*_scatter(results), _origin(results)]),
        "flags.csv, statistics.csv",
        ReportSection.SPECIMENS,
        bar_of_shares(parts, tr("Specimens used, deviating, left out and not read")),
        synthetic=results.any_synthetic,
    )


def deviating_specimens(results: Results) -> set[str]:
    """Name the specimens that deviate from their standard."""
    flags = results.table(FlagsTable)
    names = flags.loc[flags["kind"] == "deviation", "names"]
    return {name for joined in names for name in joined.split(", ")}


def _question() -> str:
    return tr("How sound are the tests behind it?")


def _scatter(results: Results) -> list[str]:
    """Say how the moduli scatter: standard deviation over mean."""
    table = results.table(StatisticsTable)
    moduli = table["property"].str.endswith(MODULUS) & table["scope"].eq("group")
    rows = table[moduli].dropna(subset=["cv_percent"]).sort_values("cv_percent")
    if rows.empty:
        return [tr("The scatter of the moduli was not assessed.")]
    worst = rows.iloc[-1]
    return [
        tr_count(
            "The standard deviation of the modulus is {high} % of its mean ({test}).",
            "The standard deviations of the moduli are {low} to {high} % of their means, the "
            "largest in {test}.",
            len(rows),
            low=f"{rows['cv_percent'].iloc[0]:.2g}",
            high=f"{worst['cv_percent']:.2g}",
            test=_group(worst.to_dict()),
        )
    ]


def _group(row: dict[object, object]) -> str:
    """Name a group of specimens: test, material and orientation."""
    test = str(row["test"]).replace("_", " ")
    angle = row["orientation_deg"]
    return f"{tr(test)} {row['material']}" + (f" {angle:g}°" if angle == angle else "")


def _origin(results: Results) -> str:
    synthetic = sum(specimen.origin == "synthetic" for specimen in results.sheet)
    if not synthetic:
        return tr("All specimens were measured.")
    return tr(
        "{count} of {total} specimens are SYNTHETIC example data, and so is everything based on "
        "their constants.",
        count=synthetic,
        total=len(results.sheet),
    )
