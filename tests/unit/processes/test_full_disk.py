"""A full disk and missing permissions: what to do is said, and nothing half written is left."""

import errno
import resource
import subprocess
import sys

import pytest

from nptcs.cli import main
from nptcs.console import clear_errors
from nptcs.errors import REMEDIES, explained
from nptcs.files import UNFINISHED, atomic_path, remove_unfinished, write_text


@pytest.mark.parametrize("number", sorted(REMEDIES))
def test_each_known_error_has_words_and_a_remedy(number):
    error = explained(OSError(number, "as the system says", "results/a.csv"))
    assert error.remedy.endswith("no half-written file is left")
    assert str(error).startswith("results/a.csv: ")


def test_other_errors_keep_their_traceback(tmp_path):
    assert explained(FileNotFoundError(errno.ENOENT, "no", "a")) is None
    with pytest.raises(FileNotFoundError), clear_errors(tmp_path / "a.log"):
        (tmp_path / "nothing").read_text()


def fill(path):
    """What writing to a full disk raises."""
    with atomic_path(path) as temporary:
        temporary.write_bytes(b"half")
        raise OSError(errno.ENOSPC, "No space left on device")


def test_a_script_on_a_full_disk_says_what_to_do(tmp_path, capsys):
    with pytest.raises(SystemExit), clear_errors(tmp_path / "a.log"):
        fill(tmp_path / "results/a.csv")
    assert "a.csv: the disk is full. Remedy: make room" in (tmp_path / "a.log").read_text()
    assert "the disk is full" in capsys.readouterr().err
    assert list((tmp_path / "results").iterdir()) == []


def test_a_message_that_cannot_be_kept_is_on_the_screen(tmp_path, capsys, monkeypatch):
    def full(*_, **__):
        raise OSError(errno.ENOSPC, "No space left on device")

    def script():
        with clear_errors(tmp_path / "a.log"):
            monkeypatch.setattr("pathlib.Path.write_text", full)
            fill(tmp_path / "b.csv")

    with pytest.raises(SystemExit):
        script()
    assert "Remedy" in capsys.readouterr().err


LIMITED = """
import resource, signal
from pathlib import Path
from nptcs.files import write_text
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
write_text(Path({file!r}), "x" * 5000)
"""


def test_a_real_limit_leaves_the_old_file_whole(tmp_path):
    file = tmp_path / "a.csv"
    write_text(file, "old\n")
    run = [sys.executable, "-c", LIMITED.format(file=str(file))]
    done = subprocess.run(run, capture_output=True, text=True, check=False)
    assert f"[Errno {errno.EFBIG}]" in done.stderr
    assert file.read_text() == "old\n"
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]
    assert resource.getrlimit(resource.RLIMIT_FSIZE)[0] != 1000


def test_a_command_says_what_to_do(tmp_path, monkeypatch, capsys):
    def full(*_):
        raise OSError(errno.EROFS, "Read-only file system", str(tmp_path / "a"))

    monkeypatch.setattr("nptcs.commands.example.run", full)
    assert main(["example", str(tmp_path)]) == 2
    assert "this disk is read-only. Remedy: choose a folder" in capsys.readouterr().err


def test_files_of_killed_processes_are_removed_and_others_stay(tmp_path):
    code = (
        "import os, signal\nfrom nptcs.files import atomic_path\n"
        f"with atomic_path({str(tmp_path / 'deep/a.csv')!r}):\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=False)
    elsewhere = tmp_path / f"{UNFINISHED}another-host-1-x.csv"
    elsewhere.touch()
    with atomic_path(tmp_path / "b.csv"):
        (removed,) = remove_unfinished(tmp_path)
    assert removed.parent.name == "deep"
    assert elsewhere.exists()
    assert (tmp_path / "b.csv").exists()
