"""The search against brute force, conflicts, desirability by hand, whole plates and steps."""

from itertools import product

import numpy as np
import pytest
from scipy import stats

from nptcs.commands.design import as_text
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.decisions import Decision
from nptcs.config.studies.goals import GoalKind, ResponseName, read_goal
from nptcs.decisions.decide import decide
from nptcs.decisions.evaluate import (
    DesignProblem,
    Desirability,
    Evaluation,
    at_least_all,
    within,
)
from nptcs.decisions.search import pareto
from nptcs.decisions.space import design_space
from nptcs.decisions.tables import DecisionAnswer
from nptcs.errors import InputError
from nptcs.uncertainty.fitted import PlateMass

WIDTH, KG = 215.0, 0.0337


def decision(**goals):
    values = {"name": "d", "study": "plate", "solver": "fe_tyre_paper", "surface": "polynomial"}
    return Decision.model_validate({**values, **goals})


@pytest.fixture(scope="module")
def lightest(source):
    return decide(
        decision(
            targets=["K=300±5@5000"],
            minimise=["plate_mass"],
            steps={"thickness_mm": 0.05, "angle_deg": 1},
        ),
        source,
    )


def test_the_lightest_design_is_that_of_brute_force(lightest):
    """The tyre's formula: K = 400 - 9 pitch + 15 T - 0.2 A - 4e-4 A²; tolerances T 0.05, A 1."""
    best = np.inf
    for n, t, a in product(range(11, 23), np.arange(1.2, 2.4001, 0.05), np.arange(0, 90.1, 1)):
        k = 400 - 9 * WIDTH / n + 15 * t - 0.2 * a - 4e-4 * a**2
        sd = np.hypot(15 * 0.05, 0.2 + 8e-4 * a)
        holds = stats.norm.cdf((305 - k) / sd) - stats.norm.cdf((295 - k) / sd)
        if holds >= 0.9:
            best = min(best, KG * n * t)
    design = lightest.design(lightest.choice)
    mass = KG * round(WIDTH / design["spacing_mm"]) * design["thickness_mm"]
    assert mass == pytest.approx(best, rel=1e-6)
    assert lightest.found.designs.probability[lightest.choice] >= 0.9
    assert lightest.sampled[lightest.choice] >= 0.89


def test_designs_can_be_made_and_differ(lightest):
    x = lightest.found.designs.x
    plates = WIDTH / x[:, 0]
    np.testing.assert_allclose(plates, plates.round(), atol=1e-9)
    np.testing.assert_allclose(x[:, 1] / 0.05, (x[:, 1] / 0.05).round(), atol=1e-6)
    np.testing.assert_allclose(x[:, 2], x[:, 2].round(), atol=1e-6)
    span = np.array([10.0, 1.2, 90.0])
    for one, other in product(range(len(x)), repeat=2):
        if one < other:
            same_plates = round(plates[one]) == round(plates[other])
            assert not same_plates or (np.abs(x[one] - x[other]) / span).max() >= 0.1 - 1e-9
    assert (np.diff(lightest.found.desirability) <= 1e-12).all()
    assert 0 < lightest.found.feasible_percent < 100


@pytest.mark.parametrize(
    ("shares", "choice", "said", "line"),
    [
        ([0.95, 0.5], 0, "", "but not by rank 2"),
        ([0.5, 0.895], 1, "", "0.9 is met within 0.01, but not by rank 1"),
        ([0.6, 0.5], 0, "0.600 of the choice's samples meet the goals, not 0.9", "by rank 1, 2"),
    ],
)
def test_designs_whose_samples_hold_less_often_are_named(
    source, monkeypatch, shares, choice, said, line
):
    given = iter(shares)
    monkeypatch.setattr(DesignProblem, "share_that_holds", lambda *_: next(given))
    found = decide(decision(targets=["K=300±5"], minimise=["plate_mass"], top=2), source)
    assert found.choice == choice
    assert found.why.startswith(said)
    assert bool(found.why) == bool(said)
    assert line in as_text(DecisionAnswer(found.decision, found))


def test_the_probability_costs_mass(source):
    """At 0 degrees 16 plates of 1.2 mm lie just inside the target: an even chance, not 0.9."""
    goals = {"targets": ["K=302±5"], "minimise": ["plate_mass"], "hold": {"angle_deg": 0}}
    even, safe = (
        decide(decision(**goals, with_probability=chance), source) for chance in (0.3, 0.9)
    )
    thickness = [found.design(found.choice)["thickness_mm"] for found in (even, safe)]
    assert thickness == pytest.approx([1.2, 1.27], abs=0.021)


def test_a_held_factor_stays_and_a_held_spacing_becomes_whole_plates(source):
    found = decide(
        decision(targets=["K=300±20"], minimise=["plate_mass"], hold={"spacing_mm": 12.3}), source
    )
    assert {round(WIDTH / x[0]) for x in found.found.designs.x} == {
        TyreGeometry().plates_across(12.3)
    }
    found = decide(decision(targets=["K=300±20"], hold={"angle_deg": 30}), source)
    assert set(found.found.designs.x[:, 2]) == {30.0}


