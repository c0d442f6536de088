import sys

import numpy as np
import pytest
from pydantic import ValidationError
from small_tyres import COARSE_SPOKE, COARSE_TABLE, VALUES

from nptcs.campaign.record import CaseRecord
from nptcs.config.solvers.abaqus import AbaqusModel
from nptcs.config.solvers.fe import EnergyTableOptions, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.responses import TyreResponseSettings
from nptcs.decks.calculix import complaints
from nptcs.errors import InputError
from nptcs.responses.strength import PlyStrengths
from nptcs.responses.table import tyre_responses
from nptcs.solvers import calculix, fe_spoke, fe_tyre
from nptcs.solvers.contract import SPOKE_RESPONSES, CaseInputs, Status
from nptcs.solvers.registry import model_choices
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

TYRE_OPTIONS = {
    "spoke_mesh": COARSE_SPOKE,
    "table": COARSE_TABLE,
    "tyre_mesh": TyreMesh(gap_elements=1),
}


def inputs(options, values=VALUES, load_n=800.0, ply=PUBLISHED_PLY):
    return CaseInputs("case_1", values, load_n, TyreGeometry(), options, ply=ply)


def neutral_line_is_sound(result, columns):
    """Lowest over the contact, by nearly δ, and moved away from it on both sides."""
    line = {name: np.array(column) for name, column in result.neutral_line.items()}
    theta, radial, along = line["theta_deg"], line["radial_mm"], line["tangential_mm"]
    assert len(theta) == columns
    assert (np.diff(theta) > 0).all()
    assert np.abs(theta).max() <= 180.0
    # the tread between band and ground gives way a little
    assert 0.8 * result.displacement_mm < -radial.min() < result.displacement_mm
    assert abs(theta[radial.argmin()]) < 6.0
    # an inextensible band: u_θ' = -u_r, so that it moves away from the contact on both sides
    middle = np.abs(theta) < 15.0
    slope = np.polyfit(np.radians(theta[middle]), along[middle], 1)[0]
    assert slope == pytest.approx(-radial[middle].mean(), rel=0.15)


def plates_are_sound(result):
    """The largest values are those of the listed faces, and the worst spoke is over the contact."""
    plates, extra = result.plate_stress, result.extra
    assert max(plates["mises_mpa"]) == extra["plate_largest_mises_mpa"] > 0.0
    assert min(plates["along_mpa"]) == extra["plate_smallest_along_mpa"] < 0.0
    assert {0.0} <= set(plates["spoke"]) <= {0.0, 1.0, 2.0, 58.0, 59.0}
    assert extra["smallest_spoke_force_n"] < 0.0 < extra["largest_spoke_force_n"]
    assert extra["mean_pressure_mpa"] < extra["largest_pressure_mpa"]
    width = TyreGeometry().tread_width_mm
    area = extra["contact_length_mm"] * width
    assert extra["mean_pressure_mpa"] * area == pytest.approx(result.curve["force_n"][-1], rel=1e-3)


def test_fe_tyre_goes_on_to_a_displacement_and_says_where_it_ends(tmp_path):
    options = {"spoke_cache": tmp_path, "load_steps": 3, "plate_stress": "off", **TYRE_OPTIONS}
    plain = fe_tyre.solve(inputs(fe_tyre.FeTyreOptions(**options)))
    assert plain.plate_stress is None
    assert "plate_largest_mises_mpa" not in plain.extra
    target = 1.2 * plain.displacement_mm
    further = fe_tyre.solve(inputs(fe_tyre.FeTyreOptions(**options, curve_to_mm=target)))
    assert further.curve["displacement_mm"][-1] >= target
    assert further.displacement_mm == pytest.approx(plain.displacement_mm, rel=1e-9)
    # the same tyre loaded again: nothing of the first time is left in it
    common = len(plain.curve["force_n"])
    assert further.curve["displacement_mm"][:common] == pytest.approx(
        plain.curve["displacement_mm"], rel=1e-7
    )
    assert further.message == ""
    beyond = fe_tyre.solve(inputs(fe_tyre.FeTyreOptions(**options, curve_to_mm=60.0)))
    assert beyond.status is Status.OK
    assert beyond.displacement_mm == pytest.approx(plain.displacement_mm, rel=1e-9)
    assert beyond.message.startswith("60 mm not reached: spoke ")
    assert beyond.curve["displacement_mm"][-1] < 60.0


