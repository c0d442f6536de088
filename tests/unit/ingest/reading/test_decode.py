"""Encodings: what is declared wins, what is found is explained, numbers never depend on it."""

from __future__ import annotations

import codecs

import pytest

from nptcs.errors import InputError

ROWS = "\r\n".join(f"0,{n}\t{n},5\t0,0{n}" for n in range(1, 9))
TEXTS = {
    "cp1252": "Prüfzeit (s)\tKraft (N)\tDehnung (%)",
    "cp1250": "Czas (s)\tSiła (N)\tOdkształcenie (%)",
    "gb18030": "时间(s)\t力(N)\t应变(%)",
    "cp1251": "Время (s)\tНагрузка (N)\tДеформация (%)",
    "cp932": "時間 (s)\t荷重 (N)\tひずみ (%)",
    "cp949": "시간 (s)\t하중 (N)\t변형률 (%)",
}


@pytest.mark.parametrize("encoding", TEXTS)
def test_eight_bit_encodings_are_recognised_by_known_words(read, encoding):
    table = read(f"{TEXTS[encoding]}\r\n{ROWS}".encode(encoding))
    assert table.encoding == encoding
    assert table.values["force"][0] == pytest.approx(1.5)
    assert any("known words are readable" in note for note in table.notes)


@pytest.mark.parametrize(
    ("encoding", "mark"),
    [
        ("utf-8", codecs.BOM_UTF8),
        ("utf-16-le", codecs.BOM_UTF16_LE),
        ("utf-16-be", codecs.BOM_UTF16_BE),
    ],
)
def test_byte_order_marks(read, encoding, mark):
    table = read(mark + f"{TEXTS['cp1252']}\r\n{ROWS}".encode(encoding))
    assert table.columns["time"] == "Prüfzeit"


def test_wide_text_without_a_mark(read):
    assert read(f"{TEXTS['cp1252']}\r\n{ROWS}".encode("utf-16-le")).columns["time"] == "Prüfzeit"


def test_unknown_words_go_to_the_restricted_detector(read):
    text = f"Größe der Öffnung: für Prüfkörper\r\ntime (s)\tforce (N)\tstrain (%)\r\n{ROWS}"
    table = read(text.encode("cp1252"))
    assert table.encoding in ("cp1252", "cp1250")
    assert table.values["force"][0] == pytest.approx(1.5)


def test_text_damaged_before_us_still_gives_its_numbers(read):
    table = read(f"Pr\ufffdfer: Kh\r\ntime (s)\tforce (N)\tstrain (%)\r\n{ROWS}")
    assert table.values["strain"][0] == pytest.approx(1e-4)


def test_declared_encoding_that_does_not_fit_is_refused(read, profiles):
    own = profiles["plain"].model_copy(update={"encoding": "ascii"})
    with pytest.raises(InputError, match="is not ascii"):
        read(f"{TEXTS['cp1252']}\r\n{ROWS}".encode("cp1252"), declared=own)


def test_the_encoding_with_most_known_words_wins(read):
    """In cp1250 the time would be readable too, the square would not."""
    text = f"Probenquerschnitt\tmm²\r\n{TEXTS['cp1252']}\r\n{ROWS}"
    table = read(text.encode("cp1252"))
    assert table.encoding == "cp1252"
