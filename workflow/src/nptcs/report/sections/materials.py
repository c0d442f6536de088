"""Section of the report on the material card."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from nptcs.arrays import Array
from nptcs.calibrate.fit import HyperelasticModel
from nptcs.calibrate.models import model_named
from nptcs.language import tr
from nptcs.report.blocks import Listing, PageBlock, Plot, Plots, Section
from nptcs.report.data import Results
from nptcs.report.figures.materials import c10_against_range, hyperelastic_fit
from nptcs.report.plots import plot
from nptcs.report.sections.key_facts import material_facts
from nptcs.report.table_view import sheet_view
from nptcs.report.tables import entries
from nptcs.report.tables.checks import WARNING, check_text
from nptcs.report.tables.headings import words
from nptcs.report.tables.sheets import Sheets, sheet_of
from nptcs.tables.laboratory.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.laboratory.material_card import PUBLISHED_C10_MPA, RubberCard
from nptcs.tables.result_table import ReportSection


def materials_section(results: Results, sheets: Sheets) -> Section:
    """Build the section."""
    blocks: list[PageBlock] = [
        *material_facts(results),
        sheet_view(sheets[entries.PLY.sheet]),
        sheet_view(sheets[entries.RUBBERS.sheet]),
    ]
    checks = [(card.name, check) for card in results.cards for check in card.checks]
    for lead, warns in (
        (tr("What the checks of the card warn of"), True),
        (tr("What the checks of the card found"), False),
    ):
        lines = [
            f"{name}: {check_text(check)}"
            for name, check in checks
            if check.startswith(WARNING) == warns
        ]
        if lines:
            blocks.append(Listing(lead, tuple(lines), "warn" if warns else ""))
    blocks += [
        Plots(
            tr(
                "The rubbers' tests and their models (figure 5 of the paper): the model within "
                "the range of its fit (full line) and beyond it (dotted); squares: the "
                "neo-Hookean model with the C10 printed in the paper. Last panel: how C10 "
                "depends on that range."
            ),
            (*_fit_plots(results), *_range_plot(results)),
        ),
        sheet_view(sheet_of(sheets, ModelComparison)),
        sheet_view(sheet_of(sheets, RangeTable)),
    ]
    synthetic = results.plies_synthetic or results.rubbers_synthetic
    return Section(ReportSection.MATERIALS, tr("Materials"), tuple(blocks), synthetic)


def _fit_plots(results: Results) -> list[Plot]:
    """Draw one panel for each rubber and kind of test that its card rests on."""
    return [
        plot for rubber in results.card.rubbers.values() for plot in _fit_plots_of(results, rubber)
    ]


def _fit_plots_of(results: Results, rubber: RubberCard) -> list[Plot]:
    settings = results.config.calibration.rubber
    model = model_named(settings.model, settings.ogden_terms)
    constants = np.array([quantity.value for quantity in rubber.constants.values()])
    used = {name for quantity in rubber.constants.values() for name in quantity.specimens}
    values = ", ".join(
        f"{words(name.removesuffix('_mpa'))} = {quantity.value:.4g} {quantity.unit}".rstrip(" 1")
        for name, quantity in rubber.constants.items()
    )
    modes: dict[str, list[str]] = {}
    for specimen in results.sheet:
        if specimen.specimen in used:
            modes.setdefault(specimen.test.value, []).append(specimen.specimen)
    plots = []
    for mode, names in modes.items():
        alt = tr(
            "Stress over strain of {name} and its {model} fit",
            name=rubber.name,
            model=words(rubber.model),
        )
        drawn = plot(
            alt,
            rubber.synthetic,
            hyperelastic_fit,
            f"{rubber.name}, {words(mode.removeprefix('rubber_'))}",
            {name: results.curves[name] for name in names},
            partial(_stress, model, mode, constants),
            f"{words(rubber.model)}\n{values}",
            rubber.strain_range,
            rubber.synthetic,
            PUBLISHED_C10_MPA.get(rubber.name, math.nan),
        )
        plots.append(drawn)
    return plots


def _stress(model: HyperelasticModel, mode: str, constants: Array, stretch: Array) -> Array:
    return model.stress(mode, stretch, constants)


def _range_plot(results: Results) -> list[Plot]:
    ranges = results.table(RangeTable)
    joint = ranges[ranges["specimen"] == "all"]
    if joint.empty:
        return []
    synthetic = results.rubbers_synthetic
    alt = tr("C10 of each rubber over the strain range of its fit")
    return [plot(alt, synthetic, c10_against_range, joint, synthetic)]
