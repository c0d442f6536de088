"""Scripts in forks of one process: each as isolated as in its own interpreter."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import psutil
import pytest

from nptcs.processes.hosted import HostGoneError, ScriptHost, environment_of, host_scripts

pytestmark = pytest.mark.skipif(
    sys.platform != "linux", reason="scripts run in forks on Linux only"
)


@pytest.fixture
def host():
    host = ScriptHost(sys.executable)
    yield host
    host.close()


@pytest.fixture
def script(tmp_path):
    """Writes a script and returns its path."""

    def write(text, name="script.py"):
        (tmp_path / name).write_text(text)
        return str(tmp_path / name)

    return write


def wait_for(file, seconds=10.0):
    end = time.monotonic() + seconds
    while not (file.exists() and file.read_text()) and time.monotonic() < end:
        time.sleep(0.02)
    return file.read_text()


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("pass", 0),
        ("import sys; sys.exit(0)", 0),
        ("import sys; sys.exit(3)", 3),
        ("import sys; sys.exit('a message')", 1),
        ("raise ValueError('a fault')", 1),
        ("not Python", 1),
        ("import nothing_of_this_name", 1),
        ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", -signal.SIGKILL),
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", -signal.SIGSEGV),
        ("import os; os._exit(5)", 5),
    ],
)
def test_the_exit_code_is_that_of_the_script(host, script, text, code):
    assert host.run(script(text), {}) == code
    assert host.run(script("pass"), {}) == 0  # the host goes on


def test_a_script_runs_as_python_would_run_it(host, script, tmp_path):
    out = tmp_path / "out"
    text = (
        "import os, sys, tempfile\n"
        "from pathlib import Path\n"
        "assert __name__ == '__main__' and sys.modules['__main__'].__dict__ is globals()\n"
        f"assert sys.argv == [__file__] and sys.path[0] == {str(tmp_path)!r}\n"
        f"Path({str(out)!r}).write_text(os.environ['A'] + tempfile.gettempdir() + os.getcwd())\n"
    )
    assert host.run(script(text), {"A": "b", "TMPDIR": str(tmp_path)}) == 0
    assert out.read_text() == f"b{tmp_path}{Path.cwd()}"


def test_what_a_script_imports_is_imported_once_and_what_it_does_stays_in_its_fork(
    host, script, tmp_path
):
    (tmp_path / "counted.py").write_text(
        "from pathlib import Path\nvalue = 1\n"
        f"with Path({str(tmp_path / 'count')!r}).open('a') as s:\n    s.write('x')\n"
    )
    text = (
        f"import sys\nsys.path.append({str(tmp_path)!r})\nimport os\n"
        "assert 'changed' not in os.environ\nos.environ['changed'] = 'yes'\n"
        "import counted\nassert counted.value == 1\ncounted.value = 2\n"
    )
    outside = script("import counted", "prepared.py")
    os.environ["PYTHONPATH"], before = str(tmp_path), os.environ.get("PYTHONPATH")
    try:
        aware = ScriptHost(sys.executable)
    finally:
        if before is None:
            del os.environ["PYTHONPATH"]
        else:
            os.environ["PYTHONPATH"] = before
    try:
        aware.prepare([outside, "not/there.py"])
        assert [aware.run(script(text), {}) for _ in range(3)] == [0, 0, 0]
    finally:
        aware.close()
    assert (tmp_path / "count").read_text() == "x"


def test_code_that_was_hashed_in_advance_is_not_hashed_again_in_a_fork(host, script):
    host.prepare([], ["nptcs.seal", "not.there"])
    text = script(
        "from nptcs.provenance import _examined as examined, code_hash\n"
        "code_hash('nptcs.seal')\n"
        "assert examined.cache_info()[:2] == (3, 1), examined.cache_info()\n"
    )
    deadline = time.monotonic() + 20.0
    while (code := host.run(text, {})) and time.monotonic() < deadline:
        time.sleep(0.1)  # jobs go first: what is done in advance may not have been done yet
    assert code == 0


def test_scripts_run_side_by_side(host, script, tmp_path):
    first = script(
        f"import time\nfrom pathlib import Path\nwhile not Path({str(tmp_path / 'b')!r}).exists():"
        "\n    time.sleep(0.01)\n",
        "first.py",
    )
    second = script(
        f"from pathlib import Path\nPath({str(tmp_path / 'b')!r}).touch()\n", "second.py"
    )
    codes = []
    waiting = threading.Thread(target=lambda: codes.append(host.run(first, {})))
    waiting.start()
    assert host.run(second, {}) == 0
    waiting.join(10)
    assert codes == [0]


LONG = (
    "import os, time\nfrom pathlib import Path\n"
    "Path({!r}).write_text(str(os.getpid()))\ntime.sleep(600)\n"
)


@pytest.mark.parametrize("how", ["killed", "closed"])
def test_no_script_outlives_its_host(script, tmp_path, how):
    host = ScriptHost(sys.executable)
    failed = []

    def run():
        try:
            failed.append(host.run(script(LONG.format(str(tmp_path / "pid"))), {}))
        except HostGoneError:
            failed.append(None)

    waiting = threading.Thread(target=run)
    waiting.start()
    pid = int(wait_for(tmp_path / "pid"))
    if how == "killed":
        host._process.kill()
    host.close()
    waiting.join(10)
    assert failed in ([None], [-signal.SIGTERM])
    assert gone(pid)
    assert host.gone or how == "closed"
    if how == "killed":
        with pytest.raises(HostGoneError):
            host.run(script("pass"), {})


def test_host_and_scripts_end_with_the_process_that_asked_for_them(script, tmp_path):
    text = script(LONG.format(str(tmp_path / "pid")))
    code = (
        "import sys\nfrom nptcs.processes.hosted import ScriptHost\n"
        f"ScriptHost(sys.executable).run({text!r}, {{}})\n"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    process = subprocess.Popen([sys.executable, "-c", code], env=environment)
    pid = int(wait_for(tmp_path / "pid"))
    host = psutil.Process(pid).ppid()
    process.kill()
    process.wait()
    assert gone(pid)
    assert gone(host)


def gone(pid, seconds=5.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            if psutil.Process(pid).status() == psutil.STATUS_ZOMBIE:
                return True
        except psutil.NoSuchProcess:
            return True
        time.sleep(0.02)
    return False


class Script:
    """A stand-in for Snakemake's class of Python scripts."""

    started = []

    def __init__(self, path, **special):
        self.path = SimpleNamespace(get_path_or_uri=lambda secret_free: str(path))
        self.is_local = True
        self.threads, self.resources = 2, {"tmpdir": "/somewhere"}
        for name in ("conda_env", "container_img", "env_modules", "bench_record", "shadow_dir"):
            setattr(self, name, special.get(name))

    def execute_script(self, fname, edit=False):
        Script.started.append(fname)


