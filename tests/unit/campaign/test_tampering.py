"""Stored values that were damaged or edited are not believed: solved again, or a clear error.

Most rows of the tables below were once accepted without a word; some ended in a traceback.
"""

import json

import pytest

from nptcs.campaign.record import CaseJob, RecordStore, make_record, read_records, write_records
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.files import read_model, write_model
from nptcs.seal import SEAL, sealed_object
from nptcs.solvers.contract import SolverResult
from nptcs.surface.stored import read_surfaces
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.material_card import CardConstant, PlyCard, RubberCard

STIFFNESS = 612.25


def job(number):
    return CaseJob(
        study="s",
        case_id=f"s_{number:03d}",
        solver="stub",
        solver_version="1",
        module="stub.py",
        code="0",
        values={"spacing_mm": float(number)},
        load_n=5000.0,
        tyre=TyreGeometry().model_dump(),
        ply=None,
        options={"timeout_s": 2.0},
        without_effect=("timeout_s",),
        tables={},
    )


def record(number):
    result = SolverResult(
        status="ok",
        vertical_stiffness_n_per_mm=STIFFNESS + number,
        displacement_mm=8.125,
        curve={"displacement_mm": [0.0, 8.125], "force_n": [0.0, 5000.0]},
    )
    return make_record(job(number), result, 1.5)


def without_seal(text):
    content = json.loads(text)
    del content[SEAL]
    return json.dumps(content)


def resealed(**changes):
    """A record with a sound checksum and a result that no solver can have given."""

    def change(text):
        content = json.loads(without_seal(text))
        content["result"].update(changes)
        return sealed_object(content, "CaseRecord")

    return change


def of_version(version):
    def change(text):
        content = json.loads(text)
        content[SEAL]["version"] = version
        return json.dumps(content)

    return change


