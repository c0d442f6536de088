"""YAML files that people write: aliases that explode are refused, plain ones are read."""

from __future__ import annotations

import pytest

from nptcs.errors import InputError
from nptcs.yaml_files import read_yaml


def bomb(depth: int) -> str:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    for level in range(1, depth):
        lines.append(f"a{level}: &a{level} [" + ", ".join([f"*a{level - 1}"] * 9) + "]")
    return "\n".join(lines)


@pytest.mark.parametrize("depth", [2, 9, 30])
def test_nested_aliases_are_refused_with_the_line(tmp_path, depth):
    (tmp_path / "a.yaml").write_text(bomb(depth))
    with pytest.raises(InputError, match="alias inside an anchored") as caught:
        read_yaml(tmp_path / "a.yaml")
    assert caught.value.line == 2


@pytest.mark.parametrize(
    ("text", "message"),
    [("a: [1", "not YAML"), ("[" * 5000, "not YAML"), ("x: " + "y" * 1_100_000, "larger than")],
)
def test_what_is_not_yaml_is_refused(tmp_path, text, message):
    (tmp_path / "a.yaml").write_text(text)
    with pytest.raises(InputError, match=message):
        read_yaml(tmp_path / "a.yaml")


def test_a_plain_alias_is_read(tmp_path):
    (tmp_path / "a.yaml").write_text("a: &one [1, 2]\nb: *one\n")
    assert read_yaml(tmp_path / "a.yaml") == {"a": [1, 2], "b": [1, 2]}