def test_the_stiffness_at_25_mm_is_that_of_a_tyre_solved_there(tmp_path):
    """The curve goes on from the load of the case; tyres are then solved at loads around 25 mm."""
    soft = {**VALUES, "spoke_c10_mpa": 1.0}
    deep = EnergyTableOptions(elongation_mm=(-32.0, 8.0), inclination_rad=0.22, narrowing=0.6)
    options = {
        "spoke_mesh": COARSE_SPOKE,
        "table": deep,
        "plate_stress": "off",
        "spoke_cache": tmp_path,
    }
    further = fe_tyre.FeTyreOptions(**options, load_steps=5, curve_to_mm=25.0)
    result = fe_tyre.solve(inputs(further, soft, load_n=3000.0))
    assert result.message == ""
    assert result.displacement_mm < 15.0
    case = CaseRecord(
        study="s", case_id="s_001", solver="fe_tyre", solver_version="3", key="k", values=soft,
        load_n=3000.0, wall_time_s=1.0, result=result,
    )  # fmt: skip
    table = tyre_responses([case], TyreResponseSettings(), PlyStrengths())
    at_25 = table[table["at"] == "25 mm"].set_index("response")
    assert list(at_25["status"]) == ["ok", "ok"]
    secant = float(at_25.loc["secant_stiffness", "value"])
    low, high = (
        fe_tyre.solve(
            inputs(fe_tyre.FeTyreOptions(**options, load_steps=3), soft, 25.0 * secant + change)
        ).displacement_mm
        for change in (-50.0, 50.0)
    )
    assert (low + high) / 2.0 == pytest.approx(25.0, rel=1e-3)
    tangent = float(at_25.loc["tangent_stiffness", "value"])
    assert tangent == pytest.approx(100.0 / (high - low), rel=0.02)


def test_fe_tyre_reports_the_secant_of_its_own_curve_and_reuses_spokes(tmp_path):
    # fine enough for the pressure of this short contact
    fine = {**TYRE_OPTIONS, "tyre_mesh": TyreMesh(foot_elements=2, gap_elements=2)}
    options = fe_tyre.FeTyreOptions(spoke_cache=tmp_path, load_steps=3, **fine)
    first = fe_tyre.solve(inputs(options, load_n=3000.0))
    assert first.status is Status.OK
    assert first.curve["force_n"][-1] == pytest.approx(3000.0)
    assert first.curve["displacement_mm"][-1] == pytest.approx(first.displacement_mm)
    assert first.vertical_stiffness_n_per_mm == pytest.approx(3000.0 / first.displacement_mm)
    assert 100.0 < first.vertical_stiffness_n_per_mm < 1500.0
    assert first.extra["smallest_u_r_mm"] > -first.displacement_mm
    neutral_line_is_sound(first, 480)
    plates_are_sound(first)
    files = sorted(tmp_path.iterdir())
    again = fe_tyre.solve(inputs(options, load_n=3000.0))
    assert sorted(tmp_path.iterdir()) == files
    stiffness = first.vertical_stiffness_n_per_mm
    assert again.vertical_stiffness_n_per_mm == pytest.approx(stiffness, rel=1e-9)
    soft = fe_tyre.solve(inputs(options, {**VALUES, "shear_band_c10_mpa": 4.0}, load_n=3000.0))
    assert sorted(tmp_path.iterdir()) == files
    assert soft.vertical_stiffness_n_per_mm < first.vertical_stiffness_n_per_mm


