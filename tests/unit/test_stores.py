"""Whatever the package stores for itself carries a checksum and the version of its format.

A new store is written by `nptcs.files.write_model`, `write_sealed` or `nptcs.seal.sealed_lines`
(arrays: `nptcs.fe.spoke.stored.write_arrays`), and its kind is a key of `nptcs.seal.FORMATS`.
"""

import ast
from pathlib import Path

import pytest

import nptcs
from nptcs.errors import InputError
from nptcs.files import read_sealed, write_sealed
from nptcs.seal import FORMATS

PACKAGE = Path(nptcs.__file__).parent
SCRIPTS = PACKAGE.parents[1] / "scripts"
MODULES = sorted([*PACKAGE.rglob("*.py"), *SCRIPTS.glob("*.py")])

WRITERS = {
    "savez",
    "savez_compressed",
    "save",
    "dump",
    "to_pickle",
    "to_parquet",
    "to_hdf",
    "tofile",
}
"""Calls that write data into a file, past every checksum."""
SERIALISERS = {"dumps", "model_dump_json", "to_json", "tobytes"}
"""Calls that make text or bytes of data, which must not be written as they are."""
TEXT_WRITERS = {"write_text", "write_bytes", "write"}

SEALED_HERE = {
    "campaign/bulk_file.py": "arrays with a checksum in their header",
    "fe/spoke/stored.py": "arrays with a checksum next to them",
    "seal.py": "the checksum itself",
}
NOT_STORES = {
    "archive/crate.py": "facts for people; the archive lists the checksum of each of its files",
    "commands/schema.py": "pages and the schema of the configuration, under version control",
    "campaign/progress.py": "how far a job is, for the screen of a run",
    "processes/runs.py": "who runs: without any meaning after the run",
    "processes/scratch.py": "who runs: without any meaning after the run",
    "commands/inspect.py": "a profile for the user to edit",
}


def name_of(node):
    """Last part of what is called."""
    return node.attr if isinstance(node, ast.Attribute) else getattr(node, "id", "")


def unsealed(source):
    """Lines of a module that write data without a checksum."""
    lines = []
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.Call):
            continue
        called = name_of(node.func)
        if called in WRITERS and not (called in ("save", "dump") and len(node.args) < 2):
            lines.append(node.lineno)
        if called in TEXT_WRITERS:
            inside = [part for argument in node.args for part in ast.walk(argument)]
            made = {name_of(part.func) for part in inside if isinstance(part, ast.Call)}
            if made & SERIALISERS and not made & {"sealed_object", "sealed_lines"}:
                lines.append(node.lineno)
    return lines


def place(module):
    return str(module.relative_to(PACKAGE if module.is_relative_to(PACKAGE) else SCRIPTS))


@pytest.mark.parametrize("module", MODULES, ids=place)
def test_a_store_of_ours_is_sealed(module):
    if place(module) not in SEALED_HERE and place(module) not in NOT_STORES:
        assert unsealed(module.read_text("utf-8")) == [], "use nptcs.files.write_sealed"


@pytest.mark.parametrize(
    "code",
    [
        "np.savez(path, a=a)",
        "json.dump(content, stream)",
        "write_text(path, json.dumps(content))",
        "path.write_text(model.model_dump_json())",
        "stream.write(array.tobytes())",
        "frame.to_parquet(path)",
        "pickle.dump(model, stream)",
    ],
)
def test_a_store_without_a_seal_is_found(code):
    assert unsealed(code) == [1]


@pytest.mark.parametrize(
    "code",
    [
        "write_text(path, sealed_object(content, 'Surfaces'))",
        "text = json.dumps(x)",
        "f.save(path)",
    ],
)
def test_what_is_sealed_or_not_a_store_is_not_found(code):
    assert unsealed(code) == []


def test_the_lists_name_files_that_exist():
    assert not [name for name in {**SEALED_HERE, **NOT_STORES} if not (PACKAGE / name).is_file()]


def test_plain_values_are_read_back_and_a_changed_file_is_named(tmp_path):
    kind, file = next(iter(FORMATS)), tmp_path / "a.json"
    write_sealed(file, {"value": 613.25}, kind)
    assert read_sealed(file, kind) == {"value": 613.25}
    file.write_text(file.read_text().replace("613", "614"))
    with pytest.raises(InputError, match="checksum") as refusal:
        read_sealed(file, kind)
    assert "a.json" in str(refusal.value)
    with pytest.raises(InputError, match="does not exist"):
        read_sealed(tmp_path / "b.json", kind)