def test_goals_in_conflict_are_named_with_the_nearest_design(source):
    found = decide(decision(targets=["K=305±3"], at_most=["plate_mass=0.6"]), source)
    assert not found.found.feasible
    assert "no design meets all goals" in found.why
    assert "without 'plate_mass at most 0.6' the others are met" in found.why
    assert len(found.found.designs.x) == 1
    alone = decide(decision(targets=["K=900±3"]), source)
    assert "out of reach even alone: secant_stiffness at 5000 N = 900 ± 3" in alone.why
    assert ": at best 0; alone, at best: " in alone.why
    # the nearest is the stiffest of all: most plates, thickest, along the spoke
    np.testing.assert_allclose(alone.design(0)["thickness_mm"], 2.4)
    assert alone.design(0)["angle_deg"] == 0


def test_stiffness_at_another_load_and_two_objectives(source):
    found = decide(
        decision(
            targets=["K=300±10"],
            at_least=["K=280@3000"],
            minimise=["plate_mass", "plate_largest_mises"],
        ),
        source,
    )
    assert found.found.feasible
    front = found.found.front
    order = np.argsort(front.mean[ResponseName("plate_mass")])
    stress = front.mean[ResponseName("plate_largest_mises", "5000 N")][order]
    assert len(order) > 3
    assert (np.diff(stress) <= 0).all()  # the more mass, the less stress


def test_what_cannot_be_asked_is_refused(source):
    for goals, message in (
        ({"targets": ["contact_length=40±5"]}, "has contact_length at 5000 N"),
        ({"targets": ["K=300±5@9000"]}, "has secant_stiffness at 9000 N"),
        ({"targets": ["K=300±5"], "hold": {"angle_deg": 100}}, "outside the cases"),
        ({"targets": ["K=300±5"], "steps": {"width": 1}}, "not a factor"),
        ({"targets": ["K=300±5"], "surface": "lamination 7"}, "no such surface"),
    ):
        with pytest.raises(InputError, match=message):
            decide(decision(**goals), source)


def test_desirability_is_the_weighted_geometric_mean_of_derringer_and_suich():
    target = read_goal(GoalKind.TARGET, "K=300±10*2")
    light = read_goal(GoalKind.MINIMISE, "plate_mass")
    k, mass = ResponseName("secant_stiffness"), ResponseName("plate_mass")
    found = Evaluation(
        np.zeros((2, 1)),
        {k: np.array([305.0, 300.0]), mass: np.array([0.5, 0.75])},
        {},
        np.ones((2, 1)),
    )
    scale = Desirability((target, light), {"plate_mass": 0.5}, {"plate_mass": 1.0})
    np.testing.assert_allclose(scale.of(found), [(0.5**2 * 1) ** (1 / 3), (1 * 0.5) ** (1 / 3)])


def test_probabilities():
    goal = read_goal(GoalKind.TARGET, "K=300±5")
    mean, sd = np.array([300.0, 305.0, 305.0]), np.array([5.0, 5.0, 0.0])
    inside = within(goal, mean, sd)
    np.testing.assert_allclose(inside[0], stats.norm.cdf(1) - stats.norm.cdf(-1))
    np.testing.assert_allclose(inside[1], 0.5 - stats.norm.cdf(-2))
    np.testing.assert_allclose(at_least_all(np.array([[0.95, 0.9], [0.2, 0.3]])), [0.85, 0.0])


def test_no_design_betters_one_of_the_front(source):
    light = read_goal(GoalKind.MINIMISE, "plate_mass")
    stiff = read_goal(GoalKind.MAXIMISE, "K")

    class Two:
        objectives = (light, stiff)

    mean = {
        light.response: np.array([1.0, 2.0, 2.0, 3.0]),
        stiff.response: np.array([10.0, 30.0, 20.0, 30.0]),
    }
    found = Evaluation(np.zeros((4, 1)), mean, {}, np.ones((4, 0)))
    assert pareto(Two, found).tolist() == [True, True, False, False]


def test_a_box_without_whole_plates_is_refused():
    mass = PlateMass(("spacing_mm",), np.array([14.4]), np.array([15.2]), 1.0, WIDTH)
    with pytest.raises(InputError, match="no whole number of plates"):
        design_space([mass], {}, {}, TyreGeometry(), whole_plates=True)
    assert design_space([mass], {}, {}, TyreGeometry(), whole_plates=False).cells == (None,)


def test_steps_that_miss_every_acceptable_design_are_reported(source):
    goals = {"targets": ["K=302±3"], "hold": {"spacing_mm": 13.5, "angle_deg": 0}}
    found = decide(decision(**goals, steps={"thickness_mm": 1.2}), source)
    assert found.found.feasible
    assert "lies between the steps" in found.why
