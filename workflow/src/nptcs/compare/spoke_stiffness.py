"""Single spokes compared with the paper: figure 13's curves and table 10's lines, section 4.3.1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from nptcs.campaign.record import CaseRecord
from nptcs.fe.spoke.stiffness_line import stiffness_line
from nptcs.tables.spoke_stiffness import DIRECTIONS, SPOKE_VALUES, SpokeCurves, SpokeLines


def spoke_curves(records: Sequence[CaseRecord]) -> pd.DataFrame:
    """Gather the curves of all spokes that were solved, as `SpokeCurves`."""
    tables = [
        pd.DataFrame(
            {
                **_name(record),
                "spoke_c10_mpa": record.values["spoke_c10_mpa"],
                **(record.result.curve or {}),
            }
        )
        for record in records
        if record.result.status == "ok"
    ]
    columns = list(SpokeCurves.to_schema().columns)
    return pd.concat(tables)[columns] if tables else pd.DataFrame(columns=columns)


def spoke_lines(records: Sequence[CaseRecord], printed: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """Fit the lines through the origin and set table 10 beside them, as `SpokeLines`.

    Parameters
    ----------
    records : sequence of CaseRecord
        Single spokes; one that failed is a row without values.
    printed : mapping of str to DataFrame
        Table 10 for the studies that name it: spoke_c10_mpa, tension_stiffness_n_per_mm,
        compression_stiffness_n_per_mm, and perhaps tension_r2 and compression_r2.
    """
    rows = [_line(record, printed.get(record.study)) for record in records]
    return pd.DataFrame(rows, columns=list(SpokeLines.to_schema().columns))


def _name(record: CaseRecord) -> dict[str, str]:
    return {"study": record.study, "case_id": record.case_id, "solver": record.solver}


def _line(record: CaseRecord, printed: pd.DataFrame | None) -> dict[str, object]:
    row: dict[str, object] = {
        **_name(record),
        **{name: record.values[name] for name in SPOKE_VALUES},
        "status": record.result.status.value,
    }
    theirs = _published_row(printed, record.values["spoke_c10_mpa"])
    for direction, sign in DIRECTIONS.items():
        stiffness = f"{direction}_stiffness_n_per_mm"
        row[f"published_{stiffness}"] = theirs.get(stiffness, np.nan)
        row[f"published_{direction}_r2"] = theirs.get(f"{direction}_r2", np.nan)
        if record.result.status != "ok" or record.result.curve is None:
            continue
        displacement, force = (
            sign * np.array(record.result.curve[name]) for name in ("displacement_mm", "force_n")
        )
        inside = displacement >= 0.0
        line = stiffness_line(displacement[inside], force[inside])
        row[stiffness] = line.slope
        row[f"{direction}_r2_uncentred"] = line.r2_uncentred
        row[f"{direction}_r2_centred"] = line.r2_centred
        if stiffness in theirs:
            row[f"{direction}_difference_percent"] = 100 * (line.slope / theirs[stiffness] - 1)
    return row


def _published_row(printed: pd.DataFrame | None, c10_mpa: float) -> dict[str, float]:
    """Return table 10's column for this rubber; nothing where it has none."""
    if printed is None:
        return {}
    rows = printed[np.isclose(printed["spoke_c10_mpa"], c10_mpa)].to_dict("records")
    return {str(name): float(value) for name, value in rows[0].items()} if rows else {}
