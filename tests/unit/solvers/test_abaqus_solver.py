"""The solver ``abaqus`` with a command that behaves as Abaqus does."""

import os
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from small_tyres import VALUES

from nptcs.config.solvers.abaqus import AbaqusMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.solvers import abaqus, abaqus_watch, calculix
from nptcs.solvers.abaqus_history import load_curve
from nptcs.solvers.abaqus_messages import (
    licence_denial,
    read_messages,
    reason,
    waits_for_licence,
)
from nptcs.solvers.contract import CaseInputs, Status
from nptcs.solvers.external import CommandStopped, end_all, run_command, time_for_command
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

FAKE = str(Path(__file__).with_name("fake_abaqus.py"))
SMALL = AbaqusMesh(
    rows=(1, 1, 1, 1, 1, 1), columns=1, spoke_axial=3, plate=(1, 1), around=60, band_axial=1
)


def case(mode, *words, values=VALUES, **options):
    command = (sys.executable, FAKE, mode, *map(str, words))
    chosen = abaqus.AbaqusOptions(mesh=SMALL, command=command, **options)
    inputs = CaseInputs("case_1", values, 5000.0, TyreGeometry(), chosen, ply=PUBLISHED_PLY)
    return abaqus.solve(inputs)


def dies(pid):
    """Whether a process is gone, or a zombie, within five seconds."""
    end = time.monotonic() + 5.0
    while time.monotonic() < end:
        try:
            os.kill(pid, 0)
            if ") Z" in Path(f"/proc/{pid}/stat").read_text():
                return True
        except (ProcessLookupError, FileNotFoundError):
            return True
        time.sleep(0.05)
    return False


def test_curve_stiffness_and_harmless_warnings_of_a_complete_job():
    result = case("ok")
    assert result.status is Status.OK
    assert result.displacement_mm == pytest.approx(20.0)
    assert result.vertical_stiffness_n_per_mm == pytest.approx(250.0)
    assert result.curve["force_n"] == pytest.approx([0.0, 100.0, 2500.0, 5000.0])
    assert result.curve["displacement_mm"] == pytest.approx([0.0, 0.3608, 9.5, 20.0])
    assert "adjusted nodes" in result.message
    assert "IS NOT ACTIVE" in result.message


def test_a_denied_licence_is_its_own_status():
    result = case("denied")
    assert result.status is Status.LICENCE
    assert "Error checking out Abaqus license" in result.message
    assert result.curve is None


def test_a_long_queue_for_a_licence_is_ended():
    result = case("queued", licence_wait_s=1.0, timeout_s=60.0)
    assert result.status is Status.LICENCE
    assert "licence_wait_s" in result.message


def test_a_short_queue_for_a_licence_is_waited_for():
    assert case("queued a little", licence_wait_s=30.0).status is Status.OK


def test_only_an_unbroken_queue_counts(tmp_path, monkeypatch):
    now = [0.0]
    monkeypatch.setattr(abaqus_watch, "time", SimpleNamespace(monotonic=lambda: now[0]))
    watch = abaqus_watch.JobWatch(tmp_path / "tyre", 100.0, ())
    queued = '"standard" license request queued for the License Server on a.\n'
    printed = ""
    for second, line in ((0, queued), (90, "checked out 5 tokens\n"), (95, queued), (180, "")):
        now[0], printed = float(second), printed + line
        watch(printed)
    now[0] = 196.0
    with pytest.raises(CommandStopped) as stopped:
        watch(printed)
    assert stopped.value.status is Status.LICENCE


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="reads the process table of Linux")
def test_a_job_out_of_time_is_ended_with_its_children_and_keeps_its_curve(tmp_path):
    result = case("hangs with a child", tmp_path / "pid", timeout_s=5.0)
    assert result.status is Status.TIMEOUT
    assert result.curve["force_n"] == pytest.approx([0.0, 100.0, 2500.0])
    assert dies(int((tmp_path / "pid").read_text()))


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="reads the process table of Linux")
def test_nothing_outlives_a_job_that_has_ended(tmp_path):
    assert case("leaves a child", tmp_path / "pid").status is Status.OK
    assert dies(int((tmp_path / "pid").read_text()))


