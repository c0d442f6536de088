"""The code hash follows imports and ignores what changes no result."""

import ast
import os
import shutil
import subprocess
import sys

import pytest

from nptcs import provenance
from nptcs.provenance import code_digest, code_hash, imported_modules
from nptcs.solvers.registry import MODULES


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
    provenance._examined.cache_clear()
    provenance._digest_with_words.cache_clear()


def edit(file, old, new):
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    forget()


def test_closure_follows_imports_and_nothing_else():
    found = imported_modules("nptcs.surface.sensitivity.gradients")
    assert {"nptcs.surface.sensitivity.gradients", "nptcs.surface.fit", "nptcs.terms"} <= found
    assert "nptcs.design" not in found


COMPARE = [f"compare.{file.stem}" for file in (provenance._ROOT / "compare").glob("*.py")]


@pytest.mark.parametrize("module", ["report.html", "report.workbook.build", *COMPARE])
def test_tables_and_report_do_not_depend_on_the_finite_elements(module):
    """Otherwise a change of the kernel would rewrite them where no case has changed."""
    found = imported_modules(f"nptcs.{module}".removesuffix(".__init__"))
    assert {name for name in found if name.split(".")[:2] == ["nptcs", "fe"]} == set()


def test_imports_inside_functions_count(tmp_path):
    own = tmp_path / "own_solver.py"
    own.write_text("def solve(inputs):\n    from nptcs.design import full_factorial\n")
    assert "nptcs.config.studies.study" in imported_modules(str(own))


def test_a_changed_module_changes_only_what_imports_it(copy):
    before = code_hash("nptcs.surface.sensitivity.gradients"), code_hash("nptcs.lca.section")
    edit(copy / "terms.py", "found * by_power", "found + by_power")
    after = code_hash("nptcs.surface.sensitivity.gradients"), code_hash("nptcs.lca.section")

    assert after[0] != before[0]
    assert after[1] == before[1]


def test_comments_docstrings_and_layout_change_nothing(copy):
    before = code_hash("nptcs.design")
    edit(copy / "design.py", '"""Build the design table of a study.', '"""Other words.')
    edit(copy / "design.py", "    digits = ", "    # a remark\n\n    digits  =  ")
    assert code_hash("nptcs.design") == before


def test_a_user_s_file_is_hashed_with_what_it_imports(copy, tmp_path):
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
    ],
)
def test_numbers_and_texts_count_and_a_comma_does_not(copy, old, new):
    before = code_hash("nptcs.design")
    edit(copy / "design.py", old, new)
    assert (code_hash("nptcs.design") == before) == (new == "rubber_c10_mpa, )")


WORDS = [
    ('raise InputError("no", remedy="do")', 'raise InputError("not so", remedy="act")'),
    ('faults.append(InputError(f"no {x}"))', 'faults.append(InputError(f"{x} is bad"))'),
    ('raise errors.Diverged("no")', 'raise errors.Diverged(f"no {y}")'),
    ('x = Field(2.0, description="a length")', 'x = Field(2.0, description="b", title="c")'),
    ('SolverResult(status=1, message="row 1")', 'SolverResult(status=1, message="line 1")'),
    ('Solver("lca", about="a model")', 'Solver("lca", about="the model")'),
    ('print("done", file=log)', 'print("finished", file=log)'),
    ("class E(ValueError):\n def __str__(self): return 'a'", "class E(ValueError): pass"),
    ('__version__ = "1.0"', '__version__ = "1.1"'),
    ('def f():\n "says"\n return 1', "def f():\n return 1  # says"),
]
DEEDS = [
    ("x = Field(2.0, description='a')", "x = Field(3.0, description='a')"),
    ("x = Field(2.0, gt=0)", "x = Field(2.0, ge=0)"),
    ("SolverResult(status=1, message='a')", "SolverResult(status=2, message='a')"),
    ("if x > 1: raise InputError('a')", "if x >= 1: raise InputError('a')"),
    ("raise InputError('a')", "raise TypeError('a')"),
    ("Solver('lca', factors={'a'})", "Solver('lca', factors={'b'})"),
    ("raise Diverged('a', path(1))", "raise Diverged('a', path(2))"),
    ("y = names['a']", "y = names['b']"),
    ("y = f'{x:.3f}'", "y = f'{x:.4f}'"),
    ("class E(StrEnum):\n def __str__(self): return 'a'", "class E(StrEnum): pass"),
]


