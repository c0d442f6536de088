"""Scripts stay thin: what they do beyond reading and writing belongs in the package."""

from pathlib import Path

import pytest

SCRIPTS = sorted((Path(__file__).parents[2] / "workflow" / "scripts").glob("*.py"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_is_short_and_unpacks_by_keyword(script):
    text = script.read_text(encoding="utf-8")
    assert text.count("\n") <= 30
    edge = text[text.index('if __name__ == "__main__":') :]
    assert "(**snakemake.params, " in edge
    assert "**snakemake.output)" in edge
    assert "snakemake." not in text[: -len(edge)]
