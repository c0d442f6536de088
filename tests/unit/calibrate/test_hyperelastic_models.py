from pathlib import Path
from typing import Any

import numpy as np
import pytest

from nptcs.calibrate.drucker import instabilities
from nptcs.calibrate.fit import fit_model
from nptcs.calibrate.invariants import (
    MODES,
    MOONEY_RIVLIN,
    NEO_HOOKEAN,
    SECOND_STRETCH,
    YEOH,
    stretches,
)
from nptcs.calibrate.observations import Observation
from nptcs.calibrate.ogden import ogden
from nptcs.errors import InputError

LABDATA = Path(__file__).resolve().parents[3] / ".." / "shared" / "labdata"
CASES: list[tuple[Any, list[float]]] = [
    (NEO_HOOKEAN, [1.18]),
    (MOONEY_RIVLIN, [0.9, 0.25]),
    (YEOH, [1.18, -0.15, 0.03]),
    (ogden(1), [2.3, 2.7]),
    (ogden(2), [0.4, 1.3, 0.01, 5.0]),
    (ogden(3), [0.4, 1.3, 0.003, 5.0, 0.01, -2.0]),
]
IDS = ["neo_hookean", "mooney_rivlin", "yeoh", "ogden1", "ogden2", "ogden3"]
STRETCH = np.array([0.6, 0.8, 0.99, 1.01, 1.15, 1.5, 2.0, 3.0])
# forces that do work when λ grows: one, two (equibiaxial) and one
WORKING = {
    "rubber_tension": 1.0,
    "rubber_equibiaxial": 2.0,
    "rubber_pure_shear": 1.0,
    "rubber_compression": 1.0,
}


def data(
    model: Any, constants: Any, mode: str = "rubber_tension", high: float = 2.0, n: int = 40
) -> Observation:
    stretch = np.linspace(1.0, 1.0 + high, n + 1)[1:]
    stress = model.stress(mode, stretch, np.array(constants))
    return Observation(f"X-{mode}", mode, stretch, stress, np.full(n, 1 / n))


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize(("model", "constants"), CASES, ids=IDS)
def test_stress_is_the_derivative_of_the_energy(model: Any, constants: Any, mode: str) -> None:
    c, step = np.array(constants), 1e-5

    def energy(stretch: Any) -> Any:
        return model.energy(stretch, stretch ** SECOND_STRETCH[mode], c)

    numerical = (energy(STRETCH + step) - energy(STRETCH - step)) / (2 * step * WORKING[mode])
    assert model.stress(mode, STRETCH, c) == pytest.approx(numerical, rel=1e-6, abs=1e-8)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize(("model", "constants"), CASES, ids=IDS)
def test_tangent_is_the_hessian_of_the_energy(model: Any, constants: Any, mode: str) -> None:
    c, h = np.array(constants), 1e-4
    l1, l2, _ = stretches(mode, STRETCH)
    e1, e2 = np.log(l1), np.log(l2)

    def energy(a: float, b: float) -> Any:
        return model.energy(np.exp(e1 + a * h), np.exp(e2 + b * h), c)

    d11 = (energy(1, 0) - 2 * energy(0, 0) + energy(-1, 0)) / h**2
    d22 = (energy(0, 1) - 2 * energy(0, 0) + energy(0, -1)) / h**2
    d12 = (energy(1, 1) - energy(1, -1) - energy(-1, 1) + energy(-1, -1)) / (4 * h**2)
    tangent = model.tangent(l1, l2, c)
    scale = np.abs(tangent).max()
    for numerical, exact in ((d11, tangent[:, 0, 0]), (d22, tangent[:, 1, 1])):
        assert exact == pytest.approx(numerical, rel=1e-5, abs=1e-5 * scale)
    assert tangent[:, 0, 1] == pytest.approx(d12, rel=1e-5, abs=1e-5 * scale)
    assert tangent[:, 1, 0] == pytest.approx(tangent[:, 0, 1])


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize(("model", "constants"), CASES, ids=IDS)
def test_jacobian_is_the_derivative_by_the_constants(model: Any, constants: Any, mode: str) -> None:
    c, step = np.array(constants), 1e-6
    jacobian = model.jacobian(mode, STRETCH, c)
    for k in range(len(c)):
        shift = np.zeros(len(c))
        shift[k] = step
        difference = model.stress(mode, STRETCH, c + shift) - model.stress(mode, STRETCH, c - shift)
        assert jacobian[:, k] == pytest.approx(difference / (2 * step), rel=1e-5, abs=1e-7)


@pytest.mark.parametrize(("model", "constants"), CASES, ids=IDS)
def test_small_strain_limit_is_three_times_the_shear_modulus(model: Any, constants: Any) -> None:
    c, small = np.array(constants), 1e-6
    mu = model.initial_shear_modulus(c)
    for mode, factor in (
        ("rubber_tension", 3),
        ("rubber_equibiaxial", 6),
        ("rubber_pure_shear", 4),
    ):
        slope = model.stress(mode, np.array([1 + small]), c)[0] / small
        assert slope == pytest.approx(factor * mu, rel=1e-5)