def test_a_tyre_that_leaves_its_table_is_diverged_with_its_last_point(tmp_path):
    narrow = EnergyTableOptions(**{**COARSE_TABLE.model_dump(), "elongation_mm": (-1.0, 5.0)})
    options = fe_tyre.FeTyreOptions(load_steps=3, **{**TYRE_OPTIONS, "table": narrow})
    result = fe_tyre.solve(inputs(options, load_n=5000.0))
    assert result.status is Status.DIVERGED
    assert "outside the table" in result.message
    assert 0.0 < result.curve["force_n"][-1] < 5000.0
    assert result.vertical_stiffness_n_per_mm is None
    assert result.neutral_line is None


def test_fe_spoke_gives_curve_and_lines():
    result = fe_spoke.solve(inputs(fe_spoke.FeSpokeOptions(spoke_mesh=COARSE_SPOKE)))
    assert result.status is Status.OK
    assert len(result.curve["force_n"]) == 57
    assert result.curve["displacement_mm"][0] == -20.0
    extra = result.extra
    assert list(extra) == list(SPOKE_RESPONSES)
    assert extra["tension_stiffness_n_per_mm"] > extra["compression_stiffness_n_per_mm"] > 0.0
    assert extra["tension_r2_centred"] < extra["tension_r2_uncentred"]


@pytest.mark.parametrize("options", [fe_spoke.FeSpokeOptions, calculix.CalculixOptions])
@pytest.mark.parametrize("stray", ["table", "tyre_mesh", "contact", "load_steps"])
def test_a_single_spoke_refuses_what_only_a_tyre_uses(options, stray):
    """An option that changes nothing would still be in the key of a solved case."""
    value = fe_tyre.FeTyreOptions().model_dump()[stray]
    with pytest.raises(ValidationError) as refusal:
        options(**{stray: value})
    assert [(e["type"], e["loc"]) for e in refusal.value.errors()] == [
        ("extra_forbidden", (stray,))
    ]


@pytest.mark.parametrize(
    ("change", "column"),
    [({"spacing_mm": 4.0}, "spacing_mm"), ({"spoke_c10_mpa": -1.0}, "spoke_c10_mpa")],
)
def test_values_without_meaning_are_refused(change, column):
    with pytest.raises(InputError) as caught:
        fe_tyre.solve(inputs(fe_tyre.FeTyreOptions(), {**VALUES, **change}))
    assert caught.value.column == column


def test_missing_values_and_plies_are_refused():
    values = {name: value for name, value in VALUES.items() if name != "angle_deg"}
    with pytest.raises(InputError, match="angle_deg"):
        fe_spoke.solve(inputs(fe_spoke.FeSpokeOptions(), values))
    with pytest.raises(InputError, match="g23_mpa"):
        fe_spoke.solve(inputs(fe_spoke.FeSpokeOptions(), ply={"e1_mpa": 1.0}))


def fake_ccx(tmp_path, body):
    script = tmp_path / "fake.py"
    script.write_text(f"import sys, time, pathlib\n{body}\n")
    return (sys.executable, str(script))


def calculix_case(tmp_path, body, **options):
    command = fake_ccx(tmp_path, body)
    chosen = calculix.CalculixOptions(spoke_mesh=COARSE_SPOKE, command=command, **options)
    return calculix.solve(inputs(chosen))


@pytest.mark.parametrize("options", [calculix.CalculixOptions, AbaqusModel])
def test_a_layer_that_the_mesh_does_not_have_is_refused(options):
    with pytest.raises(ValidationError, match="plate_layer_mm has no effect"):
        options(geometry={"plate_layer_mm": 0.8})
    assert options(geometry={"plate_layer_mm": 1.0}).geometry.plate_layer_mm == 1.0


def test_a_warning_of_calculix_is_fatal(tmp_path):
    result = calculix_case(tmp_path, "print('*WARNING reading *EMBEDDED: card ignored')")
    assert result.status is Status.ERROR
    assert "card ignored" in result.message


