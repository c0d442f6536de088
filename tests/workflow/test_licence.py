"""Licence tokens of a user's solver are a resource that the solve rule does not overdraw."""

import os
import subprocess
import sys
from itertools import accumulate
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
SNAKEFILE = str(ROOT / "Snakefile")
SOLVER = '''
"""Holds five tokens for a while, and writes down when."""

import os
import time

from nptcs.solvers.contract import Solver, SolverOptions, SolverResult, Status


class Options(SolverOptions):
    log: str

    def tokens_per_case(self):
        return 5


def note(path, word):
    line = f"{time.monotonic():.6f} {word}\\n".encode()
    handle = os.open(path, os.O_APPEND | os.O_CREAT | os.O_WRONLY)
    os.write(handle, line)
    os.close(handle)


def solve(inputs):
    note(inputs.options.log, "take")
    time.sleep(1.0)
    note(inputs.options.log, "give")
    return SolverResult(
        status=Status.OK, vertical_stiffness_n_per_mm=250.0, displacement_mm=inputs.load_n / 250.0
    )


SOLVER = Solver(
    name="holder",
    version="1",
    about="holds a token",
    solve=solve,
    factors=frozenset({"spoke_c10_mpa"}),
    options=Options,
)
'''


def run(folder, cores_per_batch, batches, limit):
    """Solve four cases with `limit` tokens; return the run and the most tokens held at a time."""
    (folder / "raw_data").symlink_to(ROOT / "raw_data")
    (folder / "config").mkdir()
    (folder / "config/formats").symlink_to(ROOT / "config/formats")
    (folder / "holder.py").write_text(SOLVER)
    log = folder / "tokens.log"
    study = {
        "name": "held",
        "title": "Four cases",
        "factors": [
            {"name": "spoke_c10_mpa", "label": "C10", "unit": "MPa", "levels": [1, 2, 3, 4]}
        ],
        "solvers": ["holder"],
        "terms": ["1", "spoke_c10_mpa"],
    }
    config = {
        "studies": [study],
        "solvers": {"holder": {"module": "holder.py", "log": str(log)}},
        "campaign": {"batches": batches, "cores_per_batch": cores_per_batch},
    }
    (folder / "config/config.yaml").write_text(yaml.safe_dump(config))
    targets = [f"results/5_solve/held/holder/batch_{i + 1}.jsonl" for i in range(batches)]
    command = [
        *(sys.executable, "-m", "snakemake", "-s", SNAKEFILE, "-d", str(folder)),
        *("-j4", "--resources", f"licence_tokens={limit}", "--workflow-profile", "none"),
        *("--scheduler", "greedy", "--", *targets),
    ]
    source = str(ROOT / "workflow" / "src")
    done = subprocess.run(
        command,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": source, "OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    words = (
        [line.split()[1] for line in sorted(log.read_text().splitlines())] if log.exists() else []
    )
    held = list(accumulate(5 if word == "take" else -5 for word in words))
    return done, len(words) // 2, max(held, default=0)


@pytest.mark.parametrize(
    ("cores_per_batch", "batches", "limit", "most"),
    [
        (1, 4, 10, 10),  # four jobs of five tokens each: two at a time
        (4, 1, 14, 10),  # one job of twenty tokens, cut to fourteen: two of its cases at a time
    ],
)
def test_no_more_tokens_are_held_than_there_are(tmp_path, cores_per_batch, batches, limit, most):
    done, cases, held = run(tmp_path, cores_per_batch, batches, limit)
    assert done.returncode == 0, done.stderr[-4000:]
    assert cases == 4
    assert 5 <= held <= most


def test_a_limit_below_one_case_is_refused_in_words(tmp_path):
    done, cases, _ = run(tmp_path, 1, 1, 4)
    assert done.returncode != 0
    assert cases == 0
    told = (tmp_path / "results/logs/solve/held_holder_1.log").read_text()
    assert "one case takes 5 licence tokens, but this run has 4" in told
