import numpy as np
import pandas as pd
import pytest

from nptcs.calibrate.covariance import covariance_of_means
from nptcs.calibrate.sampling import sample_constants
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY, CardConstant, Covariance, PlyCard

MATRIX = np.array([[4e6, 0.0, 12.0, 0.0], [0.0, 5e3, 0.0, 0.0], [12.0, 0.0, 1e-4, 0.0]])
MATRIX = np.vstack([MATRIX, [0.0, 0.0, 0.0, 2.5e3]])
TIES = {"e3_mpa": "e2_mpa", "nu13": "nu12", "g13_mpa": "g12_mpa"}


@pytest.fixture
def card() -> PlyCard:
    constants = {
        name: CardConstant(
            value=value, unit="MPa", origin="measured", rule="", equal_to=TIES.get(name)
        )
        for name, value in PUBLISHED_PLY.items()
    }
    covariance = Covariance(
        names=("e1_mpa", "e2_mpa", "nu12", "g12_mpa"),
        matrix=tuple(tuple(float(x) for x in row) for row in MATRIX),
    )
    return PlyCard(name="cfrp", synthetic=False, constants=constants, covariance=covariance)


def test_draws_have_the_cards_mean_and_covariance(card: PlyCard) -> None:
    draws = sample_constants(card, 40000, seed=1)
    names = list(card.covariance.names) if card.covariance else []
    errors = np.sqrt(np.diag(MATRIX))
    distance = (draws[names].mean() - [PUBLISHED_PLY[n] for n in names]) / (errors / np.sqrt(40000))
    assert np.abs(distance).max() < 4
    correlation = MATRIX / np.outer(errors, errors)
    seen = draws[names].corr().to_numpy()
    assert seen == pytest.approx(correlation, abs=4 / np.sqrt(40000))
    assert draws[names].std().to_numpy() == pytest.approx(errors, rel=0.02)


def test_ties_follow_and_assumed_numbers_stay(card: PlyCard) -> None:
    draws = sample_constants(card, 50, seed=1)
    for name, other in TIES.items():
        assert (draws[name] == draws[other]).all()
    assert (draws["g23_mpa"] == 2300.0).all()
    assert draws["e1_mpa"].nunique() == 50
    assert list(draws.columns) == list(PUBLISHED_PLY)
    assert sample_constants(card, 50, seed=1).equals(draws)
    assert not sample_constants(card, 50, seed=2).equals(draws)


def test_propagated_stiffness_has_the_error_of_the_delta_method(card: PlyCard) -> None:
    # Q11 = E1/(1 - ν12² E2/E1)
    def q11(e1: np.ndarray, e2: np.ndarray, nu12: np.ndarray) -> np.ndarray:
        return e1 / (1 - nu12**2 * e2 / e1)

    point = np.array([PUBLISHED_PLY["e1_mpa"], PUBLISHED_PLY["e2_mpa"], PUBLISHED_PLY["nu12"]])
    steps = np.diag([1.0, 1.0, 1e-6])
    gradient = np.array([(q11(*(point + s)) - q11(*(point - s))) / (2 * s.max()) for s in steps])
    expected = np.sqrt(gradient @ MATRIX[:3, :3] @ gradient)
    draws = sample_constants(card, 40000, seed=3)
    stiffness = q11(draws["e1_mpa"], draws["e2_mpa"], draws["nu12"])
    assert stiffness.std() == pytest.approx(expected, rel=0.02)


def test_a_card_without_covariance_stays_as_it_is(card: PlyCard) -> None:
    draws = sample_constants(card.model_copy(update={"covariance": None}), 3, seed=1)
    assert (draws == list(PUBLISHED_PLY.values())).all().all()


def test_covariance_of_the_means_is_what_repeated_campaigns_show() -> None:
    # truth: E1 and ν12 correlate within a specimen; ν12 is missing on the last specimen
    rng = np.random.default_rng(8)
    scatter = np.array([[4.0, 0.6], [0.6, 0.25]])
    means, stated = [], []
    for _ in range(800):
        values = rng.multivariate_normal([100.0, 10.0], scatter, size=6)
        names = [f"S-{i}" for i in range(6)]
        samples = {
            "e1_mpa": pd.Series(values[:, 0], names),
            "nu12": pd.Series(values[:5, 1], names[:5]),
        }
        covariance = covariance_of_means(samples, {"e1_mpa": "MPa", "nu12": "1"})
        assert covariance is not None
        means.append([s.mean() for s in samples.values()])
        stated.append(covariance.matrix)
    seen = np.cov(np.array(means).T)
    # 800 repetitions fix a variance within 5 %, the covariance within 8 % (one sigma)
    assert np.mean(stated, axis=0) == pytest.approx(seen, rel=0.2)