def test_a_warning_that_changes_the_model_is_fatal_unless_it_is_accepted():
    result = case("ignores a parameter")
    assert result.status is Status.ERROR
    assert "something is left out: THE PARAMETER HOST ELSET" in result.message
    assert result.vertical_stiffness_n_per_mm is None
    accepted = case("ignores a parameter", accepted_warnings=("parameter host elset",))
    assert accepted.status is Status.OK
    assert "THE PARAMETER HOST ELSET" in accepted.message


def test_a_job_that_solves_another_model_is_not_waited_for():
    result = case("ignores a parameter and goes on", timeout_s=60.0)
    assert result.status is Status.ERROR
    assert "something is left out: THE PARAMETER HOST ELSET" in result.message


def test_accepted_warnings_are_patterns():
    with pytest.raises(ValueError, match="not a regular expression"):
        abaqus.AbaqusOptions(accepted_warnings=("(",))


def test_a_job_that_does_not_converge_keeps_its_last_point():
    result = case("does not converge")
    assert result.status is Status.DIVERGED
    assert "2500 of 5000 N" in result.message
    assert "LESS THAN THE MINIMUM" in result.message
    assert result.curve["force_n"][-1] == pytest.approx(2500.0)
    assert result.vertical_stiffness_n_per_mm is None


@pytest.mark.parametrize(
    ("mode", "message"),
    [
        ("syntax error", "UNKNOWN ELEMENT TYPE C3D8HH"),
        ("wrong load", "carries 4000 of 5000 N"),
        ("says nothing", "code 9"),
    ],
)
def test_output_without_a_result_is_an_error(mode, message):
    result = case(mode)
    assert result.status is Status.ERROR
    assert message in result.message


@pytest.mark.parametrize(("solver", "own"), [(abaqus, {"mesh": SMALL}), (calculix, {})])
def test_a_missing_command_is_an_error(solver, own):
    options = solver.SOLVER.options(command=("no-such-solver",), **own)
    inputs = CaseInputs("c", VALUES, 5000.0, TyreGeometry(), options, ply=PUBLISHED_PLY)
    result = solver.solve(inputs)
    assert result.status is Status.ERROR
    assert "no-such-solver" in result.message


def test_values_are_checked_before_anything_runs():
    with pytest.raises(InputError, match="angle_deg"):
        case("ok", values={k: v for k, v in VALUES.items() if k != "angle_deg"})


def test_files_are_kept_where_the_user_wants_them(tmp_path):
    case("ok", keep_files=tmp_path / "jobs")
    case("ok", keep_files=tmp_path / "jobs")
    folders = sorted((tmp_path / "jobs").iterdir())
    assert [folder.name.startswith("case_1-") for folder in folders] == [True, True]
    assert (folders[0] / "tyre.inp").read_text().startswith("*HEADING")


@pytest.mark.parametrize(
    ("cpus", "tokens"), [(1, 5), (2, 6), (3, 7), (4, 8), (8, 12), (16, 16), (64, 28), (128, 38)]
)
def test_tokens_follow_the_formula_of_the_licence(cpus, tokens):
    options = abaqus.AbaqusOptions(cpus=cpus)
    assert options.tokens_per_case() == tokens
    assert options.cores_per_case() == cpus
    assert abaqus.AbaqusOptions(cpus=cpus, licence_tokens=3).tokens_per_case() == 3


# --- texts


@pytest.mark.parametrize(
    "warning",
    [
        "THE OPTION *REBAR LAYER HAS BEEN IGNORED",
        "UNKNOWN KEYWORD EMBEDED ELEMENT",
        "3 NODES OF EMBEDDED ELEMENTS DO NOT LIE IN ANY HOST ELEMENT",
        "NODE 17 INSTANCE SPOKE-03 WILL BE IGNORED FOR EMBEDDING",
        "12 SLAVE NODES IN TIE PAIR FEET HAVE NOT BEEN TIED TO THE MASTER SURFACE",
        "Distance of node 4 exceeds the position tolerance",
        "One of the *TIE constraints at each of these nodes is removed.",
        "REBAR LAYER INNER-1 CANNOT BE FOUND",
        "THE VALUE OF D1 HAS BEEN RESET",
        "SOLVER PROBLEM. ZERO PIVOT WHEN PROCESSING ELEMENT 20025 INTERNAL NODE 1 D.O.F. 4 "
        "OVERCONSTRAINT CHECKS: An overconstraint was detected",
    ],
)
def test_warnings_of_another_model_are_fatal(warning):
    assert reason(warning)


