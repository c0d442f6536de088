"""How often failure is seen where there is none, and missed where there is some.

``python benchmarks/failure_evidence.py [COUNT] [SEED]`` simulates COUNT records of each kind, in
which the specimen breaks (at once, over some readings, gradually, in steps) or does not (stopped,
held, unloaded slowly or quickly, unloaded by half, cycled), with noise and at many rates, and
judges them with other thresholds as well. A false positive is a failure seen in a test that did not
break: a stopped test is given a strength. A false negative withholds a strength and says why.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

import numpy as np

from nptcs.arrays import Array
from nptcs.loading import failure, judge_failure

Record = tuple[Array, Array]
Draw = Callable[[np.random.Generator, Array, float], Record]


def broken_at_once(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Add one to four readings near zero."""
    count = int(random.integers(1, 5))
    rest = np.full(count, strain[-1] * random.uniform(0, 1.1))
    fallen = slope * strain[-1] * random.uniform(0, 0.4, count)
    return np.append(slope * strain, fallen), np.append(strain, rest)


def broken_over_readings(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Let the force fall over up to 3 % of the readings, while the gauge springs back."""
    count = max(3, int(random.uniform(0.005, 0.03) * len(strain)))
    share = np.linspace(1, random.uniform(0, 0.3), count)
    back = 1 - random.uniform(0, 0.6) * np.linspace(0, 1, count) ** 2
    return np.append(slope * strain, slope * strain[-1] * share), np.append(
        strain, strain[-1] * back
    )


def broken_gradually(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Let damage lower the force by 15 to 90 % while the strain keeps growing."""
    rest = strain[-1] * np.linspace(1, random.uniform(1.1, 1.6), len(strain) // 2)[1:]
    fall = np.linspace(1, random.uniform(0.1, 0.85), len(rest))
    return np.append(slope * strain, slope * strain[-1] * fall), np.append(strain, rest)


def broken_in_steps(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Let plies or tows fail one after the other, at constant travel."""
    steps = np.sort(random.uniform(0.1, 1.0, 4))[::-1]
    rest = strain[-1] * (1 + 0.02 * np.repeat(np.arange(4), 5))
    return np.append(slope * strain, slope * strain[-1] * np.repeat(steps, 5)), np.append(
        strain, rest
    )


def stopped(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """End the record at the largest force."""
    return slope * strain, strain


def held(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Let the force relax by up to a third at a strain that is held or creeps a little."""
    rest = np.linspace(0, 1, int(random.uniform(0.1, 1) * len(strain)) + 3)[1:]
    fall = 1 - random.uniform(0.02, 0.33) * (1 - np.exp(-4 * rest))
    still = strain[-1] * (1 + random.uniform(0, 0.004) * rest)
    return np.append(slope * strain, slope * strain[-1] * fall), np.append(strain, still)


def broken_and_returned(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Break within one to four readings; then the machine returns at up to 100 times the speed."""
    fall = np.linspace(1, random.uniform(0, 0.1), int(random.integers(1, 5)) + 1)[1:]
    still = strain[-1] * (1 + 0.001 * np.arange(int(random.integers(0, 30))))
    down = strain[-1] * np.linspace(1, 0, max(int(len(strain) / random.uniform(1, 100)), 2))[1:]
    after = np.concatenate([np.full(len(fall), strain[-1]), still, down])
    force = np.full(len(after), slope * strain[-1] * fall[-1])
    force[: len(fall)] = slope * strain[-1] * fall
    return np.append(slope * strain, force), np.append(strain, after)


def _unload(random: np.random.Generator, strain: Array, slope: float, rate: float) -> Record:
    down = np.linspace(1, random.uniform(0, 0.3), max(int(len(strain) / rate), 5))[1:]
    hysteresis = 1 - random.uniform(0, 0.12) * 4 * down * (1 - down)
    return np.append(slope * strain, slope * strain[-1] * down * hysteresis), np.append(
        strain, strain[-1] * down
    )


def unloaded(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Unload at the speed of the test or up to four times as fast."""
    return _unload(random, strain, slope, random.uniform(0.5, 4))


def unloaded_quickly(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Return the crosshead 10 to 100 times as fast."""
    return _unload(random, strain, slope, random.uniform(10, 100))


def unloaded_with_a_set(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Let a laminate yield, and unload it elastically at up to 60 times the speed."""
    bent = strain[-1] / random.uniform(1, 5)
    force = slope * bent * np.tanh(strain / bent)
    down = np.linspace(1, random.uniform(0, 0.3), max(int(len(strain) / random.uniform(1, 60)), 5))
    left = strain[-1] - force[-1] / slope
    back = left + (strain[-1] - left) * down[1:]
    return np.append(force, force[-1] * down[1:]), np.append(strain, back)


def returned_softened(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Return a filled rubber up to ten times as fast, with far less force on the way back."""
    return _soften(random, strain, slope, random.uniform(1, 10))


def returned_softened_quickly(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Return a filled rubber 10 to 100 times as fast."""
    return _soften(random, strain, slope, random.uniform(10, 100))


def softened_with_a_set(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Yield, then return 10 to 100 times as fast, softened, with a set of an eighth to a half."""
    bent = strain[-1] / random.uniform(1, 3)
    force, back = _soften(random, strain, slope, random.uniform(10, 100), random.uniform(0.12, 0.5))
    return np.append(slope * bent * np.tanh(strain / bent), np.tanh(1) * force[len(strain) :]), back


def _soften(
    random: np.random.Generator,
    strain: Array,
    slope: float,
    rate: float,
    left: float | None = None,
) -> Record:
    down = np.linspace(1, 0.0, max(int(len(strain) / rate), 5))[1:]
    left = random.uniform(0.0, 0.25) if left is None else left
    share = np.clip((down - left) / (1 - left), 0, None) ** random.uniform(1.5, 4)
    return np.append(slope * strain, slope * strain[-1] * share), np.append(
        strain, strain[-1] * down
    )


def cycled(random: np.random.Generator, strain: Array, slope: float) -> Record:
    """Load, unload by half to all, load again, and stop."""
    low = random.uniform(0.0, 0.5)
    course = np.concatenate([strain, strain[::-1][: int((1 - low) * len(strain))]])
    course = np.append(course, np.linspace(course[-1], 1.05 * strain[-1], len(strain)))
    return slope * course, course


BREAKS: tuple[Draw, ...] = (
    broken_at_once,
    broken_over_readings,
    broken_gradually,
    broken_in_steps,
    broken_and_returned,
)
STOPS: tuple[Draw, ...] = (
    stopped,
    held,
    unloaded,
    unloaded_quickly,
    unloaded_with_a_set,
    returned_softened,
    returned_softened_quickly,
    softened_with_a_set,
    cycled,
)
THRESHOLDS = (
    (0.1, 10.0, 100.0), (0.05, 10.0, 100.0), (0.2, 10.0, 100.0), (0.1, 5.0, 100.0),
    (0.1, 10.0, 50.0), (0.1, 10.0, 20.0),
)  # fmt: skip


def record(draw: Draw, random: np.random.Generator) -> Record:
    """Return a record of a kind: force in N and strain, both with noise."""
    top, rows = random.uniform(0.003, 0.02), int(random.integers(60, 3000))
    force, strain = draw(random, np.linspace(0, top, rows), 1e6)
    noise = float(random.choice([0, 1e-4, 1e-3, 5e-3]))
    force = force + noise * force.max() * random.standard_normal(len(force))
    strain = strain + 0.3 * noise * top * random.standard_normal(len(strain))
    return force, strain


def main(count: int = 500, seed: int = 1) -> None:
    """Print a line for each set of thresholds, and one for each kind with those in force."""
    random = np.random.default_rng(seed)
    kinds = {draw: [record(draw, random) for _ in range(count)] for draw in (*BREAKS, *STOPS)}
    print(f"{count} records of each kind, seed {seed}")
    print("| fall | abrupt | snap | false positives, % | false negatives, % |")
    print("|---|---|---|---|---|")
    own = (failure.SMALLEST_DROP, failure.ABRUPT, failure.SNAP)
    for drop, abrupt, snap in THRESHOLDS:
        failure.SMALLEST_DROP, failure.ABRUPT, failure.SNAP = drop, abrupt, snap
        seen = {draw: [judge_failure(*one).seen for one in kinds[draw]] for draw in kinds}
        positive = 100 * np.mean([seen[draw] for draw in STOPS])
        negative = 100 - 100 * np.mean([seen[draw] for draw in BREAKS])
        mark = " (in force)" if (drop, abrupt, snap) == own else ""
        print(f"| {drop:g}{mark} | {abrupt:g} | {snap:g} | {positive:.2f} | {negative:.2f} |")
        if mark:
            shares = {draw.__name__: 100 * np.mean(seen[draw]) for draw in kinds}
    print()
    for name, share in shares.items():
        print(f"{name.replace('_', ' '):22} failure seen in {share:5.1f} %")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
