"""Which surface answers where none is named: one rule for the configuration and the command."""

from argparse import ArgumentParser
from dataclasses import replace

import numpy as np
import pytest

from nptcs.commands import design
from nptcs.config.root import Config
from nptcs.decisions.decide import decide
from nptcs.surface.registry import STIFFNESS, FittedSurface, Response, SurfaceRegistry
from nptcs.surface.study import fit_study
from nptcs.uncertainty.answering_surface import answering_surface

SURFACES = [{"kind": "polynomial", "link": "log"}, {"kind": "gaussian_process"}]
GOALS = {"targets": ["K=300±5"], "minimise": ["plate_mass"]}


@pytest.fixture(scope="module")
def with_surfaces(study):
    return study.model_validate({**study.model_dump(), "surfaces": SURFACES})


@pytest.fixture(scope="module")
def registry(with_surfaces, tables):
    cases, responses, _ = tables
    return fit_study(cases, with_surfaces, values=responses).registry()


def answers(asked, preferred, study, registry, solver="fe_tyre_paper"):
    return answering_surface(asked, preferred, study, solver, registry)


def best_of(registry):
    tested = [one for one in registry.surfaces if one.response.name == STIFFNESS]
    return min(tested, key=lambda one: one.left_out_rms).name


def test_what_is_named_answers_then_uncertainty_then_the_best(with_surfaces, registry):
    best = best_of(registry)
    other = next(n for n in ("polynomial", "polynomial of log") if n != best)
    assert answers("x", other, with_surfaces, registry) == "x"
    assert answers(None, other, with_surfaces, registry) == other
    assert answers(None, None, with_surfaces, registry) == best
    assert answers(None, "lamination 7", with_surfaces, registry) == best


def test_a_surface_that_was_not_tested_or_is_of_another_solver_is_not_the_best(study):
    def one(solver, name, rms):
        response = Response(STIFFNESS, unit="N/mm")
        return FittedSurface("plate", solver, name, response, None, left_out_rms=rms)

    fits = (one("s", "a", np.nan), one("s", "b", 2.0), one("s", "c", 1.0), one("t", "d", 0.1))
    assert answers(None, None, study, SurfaceRegistry("plate", fits), "s") == "c"
    untested = SurfaceRegistry("plate", fits[:1])
    assert answers(None, None, study, untested, "s") == "gaussian process on the mean"
    assert answers(None, None, study, None) == "gaussian process on the mean"


@pytest.mark.parametrize("preferred", [None, "polynomial of log"])
def test_configuration_and_command_give_the_same_answer(
    preferred, with_surfaces, registry, source, tmp_path
):
    asked = {"name": "d", "solver": "fe_tyre_paper", **GOALS}
    study = {**with_surfaces.model_dump(), "decisions": [asked]}
    config = Config.model_validate({"studies": [study], "uncertainty": {"surface": preferred}})
    parser = ArgumentParser()
    design.register(parser.add_subparsers())
    (tmp_path / "config.yaml").touch()
    typed = ["design", "--target", "K=300±5", "--minimise", "plate_mass"]
    typed += ["--config", str(tmp_path / "config.yaml"), "--results", str(tmp_path)]

    ways = [config.decisions[0], design.decision_of(parser.parse_args(typed), config)]

    settings = source.settings.model_copy(update={"surface": preferred})
    results = replace(source.results, study=with_surfaces)
    source = replace(source, registry=registry, settings=settings, results=results)
    found = [decide(way, source) for way in ways]
    names = [{r: f.surface for r, f in one.problem.fitted.items()} for one in found]
    assert names[0] == names[1]
    assert set(names[0].values()) == {
        preferred or best_of(registry),
        "number × dimensions × density",
    }
    np.testing.assert_array_equal(found[0].found.designs.x, found[1].found.designs.x)
    np.testing.assert_array_equal(found[0].sampled, found[1].sampled)


def test_a_surface_of_no_study_is_refused_by_the_configuration(with_surfaces):
    values = {"studies": [with_surfaces.model_dump()], "uncertainty": {"surface": "lamnation 7"}}
    with pytest.raises(ValueError, match=r"uncertainty.surface: no study .*'lamnation 7'.*of log"):
        Config.model_validate(values)
