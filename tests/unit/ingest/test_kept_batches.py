"""A batch of specimens in one process: only what changed is read, and no specimen stops another."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from nptcs.config.materials.ingest import IngestSettings
from nptcs.files import read_model, sha256_of_file
from nptcs.ingest.kept import is_kept
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.specimens import Specimen

ROOT = Path(__file__).parents[3]
NAMES = ("A", "B", "C")


def script() -> Any:
    spec = importlib.util.spec_from_file_location(
        "ingest_script", ROOT / "workflow/scripts/ingest.py"
    )
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.ingest


@pytest.fixture
def batch(lab, tmp_path):
    """Three specimens, the last with a file that is not a test; run and list what changed."""
    time = np.arange(0, 60, 0.5)
    columns = {"Time [s]": time, "Load [N]": 20 * time, "Strain [%]": 0.02 * time}
    for name in NAMES[:2]:
        lab.write(tmp_path / f"{name}.csv", columns)
    (tmp_path / "C.csv").write_text("nothing\n")
    row = {"test": "tension", "material": "m", "orientation_deg": 0, "width_mm": (10.0,),
           "thickness_mm": (1.0,)}  # fmt: skip

    def run(**changes: Any) -> list[str]:
        specimens = [Specimen(specimen=n, force_file=f"{n}.csv", **row) for n in NAMES]
        job = {
            "specimens": [
                {"specimen": one.model_dump(mode="json"),
                 "files": {one.force_file: sha256_of_file(tmp_path / one.force_file)}}
                for one in specimens
            ],
            "folder": str(tmp_path),
            "formats": str(ROOT / "config/formats"),
            "profiles": "p",
            "settings": IngestSettings().model_dump(mode="json"),
            "code": "c",
        } | changes  # fmt: skip
        paths = [[str(tmp_path / "out" / f"{n}.{end}") for n in NAMES] for end in ("csv", "json")]
        before = {n: (tmp_path / "out" / f"{n}.json") for n in NAMES}
        inodes = {n: path.stat().st_ino if path.exists() else 0 for n, path in before.items()}
        script()(job, *paths)
        return [n for n, path in before.items() if path.stat().st_ino != inodes[n]]

    (tmp_path / "out").mkdir()
    return run


def test_only_what_changed_is_read_again(batch, lab, tmp_path):
    assert batch() == ["A", "B", "C"]
    status = [read_model(tmp_path / f"out/{n}.json", IngestRecord).status for n in NAMES]
    assert status == ["ok", "ok", "error"]
    assert batch() == []
    (tmp_path / "B.csv").write_text((tmp_path / "B.csv").read_text() + "\n")
    assert batch() == ["B"]
    assert batch(code="another") == ["A", "B", "C"]


@pytest.mark.parametrize("damage", ["edited", "missing curve", "edited record", "missing record"])
def test_a_damaged_result_is_made_again(batch, tmp_path, damage):
    batch()
    curve, record = tmp_path / "out/A.csv", tmp_path / "out/A.json"
    path = record if "record" in damage else curve
    if "missing" in damage:
        path.unlink()
    else:
        path.write_text(path.read_text().replace("1", "2", 1))
    assert not is_kept(curve, record, "")
    assert batch() in (["A"], [])  # a record that was unlinked may get its old inode
    made = read_model(record, IngestRecord)
    assert made.curve_sha256 == sha256_of_file(curve)
    assert is_kept(curve, record, made.made_from)
