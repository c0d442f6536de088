"""The code hash follows imports and ignores what changes no result."""

import os
import shutil
import subprocess
import sys

import pytest

from nptcs import provenance
from nptcs.provenance import code_hash, imported_modules


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A copy of the package that the hash is taken of, free to be edited."""
    root = tmp_path / "nptcs"
    shutil.copytree(provenance._ROOT, root, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(provenance, "_ROOT", root)
    forget()
    yield root
    forget()


def forget():
    provenance._read.cache_clear()


def edit(file, old, new):
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    forget()


def test_closure_follows_imports_and_nothing_else():
    found = imported_modules("nptcs.surface.sensitivity")
    assert {"nptcs.surface.sensitivity", "nptcs.surface.fit", "nptcs.terms"} <= found
    assert "nptcs.design" not in found


COMPARE = [f"compare.{file.stem}" for file in (provenance._ROOT / "compare").glob("*.py")]


@pytest.mark.parametrize("module", ["report.html", "report.workbook", *COMPARE])
def test_tables_and_report_do_not_rest_on_the_finite_elements(module):
    """Else a change of the kernel would write them anew where no case has changed."""
    found = imported_modules(f"nptcs.{module}".removesuffix(".__init__"))
    assert {name for name in found if name.split(".")[:2] == ["nptcs", "fe"]} == set()


def test_imports_inside_functions_count(tmp_path):
    own = tmp_path / "own_solver.py"
    own.write_text("def solve(inputs):\n    from nptcs.design import full_factorial\n")
    assert "nptcs.config.study" in imported_modules(str(own))


def test_a_changed_module_changes_only_what_imports_it(copy):
    before = code_hash("nptcs.surface.sensitivity"), code_hash("nptcs.lca.section")
    edit(copy / "surface" / "terms.py", "** np.array", "** -np.array")
    after = code_hash("nptcs.surface.sensitivity"), code_hash("nptcs.lca.section")

    assert after[0] != before[0]
    assert after[1] == before[1]


def test_comments_docstrings_and_layout_change_nothing(copy):
    before = code_hash("nptcs.design")
    edit(copy / "design.py", '"""Build the design table that a study asks for.', '"""Other words.')
    edit(copy / "design.py", "    digits = ", "    # a remark\n\n    digits  =  ")
    assert code_hash("nptcs.design") == before


def test_a_file_of_ones_own_is_hashed_with_what_it_imports(copy, tmp_path):
    own = tmp_path / "own_solver.py"
    own.write_text("from nptcs.design import full_factorial\n")
    before = code_hash(str(own))
    edit(copy / "design.py", "max(3,", "max(4,")
    assert code_hash(str(own)) != before


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("max(3,", "max(4,"),
        ("{number:0", "{number:1"),
        ("rubber_c10_mpa)", "rubber_c10_mpa, )"),
        ('remedy="give levels that differ"', 'remedy="give other levels"'),
    ],
)
def test_numbers_and_texts_count_and_a_comma_does_not(copy, old, new):
    before = code_hash("nptcs.design")
    edit(copy / "design.py", old, new)
    assert (code_hash("nptcs.design") == before) == (new == "rubber_c10_mpa, )")


def test_the_hash_is_the_same_in_every_process():
    code = "from nptcs.provenance import code_hash; print(code_hash('nptcs.campaign.runner'))"
    hashes = set()
    for seed in ("1", "2", "3"):  # another order of every set of texts
        environment = {
            **os.environ,
            "PYTHONHASHSEED": seed,
            "PYTHONPATH": os.pathsep.join(sys.path),
        }
        run = [sys.executable, "-c", code]
        hashes.add(subprocess.run(run, env=environment, capture_output=True, check=True).stdout)
    assert len(hashes) == 1


def test_an_unknown_module_is_an_error():
    with pytest.raises(ModuleNotFoundError, match="no_such"):
        code_hash("nptcs.no_such")
