"""What a change of a material or a dimension does: finite elements against the response models.

    python benchmarks/uncertainty_elasticities.py [--results results] [--solver fe_tyre_paper]
        [--config config/config.yaml]

Solves the plate study's reference design with one constant changed at a time, and prints the change
of the stiffness next to that of the model through which the uncertainty is propagated: the ply's
constants (5 %; G13 with G12, E3 with E2, ν13 with ν12), both rubbers (2 %), thickness and angle.
Solved designs are kept in the run's record store.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import yaml

from nptcs.config.root import read_config
from nptcs.config.studies.goals import ResponseName
from nptcs.decisions.run import read_solved_studies, solver_run, source_of
from nptcs.tables.laboratory.material_card import PlyCard
from nptcs.uncertainty.source import Materials

CHANGES: dict[str, tuple[str, ...]] = {
    "e1_mpa": ("e1_mpa",),
    "e2_mpa": ("e2_mpa", "e3_mpa"),
    "nu12": ("nu12", "nu13"),
    "g12_mpa": ("g12_mpa", "g13_mpa"),
}
TABLES = {
    "cases": "cases.csv",
    "responses": "tyre_responses.csv",
    "curves": "tyre_curves.csv",
    "statistics": "statistics.csv",
    "errors": "stiffness_errors.csv",
}


def main() -> None:
    """Solve and print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--config", type=Path, default=Path("config/config.yaml"))
    parser.add_argument("--solver", default="fe_tyre_paper")
    given = parser.parse_args()
    config = read_config(yaml.safe_load(given.config.read_text("utf-8")), str(given.config))
    files = {name: str(given.results / "tables" / file) for name, file in TABLES.items()}
    files["card"] = str(given.results / "material_card.json")
    models = sorted(map(str, (given.results / "6_surface" / "models").glob("*.json")))
    finished = read_solved_studies(config, files, models, given.results / "none.csv")
    study = config.study("plate")
    source = source_of(finished, study, given.solver, None)
    store = given.results / "5_solve" / "records"
    run = solver_run(finished, study, given.solver, store, 1)
    cache = str(given.results / "5_solve" / "spokes")
    run = replace(run, options={**run.options, "spoke_cache": cache, "plate_stress": "off"})
    reference = dict(study.reference)

    def solved(design: dict[str, float], ply: PlyCard | None, fixed: dict[str, float]) -> float:
        changed = replace(source, materials=Materials(source.materials.card, ply))
        cases = source.results.cases.assign(**fixed)
        changed = replace(changed, results=replace(source.results, cases=cases))
        table = pd.DataFrame([{"case_id": "changed", **design}])
        (record,), _ = run.solve(changed, table)
        return float(record.result.vertical_stiffness_n_per_mm or np.nan)

    ply = source.materials.ply
    assert ply is not None
    fitted = source.fit(ResponseName("secant_stiffness", "5000 N"))
    pitch = config.tyre.tread_width_mm / config.tyre.plates_across(reference["spacing_mm"])
    point = np.array([[{**reference, "spacing_mm": pitch}[n] for n in fitted.model.factors]])
    base, nominal = solved(reference, ply, {}), fitted.model.value(point, {})[0]
    print(f"reference {base:.4f} N/mm by {given.solver}, {nominal:.4f} by {fitted.surface}\n")
    print("| change | finite elements | model | ratio |\n|---|---|---|---|")

    def line(words: str, truth: float, quantity: str, step: float) -> None:
        said = fitted.model.value(point, {quantity: np.array([step])})[0] - nominal
        print(f"| {words} | {truth - base:+.4f} | {said:+.4f} | {said / (truth - base):.3f} |")

    for name, together in CHANGES.items():
        constants = {
            key: one.model_copy(update={"value": one.value * (1.05 if key in together else 1.0)})
            for key, one in ply.constants.items()
        }
        truth = solved(reference, ply.model_copy(update={"constants": constants}), {})
        line(f"{' and '.join(together)} +5 %", truth, name, 0.05 * ply.constants[name].value)
    for name in ("shear_band_c10_mpa", "spoke_c10_mpa"):
        value = float(source.results.solved[name].iloc[0])
        truth = solved(reference, ply, {name: 1.02 * value})
        line(f"{name} +2 %", truth, name, 0.02 * value)
    for name, step in (("thickness_mm", 0.05), ("angle_deg", 1.0)):
        truth = solved({**reference, name: reference[name] + step}, ply, {})
        line(f"{name} +{step:g}", truth, name, step)


if __name__ == "__main__":
    main()
