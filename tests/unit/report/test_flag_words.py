"""Flags of the tables are written in the language of the page, with the same numbers."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

import nptcs
from nptcs.language import language
from nptcs.report.tables import checks
from nptcs.report.words import messages as stage_messages
from nptcs.report.words.flags import SENTENCES, flag_text, pattern

ROOT = Path(nptcs.__file__).parent


ROOMS = ("ingest", "reduce", "calibrate", "responses", "solvers", "campaign", "surface")
ROOMS += ("uncertainty", "decisions", "design", "fe", "ring", "lca", "loading", "bending.py")


@cache
def sentences_of_stages():
    """Return the texts that the stages make, as patterns whose values are unknown."""
    found = []
    for room in map(ROOT.joinpath, ROOMS):
        for file in [room] if room.suffix else sorted(room.rglob("*.py")):
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
                if isinstance(node, ast.JoinedStr):
                    parts = (
                        part.value if isinstance(part, ast.Constant) else "1"
                        for part in node.values
                    )
                    found.append("".join(map(str, parts)))
                elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                    found.append(node.value)
    # a list of names follows a colon, outside of the text; the page takes parts one by one
    whole = {text + "1" if text.endswith(": ") else text for text in found}
    parts = whole.union(*(text.split("; ") for text in whole))
    return parts.union(text.removeprefix("warning: ").removeprefix("1: ") for text in parts)


@pytest.mark.parametrize("sentence", [*SENTENCES, *stage_messages.SENTENCES, *checks.SENTENCES])
def test_a_stage_writes_each_sentence(sentence):
    forms = {sentence, sentence.removeprefix("crosshead strain: ")}
    assert any(pattern(form).fullmatch(text) for form in forms for text in sentences_of_stages())


@pytest.mark.parametrize(
    ("flag", "chinese"),
    [
        (
            "failure after 0.948 to 0.983 min, ASTM D3039 requires 1 to 10 min",
            "0.948 至 0.983 min 后破坏，ASTM D3039 要求 1 至 10 min",
        ),
        ("not assessed: the curve reaches 136.4 to 146.7 %", "未评估：曲线只到 136.4 至 146.7 %"),
        (
            "width 14.2 mm, ASTM D3039 recommends 15 to 25 mm; width measured at 1 of 3 stations",
            "宽度 14.2 mm，ASTM D3039 推荐 15 至 25 mm; 宽度只在 3 个位置中的 1 个测量",
        ),
        (
            "another remark; not assessed: no transverse strain",
            "another remark; 未评估：没有横向应变",
        ),
        ("another remark", "another remark"),
        ("of the contact's points", "接触各点中的最大值"),
        ("radial, positive in tension", "径向，受拉为正"),
        ("equal variances p = 0.82; equal means p = 0.38", "方差相等 p = 0.82; 均值相等 p = 0.38"),
        ("", ""),
    ],
)
def test_a_flag_has_its_numbers_in_both_languages(flag, chinese):
    assert flag_text(flag) == flag
    with language("zh"):
        written = flag_text(flag)
    assert written == chinese
    numbers = re.compile(r"\d[\d.]*")
    assert sorted(numbers.findall(written)) == sorted(numbers.findall(flag))


def test_a_message_keeps_place_and_value_and_has_its_remedy_translated():
    written = "case plate_001: must be positive (value: -1.5). Remedy: give a number above zero"
    message_text = stage_messages.message_text
    assert message_text(written) == written
    with language("zh"):
        chinese = message_text(written)
        assert chinese == "case plate_001: 必须为正（值：-1.5）。处理办法：给出大于零的数值"
        assert message_text("a message of another solver") == "a message of another solver"
        assert message_text("not assessed: no transverse strain") == "未评估：没有横向应变"
