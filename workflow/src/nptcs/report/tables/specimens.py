"""Tables of specimens that no file has in this form: the sheet, and the ingest records."""

from __future__ import annotations

import pandas as pd

from nptcs.language import tr
from nptcs.report.data import Results
from nptcs.report.words.flags import flag_text

_SHEET_NUMBERS = (
    "orientation_deg",
    "mean_width_mm",
    "mean_thickness_mm",
    "area_mm2",
    "gauge_length_mm",
    "temperature_c",
    "humidity_percent",
    "span_mm",
    "loading_span_mm",
)


def sheet_table(results: Results) -> pd.DataFrame:
    """Write the specimen sheet as a table, with mean dimensions."""
    return pd.DataFrame(
        [
            {
                "specimen": s.specimen,
                "test": s.test.value,
                "material": s.material,
                "orientation_deg": s.orientation_deg,
                "mean_width_mm": s.mean_width_mm,
                "mean_thickness_mm": s.mean_thickness_mm,
                "area_mm2": s.area_mm2,
                "gauge_length_mm": s.gauge_length_mm,
                "include": "yes" if s.include else "no",
                "reason": s.reason,
                "origin": s.origin,
                "force_file": s.force_file,
                "strain_file": s.strain_file,
                "remarks": s.remarks,
                "date": "" if s.date is None else s.date.isoformat(),
                "operator": s.operator,
                "machine": s.machine,
                "temperature_c": s.temperature_c,
                "humidity_percent": s.humidity_percent,
                "piece": s.piece,
                "properties": ", ".join(s.properties),
                "loading": "" if s.loading == "first" else s.loading,
                "failed": "" if s.failed is None else ("yes" if s.failed else "no"),
                "span_mm": s.span_mm,
                "loading_span_mm": s.loading_span_mm,
                "platens": s.platens,
                "area_rule": s.area_rule,
            }
            for s in results.sheet
        ]
    ).astype({name: float for name in _SHEET_NUMBERS})


def conditioning_table(results: Results) -> pd.DataFrame:
    """Write how each curve was obtained, one row per specimen."""
    return pd.DataFrame(
        [
            {
                "specimen": name,
                "status": record.status,
                "readings": sum(file.rows for file in record.files),
                "format": ", ".join(dict.fromkeys(file.format for file in record.files)),
                "strain_source": record.strain_source,
                "steps": "; ".join(
                    f"{tr(step.name)}: {flag_text(step.changed) or tr('no change')}"
                    for step in record.steps
                    if step.on
                ),
                "flags": "; ".join(record.flags),
                "message": record.message,
            }
            for name, record in results.records.items()
        ],
        columns=[
            "specimen",
            "status",
            "readings",
            "format",
            "strain_source",
            "steps",
            "flags",
            "message",
        ],
    )
