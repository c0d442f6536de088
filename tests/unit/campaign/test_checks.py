"""What is wrong with a study is reported before it is solved; what a run would solve is counted."""

import pytest

from nptcs.campaign.answers import solvers_of
from nptcs.campaign.batch import solve_batch
from nptcs.campaign.checks import name_faults, refuse_faults, repeats_a_piece, study_faults
from nptcs.campaign.plan import Costs, different_parts, plan_lines
from nptcs.campaign.record import RecordStore
from nptcs.config.root import read_config
from nptcs.design import full_factorial
from nptcs.errors import InputError
from nptcs.files import write_model
from nptcs.tables.laboratory.material_card import MaterialCard
from nptcs.tables.laboratory.specimens import Specimen


@pytest.fixture
def archive(tmp_path):
    path = tmp_path / "archive.csv"
    rows = [f"{n},{s},{t},{600 - s - t}" for n, (s, t) in enumerate(CASES, 1)]
    path.write_text("\n".join(["case,spacing_mm,thickness_mm,stiffness_n_per_mm", *rows]) + "\n")
    return path


CASES = [(s, t) for s in (10.0, 15.0, 20.0) for t in (1.0, 1.4, 1.8)]


def configuration(archive, study=None, **changes):
    def factor(name, *levels):
        return {"name": name, "label": name, "unit": "mm", "levels": levels}

    values = {
        "name": "plate",
        "title": "Plates",
        "factors": [factor("spacing_mm", 10, 15, 20), factor("thickness_mm", 1, 1.4, 1.8)],
        "solvers": ["published"],
        "terms": ["1", "spacing_mm", "thickness_mm", "thickness_mm^2"],
        **(study or {}),
    }
    solvers = {"published": {"archive": str(archive)}}
    return read_config({"studies": [values], "solvers": solvers, **changes})


def test_a_sound_study_has_no_faults(archive):
    assert study_faults(configuration(archive)) == []
    refuse_faults([])


LEVELS = [level / 10 for level in range(1, 201)]
FACTORS = [
    {"name": name, "label": "", "unit": "", "levels": LEVELS}
    for name in ("spacing_mm", "thickness_mm", "angle_deg")
]


@pytest.mark.parametrize(
    ("study", "changes", "key", "words"),
    [
        (
            {"terms": ["1", "thickness_mm", "thickness_mm^2", "thickness_mm^3"]},
            {},
            "studies.plate.terms",
            r"aliased: thickness_mm\^3 with thickness_mm",
        ),
        (
            {"terms": ["1", *(f"spacing_mm^{n}" for n in range(1, 12))]},
            {},
            "studies.plate.terms",
            "9 cases are too few for 12 terms",
        ),
        ({"load_n": 4000.0}, {}, "studies.plate.load_n", "at 5000 N, not at 4000 N"),
        ({"factors": FACTORS}, {}, "studies.plate.factors", "8,000,000 cases"),
        ({}, {"campaign": {"most_cases": 8}}, "studies.plate.factors", "at most 8 cases of"),
        ({}, {"campaign": {"batches": 10}}, "campaign.batches", "only 9 cases"),
        ({"solvers": ["lca"]}, {}, "studies.plate.solvers", "does not use"),
    ],
    ids=["aliased", "too many terms", "load", "millions", "above the limit", "batches", "unseen"],
)  # fmt: skip
def test_a_fault_is_named_with_its_key_and_a_remedy(archive, study, changes, key, words):
    (fault,) = study_faults(configuration(archive, study, **changes))
    if key:
        assert fault.column == key
    assert fault.remedy
    with pytest.raises(InputError, match=words):
        refuse_faults([fault])


def test_an_unknown_term_is_refused_as_the_configuration_is_read(archive):
    with pytest.raises(InputError, match="speed"):
        configuration(archive, {"terms": ["1", "speed"]})


def test_all_faults_are_reported_at_once(archive):
    study = {"load_n": 4000.0, "terms": ["1", "spacing_mm", "spacing_mm^2", "spacing_mm^3"]}
    faults = study_faults(configuration(archive, study))
    with pytest.raises(InputError, match=r"(?s)2 faults.*aliased.*4000 N"):
        refuse_faults(faults)