@pytest.mark.parametrize("mode", MODES)
def test_ogden_contains_neo_hookean_and_mooney_rivlin(mode: str) -> None:
    one = ogden(1).stress(mode, STRETCH, np.array([2 * 1.18, 2.0]))
    assert one == pytest.approx(NEO_HOOKEAN.stress(mode, STRETCH, np.array([1.18])))
    two = ogden(2).stress(mode, STRETCH, np.array([2 * 0.9, 2.0, 2 * 0.25, -2.0]))
    assert two == pytest.approx(MOONEY_RIVLIN.stress(mode, STRETCH, np.array([0.9, 0.25])))
    l1, l2, _ = stretches(mode, STRETCH)
    assert ogden(2).tangent(l1, l2, np.array([1.8, 2.0, 0.5, -2.0])) == pytest.approx(
        MOONEY_RIVLIN.tangent(l1, l2, np.array([0.9, 0.25]))
    )


@pytest.mark.parametrize(("model", "constants"), CASES[:4], ids=IDS[:4])
def test_constants_are_recovered_from_exact_curves(model: Any, constants: Any) -> None:
    fit = fit_model(model, [data(model, constants)], 0.1)
    assert fit.constants == pytest.approx(constants, rel=1e-6)
    assert fit.rmse_mpa < 1e-8
    assert fit.r_squared == pytest.approx(1.0)
    together = [data(model, constants, mode, n=25) for mode in MODES]
    assert fit_model(model, together, 0.1).constants == pytest.approx(constants, rel=1e-6)


def test_ogden_with_two_terms_is_recovered_from_three_modes() -> None:
    # Treloar's range: the stiff term shows only at large stretch
    truth = [0.4095, 1.3, 0.003, 5.0]
    together = [data(ogden(2), truth, mode, 4.0) for mode in MODES]
    fit = fit_model(ogden(2), together, 0.1)
    assert fit.constants == pytest.approx(truth, rel=1e-4)


def test_residual_and_largest_error_are_what_they_say() -> None:
    exact = data(NEO_HOOKEAN, [1.0], high=0.15, n=30)
    stress = exact.stress * np.where(np.arange(30) % 2, 1.02, 0.98)
    noisy = Observation("X", exact.mode, exact.stretch, stress, exact.weight)
    fit = fit_model(NEO_HOOKEAN, [noisy], 0.1)
    model = fit.constants[0] * exact.stress
    assert fit.rmse_mpa == pytest.approx(np.sqrt(np.mean((model - stress) ** 2)))
    assert fit.largest_error_percent == pytest.approx(100 * np.abs(model / stress - 1).max())
    assert "too few specimens" in fit.covariance_rule


def test_relative_errors_are_not_evaluated_where_the_stress_is_nearly_nothing() -> None:
    exact = data(NEO_HOOKEAN, [1.0], high=0.15, n=30)
    stress = exact.stress.copy()
    stress[0] *= 2.0  # 0.5 % strain: 8 % of the largest stress
    stress[-1] *= 1.02
    noisy = Observation("X", exact.mode, exact.stretch, stress, exact.weight)
    assert fit_model(NEO_HOOKEAN, [noisy], 0.1).largest_error_percent < 3
    assert fit_model(NEO_HOOKEAN, [noisy], 0.01).largest_error_percent > 40


def test_regression_covariance_is_the_scatter_seen_over_repetitions() -> None:
    rng = np.random.default_rng(2)
    exact = data(MOONEY_RIVLIN, [0.9, 0.25], high=1.0, n=50)
    fits = []
    for _ in range(800):
        stress = exact.stress + rng.normal(0, 0.02, 50)
        fits.append(
            fit_model(
                MOONEY_RIVLIN,
                [Observation("X", exact.mode, exact.stretch, stress, exact.weight)],
                0.1,
            )
        )
    seen = np.cov(np.array([f.constants for f in fits]).T)
    stated = np.mean([f.covariance for f in fits], axis=0)
    # 800 repetitions fix a variance within 5 % (one sigma)
    assert stated == pytest.approx(seen, rel=0.2)


def test_specimen_scatter_gives_the_covariance_of_the_mean_for_any_linear_model() -> None:
    truths = np.array([[0.9, 0.25], [0.95, 0.22], [0.85, 0.30], [0.92, 0.26]])
    curves = [data(MOONEY_RIVLIN, truth, high=1.0) for truth in truths]
    fit = fit_model(MOONEY_RIVLIN, curves, 0.1)
    assert fit.constants == pytest.approx(truths.mean(axis=0))
    assert fit.covariance == pytest.approx(np.cov(truths.T) / 4)
    assert fit.covariance_rule == "scatter between 4 specimens (jackknife)"


