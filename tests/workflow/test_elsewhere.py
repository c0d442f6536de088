"""The archive of a finished study is sound, and runs again in a deliberately awkward place."""

import json
import os
import shutil
import signal
import site
import subprocess
import sys
import time
import zipfile

import pytest

from nptcs.archive.crate import MANIFEST, METADATA
from nptcs.files import sha256_of_text

AWKWARD = "Prüfstelle – Reifen 轮胎 (lab)"
TABLE = "results/tables/cases.csv"


@pytest.fixture(scope="module")
def archive(finished, tmp_path_factory):
    target = tmp_path_factory.mktemp("archive") / "study.zip"
    done = finished.nptcs("archive", str(target))
    assert done.returncode == 0, done.stderr
    return target


def verify(project, archive):
    return project.nptcs("verify", str(archive))


def rewritten(archive, target, change):
    """Copy an archive; `change` gets a dictionary of its files."""
    with zipfile.ZipFile(archive) as source:
        files = {name: source.read(name) for name in source.namelist()}
    change(files)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as copy:
        for name, content in files.items():
            copy.writestr(name, content)
    return target


def test_an_archive_contains_what_the_study_was_made_from_and_verifies(finished, archive):
    done = verify(finished, archive)
    assert done.returncode == 0, done.stderr
    assert "all as packed" in done.stdout
    with zipfile.ZipFile(archive) as packed:
        names = set(packed.namelist())
        environment = json.loads(packed.read("environment.json"))
    for name in (
        "config/config.yaml",
        "raw_data/example/specimens.csv",
        "raw_data/published/table7_rubber_doe.csv",
        "workflow/Snakefile",
        "workflow/src/nptcs/cli.py",
        "results/material_card.json",
        "results/report.html",
        TABLE,
    ):
        assert name in names
    assert environment["packages"]["snakemake"]
    assert environment["linear_algebra"][0]["library"]


def test_the_metadata_are_a_workflow_ro_crate(archive):
    from rocrate.rocrate import ROCrate

    crate = ROCrate(archive)
    assert crate.mainEntity.id == "workflow/Snakefile"
    assert crate.mainEntity["programmingLanguage"]["name"] == "Snakemake"
    action = crate.get("#run")
    assert action["instrument"] == crate.mainEntity
    assert {entity.id for entity in action["result"]} >= {TABLE, "results/report.html"}
    assert "raw_data/example/specimens.csv" in {entity.id for entity in action["object"]}


def forge(files):
    """Change a number and its checksums alike."""
    rows = files[TABLE].decode().splitlines()
    status = rows[0].split(",").index("status")
    cells = rows[1].split(",")
    cells[status] = "fine"
    files[TABLE] = "\n".join([rows[0], ",".join(cells), *rows[2:], ""]).encode()
    new = sha256_of_text(files[TABLE].decode())
    metadata = json.loads(files[METADATA])
    entity = next(item for item in metadata["@graph"] if item["@id"] == TABLE)
    old, entity["sha256"] = entity["sha256"], new
    files[METADATA] = json.dumps(metadata).encode()
    lines = files[MANIFEST].decode().replace(old, new).splitlines()
    lines = [line for line in lines if not line.endswith(f"  {METADATA}")]
    digest = sha256_of_text(files[METADATA].decode())
    files[MANIFEST] = "\n".join([*lines, f"{digest}  {METADATA}", ""]).encode()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda files: files.update({TABLE: files[TABLE] + b"\n"}), f"{TABLE}: was changed"),
        (lambda files: files.pop("environment.json"), "environment.json: is missing"),
        (lambda files: files.update({"results/more.csv": b"a\n"}), "results/more.csv: was added"),
        (lambda files: files.update({METADATA: b"{}"}), f"{METADATA}: was changed"),
        (lambda files: files.pop(MANIFEST), "has no manifest"),
        (forge, "status"),
        (lambda files: files.update({"../escaped.txt": b"x"}), "leads out of the folder"),
    ],
    ids=["changed", "missing", "added", "metadata", "no manifest", "breaks a contract", "escapes"],
)
def test_a_changed_archive_is_refused(finished, archive, tmp_path, change, message):
    done = verify(finished, rewritten(archive, tmp_path / "changed.zip", change))
    assert done.returncode in (1, 2)
    assert message in done.stderr
    assert "Traceback" not in done.stderr


