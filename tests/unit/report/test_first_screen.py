"""The first screen says what came out, and what was not assessed."""

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest

from nptcs.report.answer.agreement import agreement_finding
from nptcs.report.answer.governing import governing_finding
from nptcs.report.answer.recommended import recommended_findings
from nptcs.report.answer.stiffness import stiffness_finding
from nptcs.report.answer.tests_behind import tests_finding as findings_on_tests
from nptcs.report.html import render_report
from nptcs.report.sections.refused import all_refused
from nptcs.report.sections.summary import findings, flag_lines
from nptcs.report.sketches import BarRow, IntervalRow, Share, bar_of_shares, bars, intervals
from nptcs.report.text import text_width
from nptcs.tables.catalogue import TABLES
from nptcs.tables.io import check
from nptcs.tables.laboratory.flags import FlagsTable
from nptcs.tables.tyres.cases import Cases

REFERENCE = "spacing_mm 15, thickness_mm 1.8, angle_deg 45"
PLACE = {"response": "secant_stiffness", "at": "5000 N", "unit": "N/mm"}
UNCERTAIN = {
    **{"study": "plate", "solver": "published", "design": "reference", "factors": REFERENCE},
    **PLACE,
    **{"nominal": 264.5, "mean": 264.41234, "sd": 2.31, "low": 259.912, "high": 268.934},
    **{"confidence_percent": 95.0, "interaction_percent": 0.1, "surface": "polynomial"},
    **{"cases": 63, "card": "standard_error", "note": ""},
}
DECISION = {
    **{"decision": "stiff", "study": "plate", "solver": "published", "with_probability": 0.9},
    **{"goals": "secant_stiffness at 5000 N = 300 ± 5", "status": "feasible", "message": ""},
    **{"design": "22 plates, spacing_mm 9.7727, angle_deg 0", "probability": 0.93},
    **{"confirmation": "inside", "solved_designs": 1},
}
GOAL = {
    **{"decision": "stiff", "rank": 1, "chosen": True, "design": "22 plates", "probability": 0.93},
    **{"desirability": 1.0, "goal": DECISION["goals"], **PLACE, "mean": 299.0, "sd": 2.0},
    **{"low": 295.0, "high": 303.0, "smallest_accepted": 295.0, "largest_accepted": 305.0},
}
SOLVED = {
    **{"decision": "stiff", "study": "plate", "solver": "published", "round": 1},
    **{"design": "22 plates", **PLACE, "predicted": 299.0, "low": 298.9, "high": 299.1},
    **{"solved": 299.05, "difference": 0.05, "result": "inside", "goal_met": "yes"},
    **{"added": False, "wall_time_s": 1.0, "message": ""},
}


def with_tables(results, **rows):
    """Replace result tables, given by name without ending, by rows."""
    tables = {}
    for name, given in rows.items():
        contract = TABLES[f"{name}.csv"].contract
        table = pd.DataFrame(given).reindex(columns=list(contract.to_schema().columns))
        tables[f"{name}.csv"] = check(table, contract, name)
    return replace(results, tables={**results.tables, **tables})


def with_study(results, name, **changed):
    studies = tuple(
        study.model_copy(update=changed) if study.name == name else study
        for study in results.config.studies
    )
    return replace(results, config=results.config.model_copy(update={"studies": studies}))


def words_of(finding):
    return f"{finding.answer} {finding.words}".replace("\u00a0", " ")


def test_the_stiffness_comes_with_its_uncertainty_and_no_more_digits_than_it_allows(results):
    found = stiffness_finding(with_tables(results, uncertainty=[UNCERTAIN]))
    assert found.answer == "264.4 ± 2.3 N/mm at 5000 N"
    said = words_of(found)
    assert "plate spacing S 15 mm, plate thickness T 1.8 mm, fibre angle A 45°" in said
    assert "between 259.9 and 268.9 N/mm" in said
    assert "published" in found.sketch.svg


def test_a_computing_solver_is_named_before_the_published_one(compared):
    both = [UNCERTAIN, {**UNCERTAIN, "solver": "fe_tyre_paper", "mean": 262.0}]
    found = stiffness_finding(with_tables(compared, uncertainty=both))
    assert found.answer.startswith("262.0 ± 2.3")


