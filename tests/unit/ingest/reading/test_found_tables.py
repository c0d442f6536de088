"""Headers, blocks, phantom columns, side-by-side tests, cut and broken rows."""

from __future__ import annotations

import pytest

from nptcs.errors import InputError

BODY = [f"0.{n},{n}.5,0.0{n}" for n in range(1, 9)]
NAMES = "time_s,force_N,strain_%"


@pytest.mark.parametrize("lines", [0, 1, 5, 24])
def test_header_blocks_of_any_length(read, lines):
    head = [f"Key {n}: value,12.5,mm" for n in range(lines)]
    table = read("\n".join([*head, NAMES, *BODY]))
    assert table.header_line == lines + 1
    assert table.first_line == lines + 2
    assert table.rows == 8


def test_time_need_not_come_first(read):
    lines = ["strain_%,force_N,time_s", *(f"0.0{n},{n}.5,0.{n}" for n in range(1, 9))]
    assert read("\n".join(lines)).values["time"][0] == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("names", "units"),
    [
        ("Time [s],Force [kN],Strain [%]", None),
        ("Time (s),Force (kN),Strain (%)", None),
        ("Time / s,Force / kN,Strain / %", None),
        ("Time in s,Force in kN,Strain in %", None),
        ("Time,Force,Strain", "s,kN,%"),
        ("Time,Force,Strain", "(s),(kN),(%)"),
        ("Time,Force,Strain", "[s],[KN],[%]"),
    ],
)
def test_units_in_names_or_in_a_row(read, names, units):
    table = read("\n".join([names, *([units] if units else []), *BODY]))
    assert table.values["force"][0] == pytest.approx(1500)
    assert table.values["strain"][0] == pytest.approx(1e-4)


def test_absent_unit_is_refused_with_the_choices(read):
    with pytest.raises(InputError, match=r"no unit for force.*N, kN") as caught:
        read("\n".join(["time_s,force,strain_%", *BODY]))
    assert (caught.value.line, caught.value.column) == (1, "force")


def test_unit_of_another_quantity_is_refused(read):
    with pytest.raises(InputError, match="not a unit of force"):
        read("\n".join(["time_s,force [mm],strain_%", *BODY]))


def test_millinewton_is_not_meganewton(read):
    table = read("\n".join(["time_s,force [mN],strain_%", *BODY]))
    assert table.values["force"][0] == pytest.approx(0.0015)
    with pytest.raises(InputError, match="not a unit of force"):
        read("\n".join(["time_s,force [Mn],strain_%", *BODY]))


def test_two_blocks_of_which_one_is_a_test(read):
    second = ["", "Peak,force_N,travel_mm", "1,2.5,3.0", "2,3.5,4.0"]
    assert read("\n".join([NAMES, *BODY, *second])).rows == 8


def test_two_tests_in_one_file_need_a_part(read):
    text = "\n".join([NAMES, *BODY, "", NAMES, *BODY[:6]])
    with pytest.raises(InputError, match="holds 2 tests.*'1', '2'"):
        read(text)
    assert read(text, part="2").rows == 6
    with pytest.raises(InputError, match="no table of that name"):
        read(text, part="3")


def repeated_columns(head):
    rows = []
    for n in range(1, 9):
        third = f"0.{n};{3 * n}.5;0.0{n}" if n < 7 else ";;"
        rows.append(f"0.{n};{n}.5;0.0{n};0.{n};{2 * n}.5;0.0{n};{third}")
    return "\n".join([*head, *rows])


def test_tests_side_by_side_of_unequal_length(read):
    text = repeated_columns([";".join(["time (s);force (N);strain (%)"] * 3)])
    with pytest.raises(InputError, match="holds 3 tests"):
        read(text)
    table = read(text, part="3")
    assert table.values["force"] == pytest.approx([3 * n + 0.5 for n in range(1, 7)])


def test_tests_side_by_side_are_matched_by_specimen_id_not_by_order(read):
    head = ["B-11;;;B-1;;;B-2;;", ";".join(["time (s);force (N);strain (%)"] * 3)]
    table = read(repeated_columns(head), specimen="B-1")
    assert table.values["force"][0] == pytest.approx(2.5)