def test_half_an_archive_is_refused(finished, archive, tmp_path):
    half = tmp_path / "half.zip"
    half.write_bytes(archive.read_bytes()[: archive.stat().st_size // 2])
    done = verify(finished, half)
    assert done.returncode == 2
    assert "not a complete zip file" in done.stderr


def test_results_that_are_not_current_are_not_archived(project, tmp_path):
    project.edit("raw_data/published/table7_rubber_doe.csv", "591.18", "591.19")
    done = project.nptcs("archive", str(tmp_path / "study.zip"))
    assert done.returncode == 2
    assert "rules still to run" in done.stderr
    assert not (tmp_path / "study.zip").exists()


@pytest.fixture
def awkward(tmp_path):
    """A folder with blanks, umlauts and Chinese in its path, and an environment inside it."""
    folder = tmp_path / AWKWARD
    folder.mkdir()
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder / "env"], check=True)
    inside = next((folder / "env" / "lib").glob("python*/site-packages"))
    (inside / "outside.pth").write_text("\n".join(site.getsitepackages()) + "\n")
    return folder


def shell(folder, environment, *lines):
    return subprocess.run(
        ["/bin/sh", "-c", "\n".join(lines)],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )


def test_an_archive_runs_again_to_the_same_tables_in_an_awkward_place(archive, awkward):
    """C locale, umask 077, no solver on the path, read-only raw data: the tables are the same."""
    tools = awkward / "tools"
    tools.mkdir()
    for name in ("bash", "sh", "cat", "which"):
        if found := shutil.which(name):
            (tools / name).symlink_to(found)
    shutil.copy(archive, awkward / "study.zip")
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(awkward / "package")
    environment = {
        "PATH": f"{awkward / 'env' / 'bin'}:{tools}",
        "HOME": str(awkward),
        "LC_ALL": "C",
        "PYTHONPATH": str(awkward / "package" / "workflow" / "src"),
        "OPENBLAS_NUM_THREADS": "1",
    }
    done = shell(
        awkward,
        environment,
        "umask 077",
        'nptcs() { env/bin/python -m nptcs.cli "$@"; }',
        "nptcs verify study.zip --rerun again",
    )
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-6000:]
    assert "numbers differ by 0.0e+00" in done.stdout
    made = awkward / "again" / "results" / "report.html"
    assert made.stat().st_mode & 0o777 == 0o600
    with zipfile.ZipFile(archive) as packed:
        raw = [name for name in packed.namelist() if name.startswith("raw_data/")]
        for name in raw:
            assert (awkward / "again" / name).read_bytes() == packed.read(name)
    held = {
        path.relative_to(awkward / "again").as_posix()
        for path in (awkward / "again" / "raw_data").rglob("*")
        if path.is_file()
    }
    assert held == set(raw)


def test_snakemakes_own_report_has_the_main_outputs_with_captions(project):
    done = project.snakemake("--report", "snakemake-report.html")
    assert done.returncode == 0, done.stderr[-3000:]
    page = project.path("snakemake-report.html").read_text(encoding="utf-8")
    for caption in sorted(project.path("workflow/report").glob("*.rst")):
        words = " ".join(caption.read_text(encoding="utf-8").split()[:4])
        assert words in page, f"the caption {caption.name} is not in the report"


def test_a_second_run_on_one_folder_is_refused(project):
    """While one run makes the report, another one is refused and ends; the first succeeds."""
    project.path("results/report.html").unlink()
    first = subprocess.Popen(
        [sys.executable, "-m", "snakemake", "-j1", "--configfile", "config/small.yaml"],
        cwd=project.folder,
        env={**os.environ, "PYTHONPATH": str(project.folder / "workflow" / "src")},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    locks = project.path(".snakemake/locks")
    while not list(locks.glob("*.lock")):
        assert first.poll() is None, "the first run ended before it had locked the folder"
        time.sleep(0.05)
    first.send_signal(signal.SIGSTOP)  # otherwise it may end before the second one has planned
    second = project.snakemake()
    first.send_signal(signal.SIGCONT)
    assert first.wait() == 0
    assert second.returncode != 0
    # the second is Snakemake's where a file vanishes while it plans, before it asks for the lock
    refusals = ("cannot be locked", "could be that a concurrent process")
    assert any(words in second.stdout + second.stderr for words in refusals), second.stderr
    assert project.path("results/report.html").exists()
