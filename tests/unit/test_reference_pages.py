"""The generated pages are those of the models as they are."""

from pathlib import Path

import pytest

from nptcs.commands import schema

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    ("file", "text"),
    [
        (schema.SCHEMA, schema.schema_text),
        (schema.REFERENCE, schema.reference_text),
        (schema.TABLES_PAGE, schema.tables_text),
    ],
    ids=["schema", "configuration", "tables"],
)
def test_page_is_current(file, text):
    assert (ROOT / file).read_text(encoding="utf-8") == text(), "run `nptcs schema`"
