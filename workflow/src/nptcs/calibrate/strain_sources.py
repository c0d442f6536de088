"""Which curves of a rubber may be fitted together, by where their strain came from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from nptcs.reduce.deviations import CROSSHEAD
from nptcs.tables.laboratory.specimens import Specimen

TRAVEL = "crosshead"
NO_SENSOR = (TRAVEL, "none", "")


def without_travel_next_to_sensors(
    name: str, specimens: Sequence[Specimen], sources: Mapping[str, str]
) -> tuple[list[Specimen], list[str]]:
    """Leave out specimens with crosshead strain where others of the same test have a sensor.

    Travel includes the compliance of machine and grips and the slip in them: together with measured
    strains it would make the fitted constants too soft. A test in which no specimen has a sensor
    keeps all of them: discs are always measured between the platens.

    Parameters
    ----------
    name : str
        The rubber in the sheet; specimens of other materials are passed through.
    specimens : sequence of Specimen
    sources : mapping of str to str
        Strain source by specimen, as the ingest records say.

    Returns
    -------
    kept : list of Specimen
    words : list of str
        One sentence for each specimen that was left out.
    """
    mine = [s for s in specimens if s.material == name and s.include]
    measured = {s.test for s in mine if sources.get(s.specimen, "") not in NO_SENSOR}
    out = {s.specimen for s in mine if sources.get(s.specimen) == TRAVEL and s.test in measured}
    words = [
        f"{one}: {CROSSHEAD}, where other specimens have a sensor: not in the fit" for one in out
    ]
    return [s for s in specimens if s.specimen not in out], sorted(words)
