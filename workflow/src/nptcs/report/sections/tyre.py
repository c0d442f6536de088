"""Section of the report on the solved tyres: figure 10 and section 4.1 of the paper."""

from __future__ import annotations

import numpy as np
import pandas as pd

from nptcs.compare.conditions import PAPER_LOAD_N
from nptcs.language import tr, translatable
from nptcs.report.blocks import Listing, PageBlock, Plot, Plots, Section, Text
from nptcs.report.data import Results
from nptcs.report.figures.tyre import (
    PUBLISHED_STRESS_MPA,
    deformed_tyre,
    load_displacement,
    plate_faces,
)
from nptcs.report.plots import plot
from nptcs.report.sections.ply import ply_words
from nptcs.report.tables.headings import words
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.report.text import joined
from nptcs.report.words.flags import flag_text
from nptcs.responses.displacement_by_load import FIDUCIAL_PLATES
from nptcs.tables.result_table import ReportSection
from nptcs.tables.solver_names import PUBLISHED
from nptcs.tables.tyres.cases import Cases
from nptcs.tables.tyres.deformed_tyre import DeformedTyre
from nptcs.tables.tyres.tyre_responses import PlateStress, TyreCurves, TyreResponses

TITLE = translatable("Behaviour of the solved tyres (section 4.1)")


def tyre_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    responses = results.table(TyreResponses)
    if responses.empty:
        return Section(ReportSection.TYRE, tr(TITLE), ())
    blocks: list[PageBlock] = [
        Text(
            tr(
                "Load–displacement curves and plate stress of the solved tyres. Plates are "
                "assessed where they are loaded most: at their faces, in the few spokes that "
                "store most energy, each solved again at its own motion in the tyre. Margins are "
                "factors by which the stress may grow; the strengths are those of the "
                "laboratory's statistics. "
            )
            + ply_words(results)
        ),
        *(Text(line) for line in published_stress(results)),
        *_without_value(responses),
        Plots(
            tr(
                "Load against vertical displacement, every tyre of a study (figure 10 b "
                "of the paper, which has no numbers; crosses: displacement by tables 5 "
                "and 7)."
            ),
            tuple(_curve_plots(results)),
            shown=4,
        ),
    ]
    if deformed := _deformed_plots(results):
        blocks.append(
            Plots(
                tr(
                    "Deformation of spokes and shear band by {solver} (figure 10 a of the "
                    "paper): the section through the middle of a plate, to scale, every spoke "
                    "solved again at its own motion. Dotted: before loading.",
                    solver=results.table(DeformedTyre)["solver"].iloc[0],
                ),
                tuple(deformed),
            )
        )
    elif any(study.neutral_line_cases for study in results.config.studies):
        blocks.append(
            Text(
                tr(
                    "No tyre is drawn with its spokes (figure 10 a of the paper): no finite "
                    "element solver has solved one of the cases of neutral_line_cases, or the "
                    "spokes of that tyre could not be solved again."
                )
            )
        )
    stress = tuple(_stress_plots(results))
    if stress:
        blocks.append(
            Plots(
                tr(
                    "Von Mises stress in the plane of the plates at both faces, in the most "
                    "loaded spoke of the tyre with the largest stress of each study, and of "
                    "its fiducial design (figure 10 a of the paper; dashed: its largest "
                    "value, {published_stress_mpa:g} MPa). Full lines: element centres.",
                    published_stress_mpa=PUBLISHED_STRESS_MPA,
                ),
                stress,
                shown=2,
            )
        )
    return Section(
        ReportSection.TYRE, tr(TITLE), tuple(blocks), sheet_of(sheets, TyreResponses).synthetic
    )


def published_stress(results: Results) -> list[str]:
    """Put the plate stress of the fiducial plates next to the paper's largest one."""
    responses, fiducial = results.table(TyreResponses), fiducial_cases(results)
    found = responses[
        responses["response"].eq("plate_largest_mises")
        & responses["status"].eq("ok")
        & np.isclose(responses["load_n"].astype(float), PAPER_LOAD_N)
        & responses["case_id"].isin(fiducial)
    ]
    if found.empty:
        return []
    parts = []
    for (study, solver), rows in found.groupby(["study", "solver"], sort=False):
        low, high = rows["value"].min(), rows["value"].max()
        if len(rows) == 1:
            parts.append(f"{low:.1f} MPa ({rows['case_id'].iloc[0]}, {solver})")
        else:
            parts.append(
                tr(
                    "{low:.1f} to {high:.1f} MPa ({count} tyres of the study {study}, {solver})",
                    low=low,
                    high=high,
                    count=len(rows),
                    study=study,
                    solver=solver,
                )
            )
    return [
        tr(
            "The paper gives {published_stress_mpa:g} MPa as the largest stress of a plate at "
            "5000 N; it does not say for which plates and rubbers, nor which stress measure is "
            "meant. The largest von Mises stress here, at the faces of the fiducial plates, is "
            "{names}. Nothing was fitted to it.",
            published_stress_mpa=PUBLISHED_STRESS_MPA,
            names=joined(parts),
        )
    ]


