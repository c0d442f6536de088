"""Simulated tests: a specimen drawn from its series, loaded to failure and measured."""

from __future__ import annotations

from dataclasses import dataclass
from typing import assert_never

import numpy as np

from nptcs.arrays import Array
from nptcs.example import truth
from nptcs.example.materials import POISSON_45, shear_stress, yeoh_c10, yeoh_stress
from nptcs.example.truth import Series
from nptcs.mechanical_tests import TestType

POISSON_CV = 0.03
LOAD_CELL_NOISE = 2e-4
"""Standard deviation of the force, as a share of the largest force of the test."""


@dataclass(frozen=True)
class Readings:
    """What the machine and the strain measurement would show without noise.

    Strains are those of the material; forces and strains are negative in compression.
    """

    time_s: Array
    force_n: Array
    axial: Array
    transverse: Array


@dataclass(frozen=True)
class Draw:
    """One specimen: stations in mm, and its true properties."""

    name: str
    width_mm: tuple[float, ...]
    thickness_mm: tuple[float, ...]
    modulus: float
    poisson: float
    strength_mpa: float

    @property
    def area_mm2(self) -> float:
        """Mean width × mean thickness."""
        return float(np.mean(self.width_mm) * np.mean(self.thickness_mm))


def draw(series: Series, number: int, random: np.random.Generator) -> Draw:
    """Draw a specimen: modulus (E, G or C10), Poisson's ratio, strength, three stations."""
    name = f"{series.prefix}-{number}"
    modulus = _mean_modulus(series) * (1 + series.modulus_cv * random.standard_normal())
    poisson = _mean_poisson(series) * (1 + POISSON_CV * random.standard_normal())
    strength = series.strength_mpa * (1 + series.strength_cv * random.standard_normal())
    if name in truth.LEFT_OUT:
        strength *= 0.35
    width = series.width_mm * (1 + 0.004 * random.standard_normal(3))
    thickness = series.thickness_mm * (1 + 0.008 * random.standard_normal(3))
    return Draw(
        name,
        tuple(round(float(station), 2) for station in width),
        tuple(round(float(station), 3) for station in thickness),
        modulus,
        poisson,
        strength,
    )


def not_simulated(test: TestType) -> ValueError:
    """Return the error for a test type that the example data do not contain."""
    return ValueError(f"the example simulates no {test} test")


def _mean_modulus(series: Series) -> float:
    match series.test:
        case TestType.SHEAR:
            return truth.G12_MPA
        case TestType.RUBBER_TENSION:
            return truth.C10_MPA[series.material]
        case TestType.TENSION | TestType.COMPRESSION:
            return truth.E1_MPA if series.orientation_deg == 0 else truth.E2_MPA
        case (
            TestType.RUBBER_EQUIBIAXIAL
            | TestType.RUBBER_PURE_SHEAR
            | TestType.RUBBER_COMPRESSION
            | TestType.FLEXURE
        ):
            raise not_simulated(series.test)
        case _:
            assert_never(series.test)


def _mean_poisson(series: Series) -> float:
    match series.test:
        case TestType.SHEAR:
            return POISSON_45
        case TestType.RUBBER_TENSION:
            return 0.5
        case TestType.TENSION | TestType.COMPRESSION:
            return truth.NU12 if series.orientation_deg == 0 else truth.NU21
        case (
            TestType.RUBBER_EQUIBIAXIAL
            | TestType.RUBBER_PURE_SHEAR
            | TestType.RUBBER_COMPRESSION
            | TestType.FLEXURE
        ):
            raise not_simulated(series.test)
        case _:
            assert_never(series.test)


def load_to_break(series: Series, specimen: Draw, rate_hz: float) -> Readings:
    """Load a specimen at constant strain rate until it breaks, and keep recording after that."""
    strain = np.linspace(0, _largest_strain(series), 20_001)
    stress, axial, transverse = _response(series, specimen, strain)
    broken = stress >= specimen.strength_mpa
    end = int(np.argmax(broken)) if broken.any() else len(strain) - 1
    time = np.arange(0, series.duration_s * 1.03, 1 / rate_hz)
    at = strain[end] * time / series.duration_s
    sign = float(series.test.load_sign)
    force = sign * np.interp(at, strain[: end + 1], stress[: end + 1]) * specimen.area_mm2
    force[at > strain[end]] *= 0.04
    return Readings(
        time,
        force,
        sign * np.interp(at, strain, axial),
        -sign * np.interp(at, strain, transverse),
    )


def _largest_strain(series: Series) -> float:
    match series.test:
        case TestType.RUBBER_TENSION:
            return 1.6
        case TestType.SHEAR:
            return 0.09
        case TestType.TENSION | TestType.COMPRESSION:
            return 0.03
        case (
            TestType.RUBBER_EQUIBIAXIAL
            | TestType.RUBBER_PURE_SHEAR
            | TestType.RUBBER_COMPRESSION
            | TestType.FLEXURE
        ):
            raise not_simulated(series.test)
        case _:
            assert_never(series.test)


def _response(series: Series, specimen: Draw, strain: Array) -> tuple[Array, Array, Array]:
    """Stress, axial strain and transverse contraction over the strain that drives the test."""
    match series.test:
        case TestType.SHEAR:
            axial = strain / (1 + specimen.poisson)
            return 2 * shear_stress(strain, specimen.modulus), axial, specimen.poisson * axial
        case TestType.RUBBER_TENSION:
            contraction = 1 - (1 + strain) ** -0.5
            return yeoh_stress(strain, yeoh_c10(specimen.modulus)), strain, contraction
        case TestType.TENSION | TestType.COMPRESSION:
            return specimen.modulus * strain, strain, specimen.poisson * strain
        case (
            TestType.RUBBER_EQUIBIAXIAL
            | TestType.RUBBER_PURE_SHEAR
            | TestType.RUBBER_COMPRESSION
            | TestType.FLEXURE
        ):
            raise not_simulated(series.test)
        case _:
            assert_never(series.test)


def with_noise(readings: Array, deviation: float, random: np.random.Generator) -> Array:
    """Add normal noise of this standard deviation."""
    return readings + deviation * random.standard_normal(len(readings))


def cell_force(readings: Readings, random: np.random.Generator) -> Array:
    """Force as the load cell shows it."""
    return with_noise(
        readings.force_n, LOAD_CELL_NOISE * float(np.abs(readings.force_n).max()), random
    )


def with_toe(strain: Array, force: Array, toe: float, force_scale: float) -> Array:
    """Add the slack that a seating extensometer shows: toe · (1 - exp(-F / scale))."""
    return strain + toe * (1 - np.exp(-np.abs(force) / force_scale))


def from_preload(readings: Readings, preload_n: float) -> Readings:
    """Start the record at a preload, with time and strains set to zero there."""
    first = int(np.argmax(np.abs(readings.force_n) >= preload_n))
    return Readings(
        readings.time_s[first:] - readings.time_s[first],
        readings.force_n[first:],
        readings.axial[first:] - readings.axial[first],
        readings.transverse[first:] - readings.transverse[first],
    )
