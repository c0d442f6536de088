import argparse
import json
from pathlib import Path

import matplotlib as mpl
import pytest
import yaml
from matplotlib.figure import Figure

from nptcs.commands import deck, fe_calibrate, fe_picture
from nptcs.errors import InputError
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

ROOT = Path(__file__).resolve().parents[3]


def parse(module, *words):
    parser = argparse.ArgumentParser()
    module.register(parser.add_subparsers())
    return parser.parse_args([str(word) for word in words])


@pytest.fixture
def card(tmp_path):
    constants = {
        name: {"value": value, "unit": "MPa", "origin": "assumed", "rule": "table 2"}
        for name, value in PUBLISHED_PLY.items()
    }
    ply = {"name": "cfrp", "synthetic": False, "constants": constants}
    path = tmp_path / "card.json"
    path.write_text(json.dumps({"plies": {"cfrp": ply}, "rubbers": {}}))
    return path


@pytest.fixture
def design(tmp_path):
    path = tmp_path / "design.csv"
    path.write_text("case_id,spacing_mm,thickness_mm,angle_deg\nplate_001,15,1.8,45\n")
    return path


def test_the_deck_takes_the_only_ply_of_the_card_and_says_which(tmp_path, card, design, capsys):
    out = tmp_path / "spoke.inp"
    words = ["deck", design, "plate_001", "-o", out, "--card", card, "--spoke-c10", 2.5]
    arguments = parse(deck, *words)
    assert arguments.run(arguments) == 0
    said = capsys.readouterr().out
    assert f"materials: ply cfrp of {card} (0 of 9 constants measured)" in said


def test_a_value_of_the_design_table_out_of_range_is_refused(tmp_path, card, design):
    design.write_text("case_id,spacing_mm,thickness_mm,angle_deg\nplate_001,15,1.8,450\n")
    words = ["deck", design, "plate_001", "-o", tmp_path / "x.inp", "--card", card]
    arguments = parse(deck, *words, "--spoke-c10", 2.5)
    with pytest.raises(InputError, match="column 'angle_deg': must be between -90 and 90 degrees"):
        arguments.run(arguments)


def test_deck_of_a_case(tmp_path, card, design, capsys):
    out = tmp_path / "spoke.inp"
    words = ["deck", design, "plate_001", "-o", out, "--card", card, "--ply", "cfrp"]
    arguments = parse(deck, *words, "--spoke-c10", 2.5)
    assert arguments.run(arguments) == 0
    assert "\n2.5, " in out.read_text()
    assert "ccx spoke" in capsys.readouterr().out


def test_abaqus_deck_of_a_case(tmp_path, card, design, reader, capsys):
    config = {
        "studies": yaml.safe_load((ROOT / "config" / "small.yaml").read_text())["studies"],
        "tyre": {"spoke_count": 48},
        "solvers": {"abaqus": {"mesh": {"around": 96}, "cpus": 4}},
    }
    (tmp_path / "config.yaml").write_text(yaml.safe_dump(config))
    out = tmp_path / "tyre.inp"
    words = ["deck", design, "plate_001", "-o", out, "--card", card, "--ply", "cfrp"]
    words += ["--solver", "abaqus", "--spoke-c10", 2.5, "--band-c10", 4.5, "--load", 4000]
    arguments = parse(deck, *words, "--config", tmp_path / "config.yaml")
    assert arguments.run(arguments) == 0
    written = reader.read_deck(out.read_text())
    assert sum(name.startswith("SPOKE") for name in written.instances) == 48
    assert len(written.parts["BAND"].elements) == 96 * 31 * 3
    assert reader.material(written, "BAND-RUBBER")["HYPERELASTIC"].data[0][0] == "4.5"
    assert written.named("CLOAD")[0].data[0][2] == "-4000."
    assert "abaqus job=tyre" in capsys.readouterr().out


def test_abaqus_deck_needs_the_bands_rubber(tmp_path, card, design):
    words = ["deck", design, "plate_001", "-o", tmp_path / "x.inp", "--card", card]
    arguments = parse(deck, *words, "--ply", "cfrp", "--solver", "abaqus", "--spoke-c10", 2.5)
    with pytest.raises(InputError, match="shear_band_c10_mpa"):
        arguments.run(arguments)
    assert not (tmp_path / "x.inp").exists()


