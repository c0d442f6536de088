"""Goals as users write them: what is read, and what is refused in which words."""

import contextlib
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.config.studies.decisions import Decision
from nptcs.config.studies.goals import GoalKind, ResponseName, read_goal, read_goals
from nptcs.errors import InputError

NUMBERS = st.floats(0.001, 1e6).map(lambda x: float(f"{x:.6g}"))


@pytest.mark.parametrize("text", ["K=300±5@5000", "K = 300 +- 5 @ 5000 N", "K=3e2+/-5.0@5000N*0"])
def test_the_notations_of_a_target_mean_the_same(text):
    goal = read_goal(GoalKind.TARGET, text)
    assert goal.response == ResponseName("secant_stiffness", "5000 N")
    assert goal.limits == (295.0, 305.0)
    assert goal.weight == 0.0


def test_bounds_objectives_and_places():
    assert read_goal(GoalKind.AT_LEAST, "K=250@25mm").response.at == "25 mm"
    assert read_goal(GoalKind.AT_LEAST, "K=250").limits == (250.0, math.inf)
    assert read_goal(GoalKind.AT_MOST, "smallest_spoke_force=-200").limits == (-math.inf, -200.0)
    assert read_goal(GoalKind.MINIMISE, "plate_mass*2.5").weight == 2.5


@given(
    NUMBERS,
    NUMBERS,
    NUMBERS,
    st.sampled_from(["±", "+-", "+/-"]),
    st.sampled_from(["", " N", "mm"]),
)
def test_every_number_is_read_back(value, half, at, sign, unit):
    goal = read_goal(GoalKind.TARGET, f"tangent_stiffness={value!r}{sign}{half!r}@{at!r}{unit}")
    assert (goal.value, goal.plus_minus) == (value, half)
    assert goal.response.at == f"{at:g} {unit.strip() or 'N'}"


@given(st.text(max_size=20))
def test_any_text_is_read_or_refused_clearly(text):
    for kind in GoalKind:
        with contextlib.suppress(InputError):
            assert read_goal(kind, text).text == text.strip()


@pytest.mark.parametrize(
    ("kind", "text", "message"),
    [
        (GoalKind.TARGET, "K=300", "no half width"),
        (GoalKind.TARGET, "K", "has no value"),
        (GoalKind.TARGET, "K=300±0", "not above zero"),
        (GoalKind.TARGET, "K=300±5@5 kN", "cannot be read"),
        (GoalKind.AT_LEAST, "K=250±3", "only a target has"),
        (GoalKind.MINIMISE, "plate_mass=3", "does not use"),
        (GoalKind.MINIMISE, "plate_mas", "did you mean plate_mass"),
        (GoalKind.AT_MOST, "plate_mass@5000=1", "cannot be read"),
        (GoalKind.MINIMISE, "contact_length@3000", "at the load of the study"),
        (GoalKind.MINIMISE, "K*-1", "negative weight"),
        (GoalKind.TARGET, "K=1e999±1", "too large"),
    ],
)
def test_what_is_refused(kind, text, message):
    with pytest.raises(InputError, match=message):
        read_goal(kind, text)


def test_a_decision_needs_goals_that_differ():
    with pytest.raises(InputError, match="needs a goal"):
        read_goals([])
    with pytest.raises(InputError, match="two goals"):
        read_goals([(GoalKind.TARGET, "K=300±5"), (GoalKind.TARGET, "K=310±5")])
    with pytest.raises(ValueError, match="no half width"):
        Decision(name="d", study="plate", solver="fe_tyre", targets=("K=300",))
    with pytest.raises(ValueError, match="both held and stepped"):
        Decision(
            name="d",
            study="plate",
            solver="fe_tyre",
            targets=("K=300±5",),
            hold={"angle_deg": 45},
            steps={"angle_deg": 1},
        )
