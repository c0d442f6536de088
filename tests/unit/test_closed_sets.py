"""Closed sets: a new member fails here or in the type check until every place handles it."""

import ast
from collections.abc import Iterable, Iterator
from itertools import product
from pathlib import Path
from typing import get_args

import pytest
from pandera.pandas import DataFrameModel

import nptcs
from nptcs.calibrate import invariants, ogden
from nptcs.calibrate.drucker import PATHS
from nptcs.calibrate.models import model_named
from nptcs.config.materials.calibration import ModelName, RubberSettings
from nptcs.config.materials.reduction import ChordMethod, ReductionSettings
from nptcs.config.materials.standards.base import Statistic
from nptcs.config.solvers.fe import PlateCoupling
from nptcs.config.studies.sensitivity import AveragingRule
from nptcs.config.studies.surface import Choice, LaminationCoefficients
from nptcs.ingest.reading.profiles import FormatProfile, Quantity
from nptcs.ingest.reading.text.dialect import number_pattern
from nptcs.lca.batch import TARGETS
from nptcs.lca.linear.newton import Target
from nptcs.lca.section import SectionKind
from nptcs.lca.state import REGIONS
from nptcs.mechanical_tests import COMPOSITE_TESTS, RUBBER_TESTS, TestType
from nptcs.report.figures import lca as lca_figures
from nptcs.report.figures import uncertainty as uncertainty_figures
from nptcs.report.sketches import Tone
from nptcs.solvers.contract import Status
from nptcs.surface.kinds.lamination import FIXED_SHAPE, OPTIONAL_SHAPE
from nptcs.surface.response_surface import Outside
from nptcs.tables.analysis.diagnostics import SurfaceSelection
from nptcs.tables.analysis.response_surfaces import ResponseSurfaces
from nptcs.tables.analysis.surface import SurfaceComparison
from nptcs.tables.analysis.uncertainty import SourceKind, UncertaintyShares
from nptcs.tables.laboratory.files import Files, FileStatus
from nptcs.tables.laboratory.statistics import StatisticsTable
from nptcs.tables.published.lca_validation import LcaAgainstFem, LcaNeutralLine, LcaValidation

PACKAGE = Path(nptcs.__file__).parent
MODULES = sorted(PACKAGE.rglob("*.py"))

# the words of sets that decide between branches; a comparison with one of them is half an if-chain
STANDARDS = ("tension_standard", "shear_standard", "rubber_standard")
WORDS = {
    *get_args(ChordMethod),
    *get_args(AveragingRule),
    *get_args(PlateCoupling),
    *get_args(SectionKind),
    *get_args(ModelName),
    *get_args(RubberSettings.model_fields["weights"].annotation),
    *(w for s in STANDARDS for w in get_args(ReductionSettings.model_fields[s].annotation)),
    *(test.value for test in TestType),
    *(status.value for status in Status if status is not Status.OK),
    "contact_angle",
    "sinking",
} - {"specimens", "points", "relative", "error", "shear", "tension", "compression"}


def comparisons(tree: ast.AST) -> Iterator[ast.Compare]:
    """Comparisons with one member of a closed set: ``x == "least_squares"``, ``x is Test.A``."""
    for node in ast.walk(tree):
        # `in` asks for several members, or whether a word is one: not half an if-chain
        if not isinstance(node, ast.Compare) or isinstance(node.ops[0], ast.In | ast.NotIn):
            continue
        for side in (node.left, *node.comparators):
            word = isinstance(side, ast.Constant) and side.value in WORDS
            member = isinstance(side, ast.Attribute) and ast.unparse(side.value) == "TestType"
            if word or member:
                yield node


