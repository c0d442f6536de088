"""Plan the next run of several project folders in one process: ``plan_increments.py FOLDER…``."""

import contextlib
import io
import json
import os
import re
import sys
from pathlib import Path

from snakemake.cli import main
from snakemake.utils import update_config

from nptcs import provenance
from nptcs.campaign.plan import known_cases
from nptcs.campaign.record import RecordStore
from nptcs.config.root import read_config
from nptcs.files import read_model
from nptcs.start import facts
from nptcs.tables.laboratory.material_card import MaterialCard
from nptcs.yaml_files import read_yaml

CONFIG = "config/increments.yaml"


def plan(folder):
    """Return the planned jobs by rule and the cases that would be solved."""
    os.chdir(folder)
    facts.PACKAGE = provenance._ROOT = Path(folder) / "workflow/src/nptcs"
    out, code = io.StringIO(), None
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        try:
            main(["-n", "-j2", "--configfile", CONFIG])
        except SystemExit as end:
            code = end.code
    if code:
        raise RuntimeError(f"{folder}:\n{out.getvalue()[-3000:]}")
    jobs = re.findall(r"^(?:local)?rule (\w+):$", out.getvalue(), re.MULTILINE)
    counts = {name: jobs.count(name) for name in jobs}
    return {"jobs": counts, "cases": unknown() if "solve" in counts else 0}


def unknown():
    """Count the cases that are not in the store of the current folder."""
    values = read_yaml("config/config.yaml")
    update_config(values, read_yaml(CONFIG))  # as Snakemake joins them
    config = read_config(values)
    card = read_model("results/material_card.json", MaterialCard)
    store = RecordStore("results/5_solve/records")
    number = 0
    for study in config.studies:
        known = known_cases(study, config, card, store)
        number += sum(study.number_of_cases() - (count or 0) for count in known.values())
    return number


if __name__ == "__main__":
    print(json.dumps([plan(folder) for folder in sys.argv[1:]]))