@pytest.mark.parametrize(("old", "new"), WORDS)
def test_words_for_a_reader_count_only_where_they_are_printed(old, new):
    assert code_digest(old) == code_digest(new)
    if "def f()" not in old:
        assert code_digest(old, words=True) != code_digest(new, words=True)


@pytest.mark.parametrize(("old", "new"), DEEDS)
def test_what_is_done_counts(old, new):
    assert code_digest(old) != code_digest(new)


class Mutation(ast.NodeTransformer):
    """Change the n-th number, operator or comparison of a module."""

    OPERATORS = (ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Pow)

    def __init__(self, turn):
        self.left = turn

    def hit(self):
        self.left -= 1
        return self.left == -1

    def visit_Raise(self, node):
        return node

    def visit_Constant(self, node):
        number = isinstance(node.value, int | float) and not isinstance(node.value, bool)
        return ast.Constant(node.value * 1.5 + 1) if number and self.hit() else node

    def visit_BinOp(self, node):
        self.generic_visit(node)
        if isinstance(node.op, self.OPERATORS) and self.hit():
            node.op = ast.Sub() if not isinstance(node.op, ast.Sub) else ast.Add()
        return node

    def visit_Compare(self, node):
        self.generic_visit(node)
        if isinstance(node.ops[0], ast.Lt | ast.Gt) and self.hit():
            node.ops[0] = ast.LtE() if isinstance(node.ops[0], ast.Lt) else ast.GtE()
        return node


def mutants(source, step=7):
    """Every `step`-th change of a module that can be made, so that the test stays short."""
    for turn in range(0, 10_000, step):
        mutation = Mutation(turn)
        tree = mutation.visit(ast.parse(source))
        if mutation.left >= 0:
            return
        yield ast.unparse(ast.fix_missing_locations(tree))


@pytest.mark.parametrize("solver", sorted(set(MODULES) - {"published"}))
def test_no_change_of_the_physics_keeps_the_key(solver):
    """Numbers, operators and comparisons in every module that the solver depends on."""
    checked = 0
    for module in sorted(imported_modules(MODULES[solver])):
        if module.split(".")[1:2] not in (["fe"], ["lca"], ["decks"], ["config"], ["solvers"]):
            continue
        stem = provenance._ROOT.joinpath(*module.split(".")[1:])
        file = (
            stem.with_suffix(".py") if stem.with_suffix(".py").is_file() else stem / "__init__.py"
        )
        source = file.read_text(encoding="utf-8")
        known = code_digest(ast.unparse(ast.parse(source)))
        for number, mutant in enumerate(mutants(source, step=61)):
            assert code_digest(mutant) != known, f"{module}, change {number}"
            checked += 1
    assert checked >= 10


def is_description(file):
    body = ast.parse(file.read_text("utf-8")).body
    return all(isinstance(part, ast.Expr | ast.ImportFrom) for part in body) and not [
        part for part in body if isinstance(part, ast.ImportFrom) and part.module != "__future__"
    ]


def test_all_that_a_solver_imports_is_in_its_hash():
    """What is loaded when the solvers are imported, against what the hash says that it covers."""
    code = (
        "import importlib, sys\n"
        f"for name in {sorted(MODULES.values())}: importlib.import_module(name)\n"
        "print(*sorted(n for n in sys.modules if n.split('.')[0] == 'nptcs'), sep='\\n')"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    run = [sys.executable, "-c", code]
    loaded = subprocess.run(run, env=environment, capture_output=True, check=True, text=True)
    missing = set(loaded.stdout.split()) - imported_modules(*MODULES.values())
    # a package whose file contains only its description is loaded, but does nothing
    described = {name for name in missing - {"nptcs"} if is_description(provenance._file(name))}
    assert missing - described <= {"nptcs"}  # which states the version


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
