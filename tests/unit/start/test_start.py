"""Facts for the rules are found once, and again when anything changes that they depend on."""

import atexit
import json

import pytest

from nptcs.start.facts import RuleFacts, SolverFacts, known_facts

SOLVER = SolverFacts(
    module="nptcs.solvers.lca", about="a model", needs_ply=False, loads_tyre=True,
    solves_tables=True, choices={}, table_paths={}, without_effect=("timeout_s",), cores=1,
    tokens=0, case_s=1.0, case_memory_mb=1.0, timeout_s=1.0,
)  # fmt: skip


class Finder:
    def __init__(self, files=None):
        self.times = 0
        self.files = files or {}

    def __call__(self):
        self.times += 1
        return RuleFacts(
            solvers={"s": {"lca": SOLVER}}, modules={}, plies=("cfrp",), rubbers=(), ply={},
            profiles={}, tables=("cases.csv",), files=dict(self.files),
        )  # fmt: skip


@pytest.fixture
def ends(monkeypatch):
    """Functions that would run when Python ends."""
    functions = []
    monkeypatch.setattr(atexit, "register", functions.append)

    def end():
        while functions:
            functions.pop()()

    return end


def test_the_second_start_finds_nothing(tmp_path, ends):
    find, file, sheet = Finder(), tmp_path / "start.json", tmp_path / "sheet.csv"
    sheet.write_text("a")
    first = known_facts(file, {"a": 1}, [sheet], find)
    ends()
    second = known_facts(file, {"a": 1}, [sheet], find)
    assert find.times == 1
    assert json.dumps(first.tables) == json.dumps(second.tables)
    assert second.solvers["s"]["lca"].cores_per_case() == 1
    assert second.solvers["s"]["lca"].module == SOLVER.module


@pytest.mark.parametrize("what", ["configuration", "sheet", "another file", "stored facts"])
def test_a_change_is_seen(tmp_path, ends, what):
    from nptcs.start.facts import contents

    archive = tmp_path / "archive.csv"
    archive.write_text("a")
    find, file, sheet = Finder(contents([str(archive)])), tmp_path / "start.json", tmp_path / "s"
    sheet.write_text("a")
    given = {"a": 1}
    known_facts(file, given, [sheet], find)
    ends()
    if what == "configuration":
        given = {"a": 2}
    elif what == "sheet":
        sheet.write_text("b")
    elif what == "another file":
        archive.write_text("b")
    else:
        file.write_text(file.read_text().replace("cfrp", "gfrp"))
    assert known_facts(file, given, [sheet], find).plies == ("cfrp",)
    assert find.times == 2


def test_hashes_of_code_are_kept(tmp_path, ends, monkeypatch):
    find, file = Finder(), tmp_path / "start.json"
    hashed = known_facts(file, {}, [], find).code_of("nptcs.terms")
    ends()
    known = known_facts(file, {}, [], find)
    monkeypatch.setattr("nptcs.start.facts.code_hash", lambda *modules, words: "hashed anew")
    assert known.code_of("nptcs.terms") == hashed
    assert known.code_of("nptcs.terms", words=True) == "hashed anew"


def test_hashes_of_code_outlast_a_configuration_but_not_a_script(tmp_path, ends, monkeypatch):
    find, file, script = Finder(), tmp_path / "start.json", tmp_path / "script.py"
    script.write_text("a = 1")
    known_facts(file, {"a": 1}, [script], find).code_of(str(script))
    ends()
    monkeypatch.setattr("nptcs.start.facts.code_hash", lambda *modules, words: "hashed anew")
    other = known_facts(file, {"a": 2}, [script], find)
    assert other.code_of(str(script)) != "hashed anew"
    assert find.times == 2
    ends()
    script.write_text("a = 2")
    assert known_facts(file, {"a": 2}, [script], find).code_of(str(script)) == "hashed anew"


def test_a_fault_is_not_kept(tmp_path, ends):
    def refuse():
        raise ValueError("a fault")

    with pytest.raises(ValueError, match="a fault"):
        known_facts(tmp_path / "start.json", {}, [], refuse)
    ends()
    assert not (tmp_path / "start.json").exists()