def fiducial_cases(results: Results) -> list[str]:
    """Name the cases with the paper's fiducial plates."""
    cases = results.table(Cases)
    if not set(FIDUCIAL_PLATES) <= set(cases):
        return []
    mine = cases[(cases[list(FIDUCIAL_PLATES)] == pd.Series(FIDUCIAL_PLATES)).all(axis=1)]
    return list(mine["case_id"].unique())


def not_assessed_sentence(responses: pd.DataFrame) -> list[str]:
    """Say how many responses have no value, and why, one sentence for each reason.

    Responses that the same number of tyres lack for the same reason share one sentence.
    """
    missing = responses[responses["status"] != "ok"]
    alike: dict[tuple[str, int, str], list[str]] = {}
    for (name, at, status), rows in missing.groupby(["response", "at", "status"], sort=False):
        response = words(str(name)) + (tr(" at {at}", at=at) if at else "")
        key = (str(status), len(rows), _reason(rows["note"]))
        alike.setdefault(key, []).append(response)
    return [
        tr(
            "{count} tyres, {status} ({reason}): {responses}.",
            count=count,
            status=tr(status),
            reason=reason,
            responses=", ".join(responses),
        )
        for (status, count, reason), responses in alike.items()
    ]


def _reason(notes: pd.Series) -> str:
    """Say why responses have no value; where the reasons differ, that of the first."""
    first = flag_text(str(notes.iloc[0]))
    return first if notes.eq(notes.iloc[0]).all() else tr("the first: {reason}", reason=first)


def _without_value(responses: pd.DataFrame) -> list[PageBlock]:
    """List the responses without a value; nothing where all have one."""
    lines = tuple(not_assessed_sentence(responses))
    return [Listing(tr("Not assessed"), lines, "warn")] if lines else []


def _synthetic(results: Results, study: object, solver: object) -> bool:
    return results.study_is_synthetic(results.config.study(str(study)), str(solver))


def _curve_plots(results: Results) -> list[Plot]:
    plots = []
    for (study, solver), curves in results.table(TyreCurves).groupby(
        ["study", "solver"], sort=False
    ):
        synthetic = _synthetic(results, study, solver)
        cases = results.table(Cases)
        published = cases[cases["study"].eq(str(study)) & cases["solver"].eq(PUBLISHED)]
        columns = ["case_id", "load_n", "displacement_mm"]
        given = (
            curves,
            published[columns],
            tr("Loading, {study}, {solver}", study=study, solver=solver),
            synthetic,
        )
        alt = tr("Load against displacement, {study}, {solver}", study=study, solver=solver)
        plots.append(plot(alt, synthetic, load_displacement, *given))
    return plots


def _deformed_plots(results: Results) -> list[Plot]:
    outlines = results.table(DeformedTyre)
    if outlines.empty:
        return []
    first = outlines.iloc[0]
    synthetic = _synthetic(results, first["study"], first["solver"])
    case, solver, load = first["case_id"], first["solver"], f"{first['load_n']:g}"
    plots = []
    for near in (False, True):
        title = (
            tr("Spokes at the contact, {case}", case=case)
            if near
            else tr("Loaded tyre, {case}", case=case)
        )
        alt = (
            tr(
                "Outlines of the spokes at the contact under {load} N, {case}, {solver}",
                load=load,
                case=case,
                solver=solver,
            )
            if near
            else tr(
                "Outlines of the tyre under {load} N, {case}, {solver}",
                load=load,
                case=case,
                solver=solver,
            )
        )
        plots.append(plot(alt, synthetic, deformed_tyre, outlines, title, near, synthetic))
    return plots


def _stress_plots(results: Results) -> list[Plot]:
    plots = []
    fiducial = set(fiducial_cases(results))
    for (study, solver), stress in results.table(PlateStress).groupby(
        ["study", "solver"], sort=False
    ):
        worst = stress["case_id"].iloc[int(stress["mises_mpa"].argmax())]
        # where all plates of a study are the fiducial ones, the worst of them is enough
        mine = fiducial & set(stress["case_id"])
        for case_id in [*(mine - {worst} if len(mine) == 1 else ()), worst]:
            rows = stress[stress["case_id"] == case_id]
            synthetic = _synthetic(results, study, solver)
            given = (
                rows,
                tr("Plate stress, {case_id}, {solver}", case_id=case_id, solver=solver),
                synthetic,
            )
            alt = tr(
                "Stress at the plates' faces, {case_id}, {solver}", case_id=case_id, solver=solver
            )
            plots.append(plot(alt, synthetic, plate_faces, *given))
    return plots