def test_calculix_that_stops_early_hangs_or_is_missing_has_a_status(tmp_path):
    early = calculix_case(tmp_path, "print('increment size too small'); sys.exit(3)")
    assert (early.status, "code 3" in early.message) == (Status.DIVERGED, True)
    assert early.message.endswith("after 0 of 8 steps: increment size too small")
    assert calculix_case(tmp_path, "time.sleep(20)", timeout_s=0.5).status is Status.TIMEOUT
    missing = calculix.CalculixOptions(command=("no-such-ccx",))
    assert calculix.solve(inputs(missing)).status is Status.ERROR


def test_calculix_that_gets_no_further_keeps_the_steps_before(tmp_path):
    """The words are those of CalculiX 2.20 at the end of a spoke pressed too far."""
    body = (
        "text = ''\n"
        "for u in (1, 2, 3, 4, -5):\n"
        "    text += ' total force (fx,fy,fz) for set NTOP and time 1.\\n\\n'\n"
        "    text += f' 0.0E+00 0.0E+00 {2.0 * u:.6E}\\n'\n"
        "pathlib.Path(sys.argv[1] + '.dat').write_text(text)\n"
        "print('\\n *ERROR: increment size smaller than minimum')\n"
        "print(' best solution and residuals are in the frd file'); sys.exit(201)"
    )
    result = calculix_case(tmp_path, body)
    assert result.status is Status.DIVERGED
    assert "increment size smaller than minimum" in result.message
    assert result.curve["displacement_mm"] == [-5.0, 0.0, 1.0, 2.0, 3.0, 4.0]
    assert result.curve["force_n"] == pytest.approx([30.0 * u for u in (-5, 0, 1, 2, 3, 4)])


@pytest.mark.parametrize(("code", "left"), [(201, ""), (0, ""), (201, "\\n S T E P  1\\n\\n")])
def test_calculix_that_fails_in_its_first_step_is_quoted(tmp_path, code, left):
    """CalculiX opens its result file before the first step, so that it is there without forces."""
    body = (
        f"pathlib.Path(sys.argv[1] + '.dat').write_text('{left}')\n"
        f"print('divergence; the increment is reattempted'); sys.exit({code})"
    )
    result = calculix_case(tmp_path, body)
    assert result.status is Status.DIVERGED
    assert f"ended with code {code} after 0 of 8 steps" in result.message
    assert result.message.endswith("divergence; the increment is reattempted")


def test_calculix_results_are_scaled_to_the_whole_spoke(tmp_path):
    body = (
        "assert 'C3D20R' in pathlib.Path(sys.argv[1] + '.inp').read_text()\n"
        "text = ''\n"
        "for u in (1, 2, 3, 4, -5, -10, -15, -20):\n"
        "    text += ' total force (fx,fy,fz) for set NTOP and time 1.\\n\\n'\n"
        "    text += f' 0.0E+00 0.0E+00 {2.0 * u:.6E}\\n'\n"
        "pathlib.Path(sys.argv[1] + '.dat').write_text(text)"
    )
    result = calculix_case(tmp_path, body)
    assert result.status is Status.OK
    wanted = 2.0 * 15  # plates of a leg, table 4
    assert result.extra["tension_stiffness_n_per_mm"] == pytest.approx(wanted)
    assert result.extra["compression_stiffness_n_per_mm"] == pytest.approx(wanted)
    assert list(result.extra) == list(SPOKE_RESPONSES)
    assert result.extra["compression_r2_centred"] == pytest.approx(1.0)


def test_complaints_are_found_at_the_start_of_a_line():
    assert complaints("all well\n no *WARNING here\n") == ""
    assert "*ERROR" in complaints("x\n *ERROR in gen3delem\n stop\n")


def test_the_choice_between_models_is_reported():
    options = fe_tyre.SOLVER.options(plate_coupling="conforming", timeout_s=10)
    told = {
        "ring": "converged",
        "axial": "free_edges",
        "plate_coupling": "conforming",
        "plate_stress": "all",
    }
    assert model_choices(options) == told