def test_deck_refuses_a_configuration_that_is_not_yaml(tmp_path, card, design):
    (tmp_path / "none.yaml").write_text("studies: [")
    words = ["deck", design, "plate_001", "-o", tmp_path / "x.inp", "--card", card]
    arguments = parse(deck, *words, "--ply", "cfrp", "--config", tmp_path / "none.yaml")
    with pytest.raises(InputError, match="is not a YAML file"):
        arguments.run(arguments)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"case": "plate_999"}, "0 rows"),
        ({"ply": "glass"}, "does not have this ply"),
        ({"spoke_c10": None}, "spoke_c10_mpa"),
    ],
)
def test_deck_refuses_what_it_cannot_find(tmp_path, card, design, change, message):
    words = ["deck", design, "plate_001", "-o", tmp_path / "x.inp", "--card", card]
    arguments = parse(deck, *words, "--ply", "cfrp", "--spoke-c10", 2.5)
    for name, value in change.items():
        setattr(arguments, name, value)
    with pytest.raises(InputError, match=message):
        arguments.run(arguments)


@pytest.fixture
def tables(tmp_path):
    ten, five = tmp_path / "ten.csv", tmp_path / "five.csv"
    names = "spoke_c10_mpa,tension_stiffness_n_per_mm,compression_stiffness_n_per_mm"
    ten.write_text(names + "\n1,30.2,13.26\n5,132.57,56.04\n")
    five.write_text(
        "case,spacing_mm,thickness_mm,angle_deg,stiffness_n_per_mm\n32,15,1.8,45,263.7\n"
    )
    return ten, five


def test_calibration_reads_its_targets(tables):
    arguments = parse(fe_calibrate, "fe-calibrate", *tables, "--cases", 32)
    problem = fe_calibrate.build_problem(arguments)
    assert [target.compression_n_per_mm for target in problem.spokes] == [13.26, 56.04]
    assert problem.tyres[0].stiffness_n_per_mm == 263.7
    assert problem.tyres[0].values["spoke_c10_mpa"] == 1.04


def test_calibration_refuses_more_than_five_cases_and_unknown_ones(tables):
    with pytest.raises(InputError, match="at most five"):
        fe_calibrate.build_problem(
            parse(fe_calibrate, "fe-calibrate", *tables, "--cases", *range(1, 7))
        )
    with pytest.raises(InputError, match="does not have these rows"):
        fe_calibrate.build_problem(parse(fe_calibrate, "fe-calibrate", *tables, "--cases", 33))


def test_the_picture_of_a_spoke_is_of_the_design_that_was_asked_for(tmp_path, monkeypatch):
    drawn = []

    def draw(model):
        drawn.append(model.design)
        return Figure()

    monkeypatch.setattr("nptcs.fe.output.spoke_picture.spoke_figure", draw)
    out = tmp_path / "spoke.svg"
    words = ["fe-picture", out, "--spoke", "--spacing", 20, "--angle", 30, "--spoke-c10", 2]
    arguments = parse(fe_picture, *words)
    assert arguments.run(arguments) == 0
    assert (drawn[0].plates, drawn[0].angle_deg, drawn[0].c10_mpa) == (11, 30.0, 2.0)
    assert drawn[0].thickness_mm == 1.8
    assert "<svg" in out.read_text()


def test_the_picture_takes_the_card_of_the_last_run_and_its_rubbers(
    tmp_path, monkeypatch, card, capsys
):
    drawn = []

    def draw(model):
        drawn.append(model.design)
        return Figure()

    monkeypatch.setattr("nptcs.fe.output.spoke_picture.spoke_figure", draw)
    monkeypatch.chdir(tmp_path)
    content = json.loads(card.read_text())
    content["plies"]["cfrp"]["constants"]["e1_mpa"] |= {"value": 111000.0, "origin": "measured"}
    content["rubbers"]["soft"] = {
        "name": "soft",
        "synthetic": True,
        "constants": {
            "c10_mpa": {"value": 0.7, "unit": "MPa", "origin": "measured", "rule": "fit"}
        },
        "strain_range": [0.0, 0.15],
    }
    (tmp_path / "results").mkdir()
    (tmp_path / "results/material_card.json").write_text(json.dumps(content))

    with mpl.rc_context({"svg.fonttype": "none"}):
        arguments = parse(fe_picture, "fe-picture", "a.svg", "--spoke", "--spoke-c10", "soft")
        assert arguments.run(arguments) == 0
    assert (drawn[0].ply["e1_mpa"], drawn[0].c10_mpa) == (111000.0, 0.7)
    said = "ply cfrp of results/material_card.json (1 of 9 constants measured)"
    assert said in capsys.readouterr().out
    assert said in Path("a.svg").read_text()

    arguments = parse(fe_picture, "fe-picture", "b.svg", "--spoke", "--card", "published")
    assert arguments.run(arguments) == 0
    assert drawn[1].ply == PUBLISHED_PLY
    assert "materials: table 2 of the paper\n" in capsys.readouterr().out
