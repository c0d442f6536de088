"""Channels that differ in a number or a place only: read where they are clear, else refused."""

from __future__ import annotations

import pytest

from nptcs.errors import InputError


def table(*names: str) -> str:
    rows = (
        ",".join(f"{(place + 1) * row:g}" for place in range(len(names))) for row in range(1, 13)
    )
    return "\n".join([",".join(names), *rows])


@pytest.mark.parametrize(
    "names",
    [
        ("Load1 (kN)", "Load2 (kN)", "Strain (%)"),
        ("C_1_Force_Filtered (kN)", "C_2_Force_Filtered (kN)", "Strain (%)"),
        ("Load_Raw (kN)", "Load_Filtered (kN)", "Strain (%)"),
        ("Load (kN)", "SG1 (µm/m)", "SG2 (µm/m)"),
        ("Load (kN)", "Strain gauge 1 (%)", "Strain gauge 2 (%)"),
    ],
)
def test_two_alike_are_refused_with_their_names(read, names):
    with pytest.raises(InputError, match="fits several columns") as refused:
        read(table(*names))
    alike = [
        name.split(" (")[0] for name in names if refused.value.message.count(name.split(" (")[0])
    ]
    assert len(alike) == 2


@pytest.mark.parametrize(
    "name", ["SG1 (µm/m)", "SG (µm/m)", "sg 2 (µm/m)", "Strain gauge 1 (µm/m)"]
)
def test_a_lone_gauge_is_the_strain(read, name):
    assert read(table("Load (kN)", name)).values["strain"][0] == pytest.approx(2e-6)


def test_gauges_whose_names_say_the_face_are_both_read(read):
    found = read(table("Load (kN)", "SG front (µm/m)", "SG back (µm/m)")).values
    assert found["strain"][0] == pytest.approx(2e-6)
    assert found["strain_back"][0] == pytest.approx(3e-6)


def test_an_lvdt_is_a_travel(read):
    assert read(table("Load (kN)", "LVDT (mm)")).values["displacement"][0] == 2.0


def test_two_lvdts_next_to_a_strain_do_not_matter(read):
    found = read(table("Load (kN)", "Strain (%)", "LVDT1 (mm)", "LVDT2 (mm)"))
    assert set(found.values) == {"force", "strain"}


@pytest.mark.parametrize("name", ["0x10", "X2", "Y-1", "Mean 3 frame"])
def test_a_channel_is_not_a_coordinate_or_counter_by_its_letters_alone(read, name):
    found = read(table("Time (s)", f"{name} (kN)", "Load (kN)", "Strain (%)"))
    assert set(found.columns) == {"time", "force", "strain"}