def test_too_few_points_for_the_constants_are_refused() -> None:
    few = data(YEOH, [1.0, 0.0, 0.0], n=2)
    with pytest.raises(InputError, match="yeoh: 3 constants, the data determine 2"):
        fit_model(YEOH, [few], 0.1)
    with pytest.raises(InputError, match="ogden: 4 constants"):
        fit_model(ogden(2), [few], 0.1)


def test_stable_and_unstable_models() -> None:
    assert instabilities(NEO_HOOKEAN, np.array([1.18]), 3.0) == []
    assert instabilities(MOONEY_RIVLIN, np.array([0.9, 0.25]), 3.0) == []
    assert len(instabilities(NEO_HOOKEAN, np.array([-1.0]), 0.1)) == 6
    # μ > 0 in every term is sufficient in this convention (Ogden's own: μα > 0)
    assert instabilities(ogden(2), np.array([0.4, 1.3, -0.01, 5.0]), 5.0) != []
    assert instabilities(ogden(2), np.array([0.4, 1.3, 0.01, 5.0]), 5.0) == []


def test_instability_begins_where_the_hessian_of_the_energy_loses_definiteness() -> None:
    # the onset, bracketed by second differences of the energy itself
    constants, h = np.array([1.0, -0.4, 0.0]), 1e-4
    found = instabilities(YEOH, constants, 2.0)
    (uniaxial,) = [text for text in found if text.startswith("uniaxial tension")]
    onset = float(uniaxial.split()[-1])

    def lowest(strain: float) -> float:
        e1 = np.log(1 + strain)
        e2 = -e1 / 2

        def w(a: int, b: int) -> float:
            return float(YEOH.energy(np.exp(e1 + a * h), np.exp(e2 + b * h), constants))

        d11 = w(1, 0) - 2 * w(0, 0) + w(-1, 0)
        d22 = w(0, 1) - 2 * w(0, 0) + w(0, -1)
        d12 = (w(1, 1) - w(1, -1) - w(-1, 1) + w(-1, -1)) / 4
        return float(np.linalg.eigvalsh(np.array([[d11, d12], [d12, d22]]))[0])

    assert lowest(onset - 0.02) > 0 > lowest(onset + 0.02)


def test_equibiaxial_compression_is_uniaxial_tension_by_another_name() -> None:
    # λ in equibiaxial compression is the state λ⁻² in uniaxial tension
    constants = np.array([0.2676, -0.0018])
    found = instabilities(MOONEY_RIVLIN, constants, 6.0)
    assert [text.split(" from ")[0] for text in found] == ["equibiaxial compression"]
    compressed = 1 + float(found[0].split()[-1])
    further = instabilities(MOONEY_RIVLIN, constants, 14.0)
    (uniaxial,) = [text for text in further if text.startswith("uniaxial tension")]
    # onsets are found on 400 steps per path
    assert 1 + float(uniaxial.split()[-1]) == pytest.approx(compressed**-2, rel=0.03)


def read_treloar(name: str) -> tuple[Any, Any]:
    file = LABDATA / "rubber-treloar" / name / "stress_stretch.txt"
    if not file.exists():
        pytest.skip("Treloar's data are not next to this repository (shared/labdata)")
    stress, stretch = np.loadtxt(file).T
    return stretch, stress


def treloar() -> list[Observation]:
    found = []
    for name, mode in (
        ("UT", "rubber_tension"),
        ("ET", "rubber_equibiaxial"),
        ("PS", "rubber_pure_shear"),
    ):
        stretch, stress = read_treloar(name)
        found.append(Observation(name, mode, stretch, stress, np.full(len(stress), 1.0)))
    return found


def test_ogden_1972_on_treloar_uniaxial() -> None:
    stretch, stress = read_treloar("UT")
    # Ogden's own μ is 2μ/α in Abaqus' convention
    own = np.array([0.63, 0.0012, -0.01])
    alpha = np.array([1.3, 5.0, -2.0])
    constants = np.column_stack([own * alpha / 2, alpha]).ravel()
    model = ogden(3).stress("rubber_tension", stretch, constants)
    r_squared = 1 - ((model - stress) ** 2).sum() / ((stress - stress.mean()) ** 2).sum()
    assert r_squared == pytest.approx(0.97, abs=0.01)


def test_treloar_three_modes_together_rank_the_models() -> None:
    together = treloar()
    fits = {
        name: fit_model(model, together, 0.1)
        for name, model in {
            "neo_hookean": NEO_HOOKEAN,
            "mooney_rivlin": MOONEY_RIVLIN,
            "yeoh": YEOH,
            "ogden": ogden(3),
        }.items()
    }
    errors = {name: fit.rmse_mpa for name, fit in fits.items()}
    assert errors["ogden"] < errors["yeoh"] < errors["neo_hookean"]
    assert errors["mooney_rivlin"] <= errors["neo_hookean"]
    assert fits["ogden"].r_squared > 0.99
    # Treloar's rubber: initial shear modulus about 0.39 MPa (Treloar 1944), here from all modes
    assert ogden(3).initial_shear_modulus(fits["ogden"].constants) == pytest.approx(0.4, abs=0.06)