def test_without_uncertainty_the_solved_reference_is_given_and_the_lack_is_stated(results):
    found = stiffness_finding(results)
    assert found.answer == "263.7 N/mm at 5000 N"
    assert "uncertainty of its stiffness was not assessed" in words_of(found)


def test_the_load_of_the_study_is_the_one_that_is_stated(results):
    at_4000 = with_study(results, "plate", load_n=4000.0)
    uncertain = {**UNCERTAIN, "at": "4000 N"}
    found = stiffness_finding(with_tables(at_4000, uncertainty=[uncertain, UNCERTAIN]))
    assert found.answer.endswith("at 4000 N")
    # the stiffness at 5000 N of a study at 4000 N is another response, not its stiffness
    assert "±" not in stiffness_finding(with_tables(at_4000, uncertainty=[UNCERTAIN])).answer


def test_without_a_reference_design_the_span_of_the_cases_is_given(results):
    found = stiffness_finding(with_study(results, "plate", reference={}))
    cases = results.table(Cases)
    span = cases.loc[cases["study"] == "plate", "vertical_stiffness_n_per_mm"]
    assert found.answer.startswith(f"{span.min():.4g} to {span.max():.4g} N/mm")
    assert "names no reference design" in words_of(found)


def test_without_any_stiffness_it_is_not_assessed(results):
    cases = results.table(Cases).assign(vertical_stiffness_n_per_mm=np.nan)
    none = replace(results, tables={**results.tables, "cases.csv": cases})
    found = stiffness_finding(none)
    assert (found.answer, found.assessed) == ("Not assessed", False)


def test_the_largest_impact_governs(results):
    found = governing_finding(results)
    assert found.answer == "Spoke C10 (S-C)"
    assert "spoke C10 (S-C) 315 N/mm (1 to 5 MPa), plate spacing S 54.9 N/mm" in words_of(found)
    empty = results.tables["impact.csv"][:0]
    none = replace(results, tables={**results.tables, "impact.csv": empty})
    assert not governing_finding(none).assessed


def test_a_run_without_decisions_says_so(results):
    (found,) = recommended_findings(results)
    assert found.answer == "Not requested"
    assert not found.assessed


@pytest.fixture(scope="module")
def decided(results):
    study = results.config.study("plate")
    decision = {"name": "stiff", "title": "", "solver": "published", "targets": ["K=300±5@5000"]}
    model = type(study).model_validate({**study.model_dump(), "decisions": [decision]})
    changed = with_study(results, "plate", decisions=model.decisions)
    return with_tables(
        changed, decisions=[DECISION], decision_designs=[GOAL], decision_confirmation=[SOLVED]
    )


def test_the_chosen_design_is_written_for_people_and_confirmed(decided):
    (found,) = recommended_findings(decided)
    assert (
        found.answer.replace("\u00a0", " ")
        == "22 plates, plate spacing S 9.773 mm, fibre angle A 0°"
    )
    assert "with a probability of 93 %" in found.words
    assert "confirms the prediction" in found.words
    assert "299.05 N/mm" in found.sketch.svg


@pytest.mark.parametrize(
    ("changed", "solved", "said"),
    [
        ({"confirmation": "outside"}, {"result": "outside"}, "does NOT confirm"),
        ({"confirmation": "inside"}, {"goal_met": "no"}, "The solved case misses a goal."),
        (
            {"confirmation": "not solved"},
            {"result": "not solved", "solved": np.nan},
            "not confirmed",
        ),
        (
            {"confirmation": "not asked"},
            {},
            "No confirmation by a solved case was requested: not confirmed.",
        ),
        ({"status": "infeasible", "message": "out of reach"}, {}, "out of reach"),
        ({"status": "refused", "message": "no surface"}, {}, "no surface"),
    ],
)
def test_a_choice_that_is_not_confirmed_says_so(decided, changed, solved, said):
    rows = {"decisions": [DECISION | changed], "decision_confirmation": [SOLVED | solved]}
    (found,) = recommended_findings(with_tables(decided, **rows))
    assert said in found.words
    assert found.assessed == ("status" not in changed)


