"""Responses of solved tyres as tables, one row per response, with a reason for each gap."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass

import numpy as np
import pandas as pd

from nptcs.campaign.record import CaseRecord
from nptcs.config.studies.responses import TyreResponseSettings
from nptcs.responses.curve import CurvePoint, LoadCurve
from nptcs.responses.strength import PlyStrengths, maximum_stress_factor, tsai_wu_factor
from nptcs.tables.tyres.tyre_responses import PlateStress, TyreCurves, TyreResponses

OK, NOT_ASSESSED, NOT_REACHED = "ok", "not assessed", "not reached"
# what a solver reports about the tyre at its load: name, unit, rule
AT_LOAD = {
    "contact_length_mm": ("contact_length", "mm", "√(12 Var) of the place, by pressure"),
    "largest_pressure_mpa": ("largest_pressure", "MPa", "of the contact's points"),
    "mean_pressure_mpa": ("mean_pressure", "MPa", "load over contact length and width"),
    "largest_spoke_force_n": ("largest_spoke_force", "N", "radial, positive in tension"),
    "smallest_spoke_force_n": ("smallest_spoke_force", "N", "radial, negative in compression"),
}
# what needs a contact of enough points
OF_CONTACT = {"contact_length_mm", "largest_pressure_mpa", "mean_pressure_mpa"}
# what it reports about the most loaded spokes, solved again
PLATE = "at the plates' faces, element centres"
PLATE_MEAN = "at the plates' faces, element means"
RUBBER = "at the integration points of the most loaded spokes"
IN_SPOKES = {
    "plate_largest_mises_mpa": ("plate_largest_mises", "MPa", f"in plane, {PLATE}"),
    "plate_largest_mean_mises_mpa": (
        "plate_largest_mean_mises",
        "MPa",
        f"in plane, {PLATE_MEAN}",
    ),
    "plate_largest_along_mpa": ("plate_largest_along_fibres", "MPa", f"σ1 {PLATE}"),
    "plate_smallest_along_mpa": ("plate_smallest_along_fibres", "MPa", f"σ1 {PLATE}"),
    "plate_largest_across_mpa": ("plate_largest_across_fibres", "MPa", f"σ2 {PLATE}"),
    "plate_smallest_across_mpa": ("plate_smallest_across_fibres", "MPa", f"σ2 {PLATE}"),
    "plate_largest_shear_mpa": ("plate_largest_shear", "MPa", f"|τ12| {PLATE}"),
    "rubber_largest_principal_strain": ("rubber_largest_principal_strain", "1", f"λ - 1, {RUBBER}"),
    "rubber_largest_energy_density_n_per_mm2": (
        "rubber_largest_energy_density",
        "N/mm²",
        f"per unloaded volume, {RUBBER}",
    ),
}
MARGINS = {
    "plate_factor_maximum_stress": ("maximum stress", maximum_stress_factor),
    "plate_factor_tsai_wu": ("Tsai–Wu with F12 = -½ √(F11 F22)", tsai_wu_factor),
}
STRESSES = ["along_mpa", "across_mpa", "shear_mpa"]


@dataclass(frozen=True)
class TyreResponse:
    """One response of one tyre, see `TyreResponses`."""

    response: str
    at: str
    value: float
    unit: str
    status: str
    note: str


def _missing(name: str, at: str, unit: str, why: str, status: str = NOT_ASSESSED) -> TyreResponse:
    return TyreResponse(name, at, np.nan, unit, status, why)


def tyre_responses(
    records: Sequence[CaseRecord], settings: TyreResponseSettings, strengths: PlyStrengths
) -> pd.DataFrame:
    """Gather the responses of all solved tyres that have a load–displacement curve.

    Parameters
    ----------
    records : sequence of CaseRecord
        Cases that failed are left out: ``cases.csv`` has them.
    settings : TyreResponseSettings
    strengths : PlyStrengths
        Of the plates' ply.

    Returns
    -------
    DataFrame
        As `TyreResponses`.
    """
    rows = [
        {**_who(record), "load_n": record.load_n, **asdict(response)}
        for record in _solved(records)
        for response in _responses(record, settings, strengths)
    ]
    return pd.DataFrame(rows, columns=list(TyreResponses.to_schema().columns))


def tyre_curves(records: Sequence[CaseRecord]) -> pd.DataFrame:
    """Gather the load–displacement curves of all solved tyres, as `TyreCurves`."""
    names = list(TyreCurves.to_schema().columns)
    tables = [pd.DataFrame({**_who(r), **(r.result.curve or {})}) for r in _solved(records)]
    return pd.concat(tables, ignore_index=True)[names] if tables else pd.DataFrame(columns=names)


def plate_stress(records: Sequence[CaseRecord]) -> pd.DataFrame:
    """Gather the stress at the faces of the plates of all solved tyres, as `PlateStress`."""
    names = list(PlateStress.to_schema().columns)
    tables = [
        pd.DataFrame({**_who(r), "load_n": r.load_n, **r.result.plate_stress})
        for r in _solved(records)
        if r.result.plate_stress is not None
    ]
    return pd.concat(tables, ignore_index=True)[names] if tables else pd.DataFrame(columns=names)


def _solved(records: Sequence[CaseRecord]) -> list[CaseRecord]:
    return [
        record
        for record in records
        if record.result.status.solved
        and record.load_n is not None
        and record.result.curve is not None
    ]


def _who(record: CaseRecord) -> dict[str, str]:
    return {"study": record.study, "case_id": record.case_id, "solver": record.solver}


def _responses(
    record: CaseRecord, settings: TyreResponseSettings, strengths: PlyStrengths
) -> Iterator[TyreResponse]:
    yield from _stiffness(record, settings)
    at = f"{record.load_n:g} N"
    for source in (AT_LOAD, IN_SPOKES):
        for key, (name, unit, rule) in source.items():
            if key in record.result.extra:
                yield TyreResponse(name, at, record.result.extra[key], unit, OK, rule)
            else:
                yield _missing(name, at, unit, _why_not(record, key))
    yield from _margins(record, strengths, at)
    mass = _plate_mass(record, settings)
    yield mass
    yield _plate_cost(mass, settings)


def _why_not(record: CaseRecord, key: str) -> str:
    """Say why a response has no value."""
    if key in IN_SPOKES:
        return _why_no_stress(record)
    across = record.result.extra.get("contact_cells")
    if key in OF_CONTACT and across is not None:
        return (
            f"the contact is only {across:.1f} contact points long, too few to resolve it: "
            "refine the ring's mesh"
        )
    return "the solver does not report it"


def _why_no_stress(record: CaseRecord) -> str:
    """Say why the stress inside the spokes is not known."""
    return record.result.message or "no spoke was solved again at its motion in the tyre"


def _stiffness(record: CaseRecord, settings: TyreResponseSettings) -> Iterator[TyreResponse]:
    """Secant and tangent stiffness at loads and displacements."""
    places = [f"{load:g} N" for load in sorted({*settings.loads_n, float(record.load_n or 0.0)})]
    places += [f"{displacement:g} mm" for displacement in settings.displacements_mm]
    columns = record.result.curve or {}
    try:
        curve = LoadCurve(np.array(columns["displacement_mm"]), np.array(columns["force_n"]))
    except (KeyError, ValueError) as error:
        for at in places:
            for name in ("secant_stiffness", "tangent_stiffness"):
                yield _missing(name, at, "N/mm", str(error))
        return
    for at in places:
        number, unit = at.split(" ")
        find = curve.at_load if unit == "N" else curve.at_displacement
        yield from _at_point(find(float(number)), at, _end(curve, record))


def _end(curve: LoadCurve, record: CaseRecord) -> str:
    """Say where a curve ends, and why if the solver says so."""
    end = f"the curve ends at {curve.last_load_n:.0f} N and {curve.last_displacement_mm:.2f} mm"
    return f"{end}; {record.result.message}" if record.result.message else end


def _at_point(point: CurvePoint | None, at: str, end: str) -> Iterator[TyreResponse]:
    names = ("secant_stiffness", "tangent_stiffness")
    if point is None:
        for name in names:
            yield _missing(name, at, "N/mm", end, NOT_REACHED)
        return
    rules = ("load over displacement", "slope of the curve smoothed over its nearest points")
    for name, value, rule in zip(
        names, (point.secant_n_per_mm, point.tangent_n_per_mm), rules, strict=True
    ):
        yield TyreResponse(name, at, value, "N/mm", OK, rule)


def _margins(record: CaseRecord, strengths: PlyStrengths, at: str) -> Iterator[TyreResponse]:
    """Factors from the plates' stress to their strengths."""
    stress = record.result.plate_stress
    for name, (rule, factor) in MARGINS.items():
        if stress is None:
            yield _missing(name, at, "1", _why_no_stress(record))
        elif strengths.missing():
            lacking = ", ".join(strengths.missing())
            yield _missing(name, at, "1", f"strengths of the ply that are not tested: {lacking}")
        else:
            points = np.array([stress[column] for column in STRESSES]).T
            note = f"{rule}, {PLATE}; stress may grow by this factor"
            yield TyreResponse(name, at, factor(points, strengths), "1", OK, note)


def _plate_mass(record: CaseRecord, settings: TyreResponseSettings) -> TyreResponse:
    density, volume = settings.plate_density_kg_per_m3, record.result.extra.get("plate_volume_mm3")
    if density is None:
        return _missing("plate_mass", "", "kg", "no plate_density_kg_per_m3 in the configuration")
    if volume is None:
        return _missing("plate_mass", "", "kg", "the solver does not report the plates' volume")
    note = f"all plates of the tyre, {density:g} kg/m³ as configured"
    return TyreResponse("plate_mass", "", volume * density * 1e-9, "kg", OK, note)


def _plate_cost(mass: TyreResponse, settings: TyreResponseSettings) -> TyreResponse:
    price = settings.plate_price_per_kg
    if price is None:
        why = "no plate_price_per_kg in the configuration"
        return _missing("plate_cost", "", "currency", why)
    if mass.status != OK:
        return _missing("plate_cost", "", "currency", mass.note)
    note = f"all plates of the tyre, {price:g} per kg as configured"
    return TyreResponse("plate_cost", "", mass.value * price, "currency", OK, note)