def test_phantom_last_column_is_left_out(read):
    table = read("\n".join([NAMES, *(f"{row}," for row in BODY)]))
    assert table.values["strain"][0] == pytest.approx(1e-4)


def test_column_of_numbers_without_a_name_is_refused(read, profiles):
    text = "\n".join([NAMES, *(f"{n},{row}" for n, row in enumerate(BODY))])
    with pytest.raises(InputError, match="4 columns, but 3 names"):
        read(text)
    own = profiles["plain"].model_copy(update={"unnamed_columns": "first"})
    assert read(text, declared=own).values["force"][0] == pytest.approx(1.5)


def test_last_line_cut_off_is_dropped_and_reported(read):
    table = read("\n".join([NAMES, *BODY, "0.9,9."]))
    assert table.rows == 8
    assert any("cut off" in note for note in table.notes)


def test_short_row_in_the_middle_is_an_error(read):
    rows = [*BODY[:4], "0.5,5.5", *BODY[5:]]
    with pytest.raises(InputError) as caught:
        read("\n".join([NAMES, *rows]))
    assert caught.value.line == 6


def test_broken_row_in_the_middle_is_an_error(read):
    rows = [*BODY[:5], "0.x,err or,0.06", *BODY[5:]]
    with pytest.raises(InputError, match="does not consist of numbers") as caught:
        read("\n".join([NAMES, *rows]))
    assert caught.value.line == 7


def test_blank_rows_and_remarks_inside_a_table_are_noted(read):
    rows = [*BODY[:5], "", ",,", "Extensometer removed,,", *BODY[5:]]
    table = read("\n".join([NAMES, *rows]))
    assert table.rows == 8
    assert any("Extensometer removed" in note for note in table.notes)


def test_table_without_names_needs_an_order(read, profiles):
    text = "\r\n".join(f"    {n}.0925    1.{n}270" for n in range(1, 8))
    with pytest.raises(InputError, match="no names"):
        read(text)
    own = profiles["plain"].model_copy(
        update={
            "columns_in_order": ("stress", "stretch"),
            "units": {"stress": "MPa", "stretch": "1"},
        }
    )
    table = read(text, declared=own)
    assert table.values["stress"][0] == pytest.approx(1.0925)
    assert table.values["stretch"][0] == pytest.approx(1.127)


def test_unclosed_quote_does_not_swallow_rows(read):
    rows = [*BODY[:4], '0.5,"5.5,0.05', *BODY[5:]]
    with pytest.raises(InputError):
        read("\n".join([NAMES, *rows]))


def test_text_column_next_to_the_numbers(read):
    lines = [f"{NAMES},name", f"{BODY[0]},A-1", *(f"{row}," for row in BODY[1:])]
    assert read("\n".join(lines)).rows == 8


def test_two_columns_that_fit_one_name_are_refused(read, profiles):
    own = profiles["plain"].model_copy(
        update={"columns": {"force": ("force*",), "strain": ("strain",)}}
    )
    lines = ["force a (N),force b (N),strain (%)", *BODY]
    with pytest.raises(InputError, match="fits several columns"):
        read("\n".join(lines), declared=own)


def test_results_only_export_is_explained(read):
    with pytest.raises(InputError, match="no table of numbers"):
        read("Specimen,Modulus\nA-1,128 GPa\n")


@pytest.mark.parametrize("content", [b"", b"  \n\n", b"\x00\x01\x02\x03" * 50])
def test_empty_and_binary_files(read, content):
    with pytest.raises(InputError, match="empty|binary"):
        read(content)


def test_table_that_continues_below_junk_is_refused(read):
    rows = [*BODY, "Error,Sensor,overload", *BODY]
    with pytest.raises(InputError, match="seems to go on in line 11"):
        read("\n".join([NAMES, *rows]))
    assert read("\n".join([NAMES, *rows]), part="1").rows == 8


def test_unit_of_the_profile_is_reported(read, profiles):
    own = profiles["plain"].model_copy(update={"units": {"force": "kN"}})
    table = read("\n".join(["time_s,force,strain_%", *BODY]), declared=own)
    assert table.values["force"][0] == pytest.approx(1500)
    assert "force: no unit in the file, 'kN' by profile 'plain'" in table.notes
