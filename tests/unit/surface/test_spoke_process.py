"""Surfaces over spokes that carry several rings."""

import numpy as np
import pytest

from nptcs.config.studies.surface import SpokeProcessModel, surface_name
from nptcs.doe.split_plot import split_plot
from nptcs.errors import InputError
from nptcs.surface.diagnostics.comparison import leave_one_out
from nptcs.surface.kinds.models import FitCases, fit_surface
from nptcs.surface.kinds.spoke_process import SpokeProcess
from nptcs.surface.registry import FittedSurface, SurfaceRegistry
from nptcs.surface.stored import dump_registry, load_registry
from nptcs.surface.study import RESPONSE
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

FACTORS = ("spacing_mm", "thickness_mm", "angle_deg", "shear_band_c10_mpa", "spoke_c10_mpa")
MODEL = SpokeProcessModel(kind="spoke_process", degree=3)
LOW = np.array([10.0, 1.2, 0.0, 4.0, 1.0])
HIGH = np.array([20.0, 2.4, 90.0, 6.0, 5.0])


def law(x):
    """A stiffness that is smooth in spoke and ring, and in which they act together."""
    s, t, a, band, spoke = x.T
    plates = np.cos(np.radians(a)) ** 4 * t**3 / s
    return (
        200
        * band**0.4
        * spoke ** (0.5 + 0.02 * np.log(band))
        * (1 + 0.1 * np.log1p(plates))
        / s**0.2
    )


def cases(plots=60, each=5):
    coded = split_plot(4, 1, plots, each, corners=True, seed=1)[:, [0, 1, 2, 4, 3]]
    return (LOW + HIGH) / 2 + coded * (HIGH - LOW) / 2


@pytest.fixture(scope="module")
def surface():
    x = cases()
    return fit_surface(MODEL, FitCases(x, law(x), FACTORS, (), PUBLISHED_PLY))


def test_it_follows_its_cases_and_predicts_unseen_ones(surface):
    residual = surface.predict(surface.x) / surface.y - 1
    # the processes may take a little of the spokes' law for noise
    assert np.abs(residual).max() < 1e-3
    unseen = LOW + np.random.default_rng(3).random((200, 5)) * (HIGH - LOW)
    error = surface.predict(unseen) / law(unseen) - 1
    assert np.sqrt(np.mean(error**2)) < 2e-3


def test_whole_spokes_are_left_out(surface):
    left_out = leave_one_out(surface)
    assert left_out.what == "all cases that share a spoke"
    by_spoke = left_out.error.reshape(5, 60)
    # a spoke's ring cases err together: nothing of the spoke was in the fit
    assert np.abs(by_spoke).max() > 3 * np.abs(surface.predict(surface.x) - surface.y).max()
    assert 80 <= left_out.coverage_percent <= 100


def test_the_interval_grows_away_from_the_spokes(surface):
    known, far = surface.x[:1], np.array([[30.0, 3.5, 45.0, 5.0, 9.0]])
    widths = []
    for x in (known, far):
        low, high = surface.interval(x)
        widths.append(float((high - low)[0] / surface.predict(x)[0]))
    assert widths[1] > 2 * widths[0]


def test_a_response_that_changes_sign_is_not_taken_as_a_logarithm():
    x = cases(30)
    surface = fit_surface(MODEL, FitCases(x, x[:, 4] - x[:, 3], FACTORS, (), PUBLISHED_PLY))
    assert not surface.logarithmic
    assert np.abs(surface.predict(x) - surface.y).max() < 1e-2


def test_it_is_read_back_from_its_file(surface):
    registry = SurfaceRegistry("joint", (FittedSurface("joint", "ring", "s", RESPONSE, surface),))
    again = load_registry(dump_registry(registry)).surfaces[0].surface
    assert isinstance(again, SpokeProcess)
    points = cases(20, 2)
    np.testing.assert_allclose(again.predict(points), surface.predict(points), rtol=1e-12)


@pytest.mark.parametrize(
    ("factors", "ply", "rows", "words"),
    [
        (FACTORS[:3], PUBLISHED_PLY, slice(None), "a surface over spokes has the factors"),
        (FACTORS, None, slice(None), "ply"),
        # two of five rings left on each spoke
        (FACTORS, PUBLISHED_PLY, slice(0, 120), "2 solved cases"),
        (FACTORS, PUBLISHED_PLY, np.arange(300) % 60 < 10, "10 spokes are too few"),
    ],
)
def test_cases_that_cannot_carry_it_are_refused(factors, ply, rows, words):
    x = cases()[rows]
    with pytest.raises(InputError, match=words):
        fit_surface(MODEL, FitCases(x[:, : len(factors)], law(x), factors, (), ply))


def test_its_name():
    assert surface_name(MODEL) == "spoke process"


def test_a_split_plot_has_the_same_rings_on_every_spoke():
    points = split_plot(4, 1, 40, 3, corners=True, seed=2)
    spokes = np.unique(points[:, :4], axis=0)
    assert points.shape == (120, 5)
    assert len(spokes) == 40
    assert np.abs(points).max() <= 1
    corners = spokes[(np.abs(spokes) == 1).all(axis=1)]
    assert len(corners) == 16
    assert sorted(set(points[:, 4].round(12))) == [-1, 0, 1]
    # the first case of every spoke comes before the second of any
    assert len(np.unique(points[:40, :4], axis=0)) == 40


def test_a_split_plot_needs_room_for_its_corners():
    with pytest.raises(InputError, match="16 corners"):
        split_plot(4, 1, 16, 3, corners=True, seed=1)
    assert len(split_plot(4, 2, 16, 3, corners=False, seed=1)) == 48
