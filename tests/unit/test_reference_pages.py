"""The generated pages are those of the models and commands as they are."""

import argparse
from pathlib import Path

import pytest

from nptcs.cli import build_parser
from nptcs.commands import schema

ROOT = Path(__file__).parents[2]


def commands_text():
    subparsers = build_parser()._subparsers._group_actions[0]
    assert isinstance(subparsers, argparse._SubParsersAction)
    return schema.commands_text(subparsers)


@pytest.mark.parametrize(
    ("file", "text"),
    [
        (schema.SCHEMA, schema.schema_text),
        (schema.REFERENCE, schema.reference_text),
        (schema.TABLES_PAGE, schema.tables_text),
        (schema.COMMANDS_PAGE, commands_text),
    ],
    ids=["schema", "configuration", "tables", "commands"],
)
def test_page_is_current(file, text):
    assert (ROOT / file).read_text(encoding="utf-8") == text(), "run `nptcs schema`"