def test_absurd_numbers_of_batches_are_refused(archive):
    with pytest.raises(InputError, match=r"campaign\.batches"):
        configuration(archive, campaign={"batches": 1e9})


def test_rubbers_whose_modulus_is_not_known_yet_count_as_levels(archive):
    levels = [{"rubber": "a"}, 5.0, {"rubber": "b"}]
    factor = {"name": "spoke_c10_mpa", "label": "", "unit": "", "levels": levels}
    terms = ["1", "spoke_c10_mpa", "spoke_c10_mpa^2"]
    four = [*terms, "spoke_c10_mpa^3"]
    study = {"factors": [factor, FACTORS[0] | {"levels": [1.0, 2.0]}]}
    assert study_faults(configuration(archive, {**study, "terms": terms})) == []
    assert len(study_faults(configuration(archive, {**study, "terms": four}))) == 1


def specimen(name="T0-1", material="cfrp"):
    return Specimen(
        specimen=name,
        test="tension",
        material=material,
        orientation_deg=0,
        width_mm=(15,),
        thickness_mm=(1,),
        force_file="a.csv",
    )


@pytest.mark.parametrize(
    ("specimens", "words"),
    [
        ([specimen("T" + "0a1b2c" * 50)], "301 characters"),
        ([specimen("T-" + "0" * 30)], "repeated more than"),
        ([specimen(), specimen("T0-2", "CFRP")], "capital letters"),
    ],
    ids=["long", "periodic", "capitals"],
)
def test_names_that_cannot_be_files_are_refused(archive, specimens, words):
    (fault,) = name_faults(specimens, configuration(archive))
    assert words in fault.message


def test_ordinary_names_are_not_refused(archive):
    specimens = [specimen(f"T0-{n:012d}", f"cfrp_{n}") for n in range(3)]
    assert name_faults(specimens, configuration(archive)) == []
    assert not repeats_a_piece("T" * 15)
    assert repeats_a_piece("T" * 16)


def test_the_plan_counts_what_is_known_and_what_it_took(archive, tmp_path):
    config = configuration(archive)
    assert plan_lines(config, tmp_path)[:2] == [
        "study plate: 9 cases (full_factorial) by published",
        "  published: 0 known, 9 to solve; about 0.45 s with 1 at a time, 150 MB of memory (stated "
        "by the solver; none of its cases is stored)",
    ]
    study = config.studies[0]
    job = {
        "study": study.case_definition(),
        "solver": "published",
        "options": config.options_of("plate", "published"),
        "tyre": config.tyre.model_dump(),
        "batch": 1,
        "batches": 3,
    }
    store = RecordStore(tmp_path / "5_solve" / "records")
    records = solve_batch(job, full_factorial(study, {}), None, store, 1, 0, tmp_path / "log")
    assert [record.result.status for record in records] == ["ok"] * 3
    assert all(1.0 < record.peak_memory_mb < 10_000.0 for record in records)

    _, line, disk = plan_lines(config, tmp_path)

    assert line.startswith("  published: 3 known, 6 to solve; about ")
    assert "MB of memory" in line
    assert "MB are free" in disk


def test_the_plan_counts_a_spoke_that_several_cases_share_once(archive):
    def factor(name, *levels):
        return {"name": name, "label": name, "unit": "mm", "levels": levels}

    both = [factor("spacing_mm", 10, 14), factor("shear_band_c10_mpa", 4, 4.5, 5)]
    fixed = {"thickness_mm": 1, "angle_deg": 45, "spoke_c10_mpa": 1}
    config = by_fe(archive, [], factors=both, fixed=fixed, solvers=["ring"])
    (study,) = config.studies
    ((solver, _),) = solvers_of(study, config.solver_options(study))
    assert different_parts(study, solver, config.tyre) == 2
    assert Costs(15.0, None, 0.0, shared_seconds=0.1).total_s(6, 2) == pytest.approx(30.4)
    # all known but one: at most one spoke is new
    assert Costs(15.0, None, 0.0, shared_seconds=0.1).total_s(1, 1) == 15.0
    assert Costs(2.0, None, 0.0).total_s(6, 2) == 12.0


