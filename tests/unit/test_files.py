"""Records are read back, and a broken one is named with what to do."""

import pytest

from nptcs.errors import InputError
from nptcs.files import read_model, write_model
from nptcs.seal import sealed_object
from nptcs.tables.laboratory.curves import IngestRecord


def test_a_record_is_read_back(tmp_path):
    record = IngestRecord(specimen="T0-1", status="ok", flags=("slipped",))
    write_model(tmp_path / "T0-1.json", record)
    assert read_model(tmp_path / "T0-1.json", IngestRecord) == record


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "does not exist"),
        (b"{", "is not a valid IngestRecord"),
        (b'{"specimen": "T0-1"}', "no checksum"),
        (sealed_object({"specimen": "T0-1"}, "IngestRecord").encode(), "status"),
        (b"\xff\xfe", "is not a valid"),
    ],
)
def test_a_broken_record_is_named(tmp_path, content, message):
    file = tmp_path / "T0-1.json"
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(InputError, match=message) as refusal:
        read_model(file, IngestRecord)
    assert "T0-1.json" in str(refusal.value)
    assert "run snakemake again" in str(refusal.value)
