"""Several materials in one sheet: which cards there are, and what check finds before a run."""

from collections.abc import Callable
from typing import Any

import pytest

from nptcs.calibrate.plan import check_materials, plies, ply_of, rubbers
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.config.studies.study import Study
from nptcs.errors import InputError
from nptcs.tables.laboratory.specimens import Specimen

Make = Callable[..., Any]
SETTINGS = CalibrationSettings()


def row(name: str, material: str, test: str, angle: float | None, **fields: Any) -> Specimen:
    return Specimen(
        specimen=name,
        test=test,
        material=material,
        orientation_deg=angle,
        section_area_mm2=10.0,
        force_file=f"{name}.csv",
        **fields,
    )


def ply(material: str) -> list[Specimen]:
    return [
        row(f"{material}-1", material, "tension", 0),
        row(f"{material}-2", material, "tension", 90),
        row(f"{material}-3", material, "shear", 45),
    ]


def study(**fields: Any) -> Study:
    factor = {"name": "spoke_c10_mpa", "label": "C10", "unit": "MPa", "levels": (1.0, 2.0)}
    return Study(name="one", title="One", factors=(factor,), solvers=("fe_tyre",), **fields)


BAND = row("B-1", "band", "rubber_tension", None)


def test_each_complete_composite_has_a_card_and_the_study_names_its_own() -> None:
    sheet = [*ply("cfrp"), *ply("gfrp"), BAND]
    assert plies(sheet, SETTINGS) == ["cfrp", "gfrp"]
    assert rubbers(sheet) == ["band"]
    assert ply_of(study(ply="gfrp"), sheet, SETTINGS) == "gfrp"
    with pytest.raises(InputError, match="study one needs one ply, the sheet has 2") as error:
        ply_of(study(), sheet, SETTINGS)
    assert "cfrp, gfrp" in str(error.value)
    assert ply_of(study(), ply("cfrp"), SETTINGS) == "cfrp"


def test_a_composite_that_lacks_a_test_stops_only_the_study_that_needs_it() -> None:
    sheet = [*ply("cfrp"), *ply("gfrp")[:2]]
    assert plies(sheet, SETTINGS) == ["cfrp"]
    assert ply_of(study(), sheet, SETTINGS) == "cfrp"
    with pytest.raises(InputError, match=r"gfrp lacks g12_mpa: no shear_modulus from shear at 45"):
        ply_of(study(ply="gfrp"), sheet, SETTINGS)
    errors, notes = check_materials([(study(), True)], sheet, SETTINGS)
    assert errors == []
    assert any(note.startswith("no card of ply gfrp: g12_mpa") for note in notes)


def test_a_property_that_no_run_gives_is_missing() -> None:
    sheet = ply("cfrp")
    sheet[0] = row("cfrp-1", "cfrp", "tension", 0, properties=("modulus",))
    with pytest.raises(InputError, match="nu12: no poisson_ratio"):
        ply_of(study(), sheet, SETTINGS)
    sheet.append(row("cfrp-4", "cfrp", "tension", 0, properties=("poisson_ratio",)))
    assert ply_of(study(), sheet, SETTINGS) == "cfrp"


def test_check_finds_rubbers_that_are_named_and_not_tested() -> None:
    named = study(fixed={"shear_band_c10_mpa": {"rubber": "band"}})
    errors, _ = check_materials([(named, False)], [BAND], SETTINGS)
    assert errors == []
    errors, _ = check_materials([(named, False)], ply("cfrp"), SETTINGS)
    assert "names rubber band" in str(errors[0])
    left_out = row("B-1", "band", "rubber_tension", None, properties=("strength",))
    errors, _ = check_materials([(named, False)], [left_out], SETTINGS)
    assert "names rubber band" in str(errors[0])


def test_one_name_for_a_composite_and_a_rubber_is_refused() -> None:
    errors, _ = check_materials([], [*ply("m"), row("R", "m", "rubber_tension", None)], SETTINGS)
    assert "material m has composite and rubber tests" in str(errors[0])