def open_matches(tree: ast.AST) -> Iterator[ast.Match]:
    """``match`` statements that do not end in ``case _: assert_never(…)``."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Match):
            last = node.cases[-1]
            if "assert_never" not in ast.unparse(last):
                yield node


def test_no_branch_over_a_closed_set_has_a_default() -> None:
    found = [
        f"{file.relative_to(PACKAGE)}:{node.lineno}: {ast.unparse(node).splitlines()[0]}"
        for file in MODULES
        for tree in [ast.parse(file.read_text("utf-8"))]
        for node in (*comparisons(tree), *open_matches(tree))
    ]
    assert found == []


@pytest.mark.parametrize(
    "code",
    [
        "x = 1 if method == 'least_squares' else 2",
        "if test is TestType.SHEAR: pass",
        "match a:\n  case 'b': pass\n  case _: c = 1",
    ],
)
def test_the_search_sees_a_chain_with_a_default(code: str) -> None:
    tree = ast.parse(code)
    assert [*comparisons(tree), *open_matches(tree)]


@pytest.mark.parametrize("test", TestType)
def test_each_test_type_has_its_rules_and_its_sign(test: TestType) -> None:
    assert ReductionSettings().rules(test).title
    assert test.load_sign in (1, -1)
    assert test.is_rubber == (test in RUBBER_TESTS) == (test not in COMPOSITE_TESTS)


def test_an_unknown_test_type_is_not_reduced_as_anything() -> None:
    with pytest.raises(AssertionError, match="unreachable"):
        ReductionSettings().rules("torsion")  # type: ignore[arg-type]


def test_each_mode_of_a_rubber_test_is_known_to_the_models() -> None:
    modes = {test.value for test in RUBBER_TESTS}
    assert set(invariants.MODES) == modes
    assert set(invariants.SECOND_STRETCH) == modes
    assert set(invariants.EXPONENTS) == modes
    assert set(ogden.RATIO) == modes
    assert set(PATHS.values()) <= modes


def test_each_model_of_the_settings_can_be_made() -> None:
    assert [model_named(name, 2).name for name in get_args(ModelName)] == list(get_args(ModelName))


def allowed(table: type[DataFrameModel], column: str) -> set[str]:
    """Words that a contract allows in a column."""
    (check,) = (one for one in table.to_schema().columns[column].checks if one.name == "isin")
    return set(check.statistics["allowed_values"])


@pytest.mark.parametrize(
    ("table", "column", "words"),
    [
        (LcaValidation, "section", get_args(SectionKind)),
        (LcaAgainstFem, "section", get_args(SectionKind)),
        (LcaNeutralLine, "section", get_args(SectionKind)),
        (LcaNeutralLine, "region", REGIONS),
        (SurfaceComparison, "outside_the_box", Outside),
        (ResponseSurfaces, "outside_the_box", Outside),
        (SurfaceSelection, "criterion", {*get_args(Choice)} - {"as_given"}),
        (StatisticsTable, "reported_statistic", get_args(Statistic)),
        (UncertaintyShares, "kind", {*SourceKind, "not assessed"}),
        (Files, "status", FileStatus),
    ],
)
def test_a_contract_allows_the_members_of_its_set(
    table: type[DataFrameModel], column: str, words: Iterable[str]
) -> None:
    assert allowed(table, column) == set(words)


def test_each_statistic_of_a_standard_is_a_column_of_the_table() -> None:
    assert set(get_args(Statistic)) <= set(StatisticsTable.to_schema().columns)


def test_each_region_of_the_ring_and_each_source_of_uncertainty_is_drawn() -> None:
    assert set(lca_figures.REGIONS) == set(REGIONS)
    assert set(uncertainty_figures.KINDS) == set(SourceKind)
    assert set(uncertainty_figures.HATCHES) == set(SourceKind)


def test_each_tone_of_a_sketch_has_its_colours() -> None:
    styles = (PACKAGE / "report" / "templates" / "report.css").read_text("utf-8")
    assert [tone for tone in get_args(Tone) if f".sketch .{tone} {{" not in styles] == []


def test_each_target_of_the_load_bearing_model_is_named_once() -> None:
    assert sorted(TARGETS.values()) == sorted(get_args(Target))


def test_each_number_of_lamination_coefficients_leaves_shape_parameters_to_choose() -> None:
    own = 3 + len(FIXED_SHAPE)  # c0, c1, c2 and the shape parameters that every form has
    assert set(get_args(LaminationCoefficients)) == {
        own + chosen for chosen in range(1, len(OPTIONAL_SHAPE) + 1)
    }


def test_each_axis_of_a_window_is_a_quantity_that_a_profile_can_name() -> None:
    axes = get_args(get_args(FormatProfile.model_fields["window"].annotation)[0])
    assert axes
    assert set(axes) <= set(get_args(Quantity))


def test_each_mark_of_a_profile_is_read_in_numbers() -> None:
    decimals = get_args(FormatProfile.model_fields["decimal"].annotation)
    thousands = get_args(FormatProfile.model_fields["thousands"].annotation)
    for decimal, mark in product(decimals, thousands):
        if decimal and decimal != mark:
            assert number_pattern(decimal, mark).fullmatch(f"1{mark}234{decimal}5")