def test_cases_of_a_material_that_is_not_calibrated_are_not_counted(archive, tmp_path):
    study = {"solvers": ["published"], "fixed": {"spoke_c10_mpa": {"rubber": "a"}}}
    config = configuration(archive, study)
    assert "once the materials are calibrated" in plan_lines(config, tmp_path)[1]
    write_model(tmp_path / "material_card.json", MaterialCard(plies={}, rubbers={}))
    assert "once the materials are calibrated" in plan_lines(config, tmp_path)[1]


def by_fe(archive, levels, **study):
    """A study that varies the plates' spacing, which the finite elements round to whole plates."""
    factor = {"name": "spacing_mm", "label": "S", "unit": "mm", "levels": levels}
    fixed = {"thickness_mm": 1, "angle_deg": 45, "shear_band_c10_mpa": 5, "spoke_c10_mpa": 1}
    changes = {"factors": [factor], "fixed": fixed, "terms": [], "solvers": ["fe_tyre"]}
    return configuration(archive, {**changes, **study})


def test_levels_that_a_solver_rounds_to_one_are_refused(archive):
    (fault,) = study_faults(by_fe(archive, [14.05, 15, 20]))
    assert "solver 'fe_tyre' rounds its values: spacing_mm 14.05 and 15 are both 14.33" in str(
        fault
    )
    assert fault.column == "studies.plate.factors"


def test_levels_that_stay_apart_are_a_note_of_the_plan(archive, tmp_path):
    config = by_fe(archive, [10, 15, 20])
    assert study_faults(config) == []
    lines = plan_lines(config, tmp_path)
    (note,) = [line for line in lines if "rounded: " in line]
    assert "spacing_mm 10 → 9.773, spacing_mm 15 → 14.33" in note


def test_a_spread_design_may_share_rounded_values_but_not_all(archive):
    spread = {"kind": "latin_hypercube", "cases": 20}
    assert study_faults(by_fe(archive, [10, 20], design=spread)) == []
    (fault,) = study_faults(by_fe(archive, [14.0, 14.6], design=spread))
    assert "rounds its values" in fault.message


def test_terms_are_checked_against_the_values_that_a_solver_uses(archive):
    """Four spacings that a solver rounds to two do not determine a square."""
    terms = ["1", "spacing_mm", "spacing_mm^2"]
    spread = {"kind": "latin_hypercube", "cases": 4}
    config = by_fe(archive, [14.0, 15.2], design=spread, terms=terms)
    (fault,) = study_faults(config)
    assert "with the values that solver 'fe_tyre' uses" in fault.message
    assert study_faults(by_fe(archive, [10, 20], design=spread | {"cases": 9}, terms=terms)) == []


def test_calibration_cases_without_a_published_result_are_refused(archive):
    study = {"solvers": ["published", "ring"], "fixed": FIXED}
    study |= {"calibration_cases": {"ring": [1, 9]}}
    assert study_faults(configuration(archive, study)) == []
    archive.write_text(archive.read_text().rpartition("\n9,")[0] + "\n")
    (fault,) = study_faults(configuration(archive, study))
    assert "calibration case 9 of solver 'ring' has no published result" in fault.message
    assert fault.column == "studies.plate.calibration_cases.ring"


FIXED = {"angle_deg": 45, "shear_band_c10_mpa": 5, "spoke_c10_mpa": 1}


def test_a_table_of_a_solver_that_is_missing_is_named(archive):
    archive.unlink()
    (fault,) = study_faults(configuration(archive))
    assert "does not exist" in fault.message
    assert str(archive) in str(fault)


@pytest.mark.parametrize("name", ["records", "bulk", "models", "sobol"])
def test_a_study_may_not_have_the_name_of_a_folder_of_results(archive, name):
    (fault,) = name_faults([], configuration(archive, {"name": name}))
    assert "this name is reserved" in fault.message


@pytest.mark.parametrize("name", ["con", "NUL", "com3", "aux.v2"])
def test_names_that_windows_reserves_are_refused(archive, name):
    faults = name_faults([specimen(material=name)], configuration(archive))
    assert [fault.value for fault in faults] == [name]