@pytest.fixture
def patched(host, tmp_path, monkeypatch):
    monkeypatch.setattr(Script, "execute_script", Script.execute_script)
    monkeypatch.setattr(Script, "started", [])
    host_scripts(Script, tmp_path, host)
    return host


def test_only_plain_scripts_of_the_folder_are_hosted(patched, script, tmp_path):
    file = script("pass")
    Script(file).execute_script(file)
    Script(tmp_path / "rules/../script.py").execute_script(file)  # as rules name their scripts
    assert Script.started == []
    for other in (
        Script(file, conda_env="env"),
        Script(file, bench_record=1),
        Script("/else/a.py"),
    ):
        other.execute_script(file)
    Script(file).execute_script(file, edit=True)
    assert len(Script.started) == 4


def test_a_script_that_fails_is_an_error_as_from_a_shell(patched, script):
    file = script("import sys; sys.exit(3)")
    with pytest.raises(subprocess.CalledProcessError) as caught:
        Script(file).execute_script(file)
    assert caught.value.returncode == 3


def test_without_its_host_snakemake_starts_interpreters(patched, script):
    patched._process.kill()
    patched._process.wait()
    file = script("pass")
    end = time.monotonic() + 10
    while not patched.gone and time.monotonic() < end:
        time.sleep(0.02)
    Script(file).execute_script(file)
    assert Script.started == [file]


def test_variables_are_those_that_snakemake_sets():
    variables = environment_of(Script(Path("a.py")))
    assert variables["OMP_NUM_THREADS"] == variables["VECLIB_MAXIMUM_THREADS"] == "2"
    assert variables["TMPDIR"] == variables["TEMP"] == "/somewhere"


@pytest.mark.parametrize("end", [ScriptHost.close, lambda host: host._process.kill()])
def test_what_cases_import_is_imported_in_advance_and_ends_with_the_host(
    tmp_path, monkeypatch, end
):
    slow = tmp_path / "slow_to_compile.py"
    slow.write_text(
        "import os, time\nfrom pathlib import Path\n"
        f"Path({str(tmp_path)!r}, 'pid').write_text(str(os.getpid()))\ntime.sleep(60)\n"
    )
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    host = ScriptHost(sys.executable)
    try:
        host.prepare([], compiled=[slow.stem])
        wait_until((tmp_path / "pid").is_file)
        process = psutil.Process(int((tmp_path / "pid").read_text()))
    finally:
        end(host)
    wait_until(lambda: not process.is_running() or process.status() == psutil.STATUS_ZOMBIE)


def wait_until(done, seconds=20.0):
    deadline = time.monotonic() + seconds
    while not done():
        assert time.monotonic() < deadline
        time.sleep(0.05)
