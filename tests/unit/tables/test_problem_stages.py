"""Every stage that a problem names is one that the table of problems allows."""

import re
from pathlib import Path

import nptcs
from nptcs.tables.problems import STAGES, Problems, problems_table

NAMED = re.compile(r'(?:problems|refused)\b[^\n]*?\(\(?"(\w+)",')


def test_each_stage_that_the_package_names_is_known():
    texts = [file.read_text("utf-8") for file in Path(nptcs.__file__).parent.rglob("*.py")]
    found = {stage for text in texts for stage in NAMED.findall(text)}
    assert {"uncertainty", "decision", "reduce"} <= found
    assert found <= set(STAGES)


def test_the_contract_allows_every_stage():
    rows = [(stage, "plate", "fe_tyre", "refused", "a reason") for stage in STAGES]
    assert len(Problems.validate(problems_table(rows))) == len(STAGES)