TAMPERED_RECORD = {
    "stiffness edited": lambda text: text.replace("613.25", "713.25"),
    "NaN as a value": lambda text: text.replace("613.25", "NaN"),
    "infinite value": lambda text: text.replace("613.25", "1e999"),
    "curve one point short": lambda text: text.replace("0.0,\n    8.125", "8.125"),
    "a key twice": lambda text: text.replace('"displacement_mm"', '"displacement_mm": 1, "x"', 1),
    "of another case": lambda text: text.replace('"spacing_mm": 1.0', '"spacing_mm": 2.0'),
    "ok without a stiffness": resealed(vertical_stiffness_n_per_mm=None),
    "curve of unequal columns": resealed(curve={"displacement_mm": [0.0], "force_n": []}),
    "without a checksum": without_seal,
    "older format": of_version(0),
    "newer format": of_version(99),
    "cut off": lambda text: text[: len(text) // 2],
    "empty": lambda text: "",
    "nested deeply": lambda text: "[" * 100_000,
    "a list": lambda text: "[]",
    "text after its end": lambda text: text + "{}",
}


@pytest.fixture
def store(tmp_path):
    store = RecordStore(tmp_path / "records")
    store.write(record(1))
    return store


def test_a_sound_record_is_reused_and_blanks_do_not_matter(store):
    assert store.read(job(1)) == record(1)
    file = store.path(job(1).key)
    file.write_text(json.dumps(json.loads(file.read_text())), encoding="utf-8")
    assert store.read(job(1)) == record(1)


@pytest.mark.parametrize("tamper", TAMPERED_RECORD.values(), ids=TAMPERED_RECORD)
def test_a_tampered_record_is_a_miss(store, tamper):
    file = store.path(job(1).key)
    before = file.read_text(encoding="utf-8")
    file.write_text(tamper(before), encoding="utf-8")
    assert file.read_text(encoding="utf-8") != before
    assert store.read(job(1)) is None


def test_the_record_of_another_case_under_this_name_is_a_miss(store):
    store.write(record(2))
    store.path(job(1).key).write_bytes(store.path(job(2).key).read_bytes())
    assert store.read(job(1)) is None


def lines(change):
    """Change the lines of a batch file."""
    return lambda text: "".join(f"{line}\n" for line in change(text.splitlines()))


TAMPERED_BATCH = {
    "line lost": lines(lambda all_lines: all_lines[1:]),
    "line doubled": lines(lambda all_lines: [all_lines[0], *all_lines]),
    "lines exchanged": lines(lambda all_lines: [all_lines[1], all_lines[0], *all_lines[2:]]),
    "stiffness edited": lambda text: text.replace("613.25", "713.25"),
    "NaN as a value": lambda text: text.replace("613.25", "NaN"),
    "checksum lost": lines(lambda all_lines: all_lines[:-1]),
    "checksum twice": lines(lambda all_lines: [*all_lines, all_lines[-1]]),
    "two files joined": lambda text: text + text,
    "cut off in a line": lambda text: text[: len(text) // 2],
    "empty": lambda text: "",
    "nested deeply": lambda text: "[" * 100_000,
}


@pytest.mark.parametrize("tamper", TAMPERED_BATCH.values(), ids=TAMPERED_BATCH)
def test_a_tampered_batch_file_is_an_error_with_its_name_and_a_remedy(tmp_path, tamper):
    file = tmp_path / "batch_1.jsonl"
    write_records(file, [record(1), record(2), record(3)])
    assert read_records([str(file)]) == [record(1), record(2), record(3)]

    file.write_text(tamper(file.read_text(encoding="utf-8")), encoding="utf-8")

    with pytest.raises(InputError, match="cannot be used") as refusal:
        read_records([str(file)])
    assert "batch_1.jsonl" in str(refusal.value)
    assert "delete this file" in refusal.value.remedy


def test_a_batch_without_cases_is_sound(tmp_path):
    write_records(tmp_path / "batch_2.jsonl", [])
    assert read_records([str(tmp_path / "batch_2.jsonl")]) == []


CARDS = [
    PlyCard(
        name="cfrp",
        synthetic=False,
        constants={
            "e1_mpa": CardConstant(value=613.25, unit="MPa", origin="measured", rule="ASTM")
        },
    ),
    RubberCard(
        name="rubber_µ",
        synthetic=True,
        constants={
            "c10_mpa": CardConstant(value=613.25, unit="MPa", origin="assumed", rule="ours")
        },
        strain_range=(0.0, 0.5),
    ),
    IngestRecord(specimen="T0-1", status="ok", flags=("613.25",)),
]

TAMPERED_CARD = {
    "value edited": lambda text: text.replace("613.25", "713.25"),
    "without a checksum": without_seal,
    "cut off": lambda text: text[:-10],
    "empty": lambda text: "",
    "nested deeply": lambda text: '{"a":' * 100_000,
}


@pytest.mark.parametrize("tamper", TAMPERED_CARD.values(), ids=TAMPERED_CARD)
@pytest.mark.parametrize("card", CARDS, ids=lambda card: type(card).__name__)
def test_a_tampered_card_is_an_error(tmp_path, card, tamper):
    file = tmp_path / "card.json"
    write_model(file, card)
    assert read_model(file, type(card)) == card
    file.write_text(tamper(file.read_text(encoding="utf-8")), encoding="utf-8")
    with pytest.raises(InputError, match="not a valid"):
        read_model(file, type(card))


def test_a_card_that_a_user_wrote_is_accepted_only_where_one_may(tmp_path):
    file = tmp_path / "card.json"
    file.write_text(CARDS[0].model_dump_json(), encoding="utf-8")
    assert read_model(file, PlyCard, by_hand=True) == CARDS[0]
    write_model(file, CARDS[0])
    file.write_text(file.read_text(encoding="utf-8").replace("613", "614"), encoding="utf-8")
    with pytest.raises(InputError, match="checksum"):
        read_model(file, PlyCard, by_hand=True)


@pytest.mark.parametrize("tamper", TAMPERED_CARD.values(), ids=TAMPERED_CARD)
def test_tampered_surfaces_are_an_error(tmp_path, tamper):
    file = tmp_path / "plate.json"
    text = sealed_object({"published": {"coefficients_natural": [613.25]}}, "Surfaces")
    file.write_text(tamper(text), encoding="utf-8")
    with pytest.raises(InputError, match="surfaces cannot be used"):
        read_surfaces(file)


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_a_result_that_is_not_a_number_cannot_be_ok(value):
    with pytest.raises(ValueError, match="finite"):
        SolverResult(status="ok", vertical_stiffness_n_per_mm=value, displacement_mm=1.0)
    with pytest.raises(ValueError, match="finite"):
        SolverResult(status="ok", extra={"margin": value})
