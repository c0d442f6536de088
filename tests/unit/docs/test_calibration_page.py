"""The calibration of the spoke's section prints what its page shows, on coarse meshes.

With the default ones the command takes some minutes.
"""

import importlib.util
import json
import re
import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs/results/fe-against-paper.md"
COMPUTED = re.compile(r"(?<=k_t )[\d.]+|(?<=k_c )[\d.]+|(?<=K )[\d.]+|[-+][\d.]+(?= %)")
"""Stiffnesses, which are other ones on other meshes, and the tyres' differences in percent."""


def load(name):
    spec = importlib.util.spec_from_file_location(
        f"{name}_of_calibration", Path(__file__).with_name(f"{name}.py")
    )
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


small_tree = load("small_tree")


def shell(tree, line):
    return small_tree.shell([line], tree)


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    tree = tmp_path_factory.mktemp("calibration")
    for name in ("raw_data/published", "workflow/src"):
        shutil.copytree(ROOT / name, tree / name)  # with the machine code, where there is any
    small_tree.coarsen(tree)
    return shell(
        tree,
        "nptcs fe-calibrate raw_data/published/table10_spoke_stiffness.csv "
        "raw_data/published/table5_plate_doe.csv --ring paper_mesh",
    )


def test_each_round_prints_the_lines_of_the_page(printed):
    page = re.findall(r"^    ((?:spoke|tyre) .*)$", PAGE.read_text("utf-8"), re.MULTILINE)
    shown = [COMPUTED.sub("…", line) for line in page]
    assert shown[:7] == shown[7:]  # of both rings
    lines = [COMPUTED.sub("…", line.strip()) for line in printed.splitlines()]
    assert [line for line in lines if line.startswith(("spoke", "tyre"))] == 3 * shown[:7]


def test_the_rounds_bring_the_tyres_closer_to_the_paper(printed):
    misfit = [float(percent) for percent in re.findall(r"N/mm, ([-+][\d.]+) %", printed)]
    first, _, last = (misfit[i : i + 5] for i in (0, 5, 10))
    assert sum(map(abs, last)) < sum(map(abs, first)) / 2


def test_the_section_at_the_end_is_a_configuration_of_the_solver(printed):
    from nptcs.config.solvers.fe import FeModel

    model = FeModel.model_validate(json.loads(printed[printed.index("\n{") :]))
    assert model.geometry.calibrated_with == "paper_mesh"