@pytest.mark.parametrize(
    "warning",
    [
        "DEGREE OF FREEDOM 4 IS NOT ACTIVE IN THIS MODEL AND CAN NOT BE RESTRAINED",
        "For *tie pair (FEET), adjusted nodes with very small adjustments were not printed. "
        "Specify *preprint,model=yes for complete printout.",
        "OUTPUT REQUEST LE IS NOT AVAILABLE FOR ELEMENT TYPE SFM3D4R AND WILL BE IGNORED",
        "THE SYSTEM MATRIX HAS 3 NEGATIVE EIGENVALUES.",
        "SOLVER PROBLEM. NUMERICAL SINGULARITY WHEN PROCESSING NODE 12 D.O.F. 2 RATIO = 1.E+12",
        "THE STRAIN INCREMENT HAS EXCEEDED FIFTY TIMES THE STRAIN TO CAUSE FIRST YIELD",
        "OVERCONSTRAINT CHECKS: the redundant boundary condition at node 5 is removed",
        "12 elements are distorted: either the isoparametric angles are out of the limits",
    ],
)
def test_other_warnings_are_kept(warning):
    assert reason(warning) == ""


def test_messages_are_cut_out_whole_and_counted_once():
    text = (
        " ***WARNING: FIRST LINE\n             SECOND LINE\n\n OTHER TEXT\n"
        " ***WARNING: FIRST LINE\n             SECOND LINE\n\n"
        + "".join(f" ***WARNING: MORE {i}\n\n" for i in range(7))
        + " ***ERROR: BAD\n"
    )
    messages = read_messages([text])
    assert messages.warnings[0] == "FIRST LINE SECOND LINE"
    assert len(messages.warnings) == 8
    assert messages.errors == ("BAD",)
    assert messages.kept().endswith("MORE 3 | and 3 more")


@pytest.mark.parametrize(
    "line",
    [
        "Abaqus Error: Error checking out Abaqus license.",
        "Licensed number of users already reached.",
        "FlexNet Licensing error:-87,147",
        "License server machine is down or not responding.",
        "Cannot connect to license server system.",
        "Time limit of in queue has been exceeded. Exiting.",
        "Unable to checkout license from DSLS server",
        "Checkout exceeds MAX specified in options file.",
    ],
)
def test_denials_are_recognised(line):
    assert licence_denial(f"Abaqus 2026\n {line}\nmore\n") == line


def test_a_granted_licence_is_neither_wait_nor_denial():
    text = (
        "Successfully checked out QAE/1 from DSLS server\n<39 out of 40 licenses remain available>."
    )
    assert licence_denial(text) == ""
    queued = '"standard" license request queued for the License Server on a.\n'
    assert waits_for_licence(queued)
    assert waits_for_licence(f"{queued}Total time in queue: 30 seconds.\n")
    assert not waits_for_licence(queued + text)
    assert not waits_for_licence("")


def test_values_that_are_all_zero_and_half_lines_are_read():
    start = "INCREMENT     1 SUMMARY\n"
    named = " THE FOLLOWING TABLE IS PRINTED FOR NODES BELONGING TO NODE SET TYRE_{}\n\n"
    zero = named.format("RIM-REF") + " ALL VALUES IN THIS TABLE ARE ZERO\n\n"
    road = named.format("GROUND-REF") + " NODE FOOT-   RF2\n  NOTE\n\n  12  1.5E+02\n"
    assert load_curve(start + zero + road) == ([0.0, 0.0], [0.0, 150.0])
    # stopped while the second increment was written
    half = "INCREMENT     2 SUMMARY\n" + zero + named.format("GROUND-REF").rstrip() + "\n"
    cut = half + "\n NODE FOOT-   RF2\n  NOTE\n\n  12  1.5E+"
    assert load_curve(start + zero + road + cut) == ([0.0, 0.0], [0.0, 150.0])
    assert load_curve("") == ([0.0], [0.0])


# --- the runner of commands


def test_a_commands_limit_lies_before_its_cases():
    assert time_for_command(3600.0) == 3590.0
    assert time_for_command(10.0) == 9.0


def test_output_and_exit_code_of_a_command(tmp_path):
    code = "import sys; print('out'); print('err', file=sys.stderr); sys.exit(4)"
    ended = run_command([sys.executable, "-c", code], tmp_path, 30.0)
    assert ended.code == 4
    assert sorted(ended.output.split()) == ["err", "out"]
    end_all()  # nothing left to end
