"""Single spokes compared with the paper: figure 13's curves and table 10's lines, section 4.3.1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from nptcs.campaign.record import CaseRecord
from nptcs.compare.conditions import PAPER_PLATES
from nptcs.tables.tyres.spoke_stiffness import DIRECTIONS, SPOKE_VALUES, SpokeCurves, SpokeLines


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
        if record.result.status.solved
    ]
    columns = list(SpokeCurves.to_schema().columns)
    return pd.concat(tables)[columns] if tables else pd.DataFrame(columns=columns)


def spoke_lines(
    records: Sequence[CaseRecord], published: Mapping[str, pd.DataFrame]
) -> pd.DataFrame:
    """Compare the lines through the origin that the solvers report with table 10.

    Parameters
    ----------
    records : sequence of CaseRecord
        Single spokes (`nptcs.solvers.contract.SPOKE_RESPONSES`); one that failed is a row
        without values.
    published : mapping of str to DataFrame
        Table 10 for the studies that name it: spoke_c10_mpa, tension_stiffness_n_per_mm,
        compression_stiffness_n_per_mm, and perhaps tension_r2 and compression_r2.

    Returns
    -------
    DataFrame
        As `SpokeLines`.
    """
    rows = [_line(record, published.get(record.study)) for record in records]
    return pd.DataFrame(rows, columns=list(SpokeLines.to_schema().columns))


def _name(record: CaseRecord) -> dict[str, str]:
    return {"study": record.study, "case_id": record.case_id, "solver": record.solver}


def _line(record: CaseRecord, published: pd.DataFrame | None) -> dict[str, object]:
    row: dict[str, object] = {
        **_name(record),
        **{name: record.values[name] for name in SPOKE_VALUES},
        "status": record.result.status.value,
    }
    table_10 = _published_row(published, record.values)
    reported = record.result.extra if record.result.status.solved else {}
    for direction in DIRECTIONS:
        stiffness = f"{direction}_stiffness_n_per_mm"
        row[f"published_{stiffness}"] = table_10.get(stiffness, np.nan)
        row[f"published_{direction}_r2"] = table_10.get(f"{direction}_r2", np.nan)
        for name in (stiffness, f"{direction}_r2_uncentred", f"{direction}_r2_centred"):
            row[name] = reported.get(name, np.nan)
        if stiffness in table_10 and stiffness in reported:
            difference = 100 * (reported[stiffness] / table_10[stiffness] - 1)
            row[f"{direction}_difference_percent"] = difference
    return row


def _published_row(published: pd.DataFrame | None, values: Mapping[str, float]) -> dict[str, float]:
    """Return table 10's column for this spoke; nothing for other rubbers or other plates."""
    plates = all(np.isclose(values[name], value) for name, value in PAPER_PLATES.items())
    if published is None or not plates:
        return {}
    same = np.isclose(published["spoke_c10_mpa"], values["spoke_c10_mpa"])
    rows = published[same].to_dict("records")
    return {str(name): float(value) for name, value in rows[0].items()} if rows else {}