def test_blind_errors_are_those_of_the_table(compared, results):
    found = agreement_finding(compared)
    row = compared.tables["stiffness_errors.csv"].query("study == 'plate' and group == 'blind'")
    assert (
        found.answer
        == f"{row['mean_absolute_percent'].iloc[0]:.2g} % mean difference at 58 blind cases"
    )
    assert "+2 % at most" in found.words
    assert not agreement_finding(results).assessed


FLAG = {
    **{"standard": "ASTM D3039", "kind": "deviation", "flag": "failure after 0.95 to 0.98 min"},
    **{"specimens": 2, "names": "T0-1, T0-2", "properties": "modulus"},
}


def test_deviations_are_counted_and_listed_with_their_specimens(results):
    flagged = with_tables(results, flags=[FLAG])
    found = findings_on_tests(flagged)
    # T0-2 is left out by the sheet
    assert found.answer == "1 of 2 specimens used deviates from its standard"
    assert flag_lines(flagged) == (
        "ASTM D3039, 2 specimens: failure after 0.95 to 0.98 min (T0-1, T0-2)",
    )
    assert "3 of 3 specimens are SYNTHETIC" in found.words


def test_measured_specimens_are_not_called_synthetic(measured):
    assert "All specimens were measured." in findings_on_tests(measured).words


def test_flags_are_above_the_sections(results, monkeypatch):
    monkeypatch.setattr("nptcs.report.drawing.compact", lambda svg: "<svg ></svg>")
    page = render_report(with_tables(results, flags=[FLAG]))
    text = re.sub(r'<span class="nb">(.*?)</span>', r"\1", page)
    assert text.index("failure after 0.95 to 0.98 min (T0-1, T0-2)") < text.index(
        "<section", text.index('id="verdict"')
    )


def test_a_study_under_other_conditions_is_named_with_the_reason(results):
    assert all_refused(results) == []
    (said,) = all_refused(with_study(results, "plate", load_n=4000.0))
    assert "the published values hold at 5000 N, the study plate at 4000 N" in said


def test_every_finding_names_a_table_and_a_section(results):
    for found in findings(results):
        assert all(name in TABLES for name in found.source.split(", "))
        assert found.section


def test_marks_of_a_sketch_lie_where_their_values_are():
    rows = [IntervalRow("a", 10.0, "10", 8.0, 12.0), IntervalRow("b", 11.0, "11")]
    svg = str(intervals(rows, "alt", (9.0, 11.0)).svg)
    first, second = (float(x) for x in re.findall(r'cx="([\d.]+)"', svg))
    left, right = (float(x) for x in re.search(r"M([\d.]+) [\d.]+H([\d.]+)", svg).groups())
    per_unit = (right - left) / 4
    assert second - first == pytest.approx(per_unit, abs=0.11)
    band = float(re.search(r'class="band" x="([\d.]+)"', svg)[1])
    assert first - band == pytest.approx(per_unit, abs=0.11)


def test_names_are_escaped_and_long_ones_leave_room_for_the_bar():
    svg = str(bars([BarRow("a<b " + 60 * "x", 1.0, "1 %")], "alt & more").svg)
    assert "a&lt;b" in svg
    assert float(re.search(r'<rect[^>]* width="([\d.]+)"', svg)[1]) >= 50


def test_the_flags_table_of_a_run_without_flags_is_empty(results):
    assert flag_lines(results) == ()
    assert results.table(FlagsTable).empty


@pytest.mark.parametrize(
    "names", [("as the standard requires", "deviate from it", "left out"), ("符合标准", "偏离")]
)
def test_keys_of_shares_do_not_run_into_each_other(names):
    shares = [Share(name, 20, "good") for name in names]
    svg = bar_of_shares(shares, "shares").svg
    texts = re.findall(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*>([^<]*)<', svg)
    ends = [(float(y), float(x), float(x) + 6.9 * text_width(text)) for x, y, text in texts]
    assert len(ends) == len(names)
    assert all(end <= 360 for _, _, end in ends)
    for (y, _, end), (below, start, _) in pairwise(ends):
        assert below > y or start - 15 > end
