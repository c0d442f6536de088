"""Why something gave no result: messages of the stages in the language of the page.

The tables hold what a stage wrote: place, message, value and remedy as `nptcs.errors.InputError`
joins them. Each part is translated where its sentence is known, and stays as it is where it is not.
"""

from __future__ import annotations

from functools import cache

from nptcs.language import ENGLISH, Language, current_language, tr, translatable
from nptcs.report.words.flags import flag_text, translated
from nptcs.report.words.specimen_messages import SENTENCES as SPECIMENS

SENTENCES = (
    # solved cases
    translatable("spoke: {reason}"),
    translatable("out of memory: {reason}"),
    translatable("must be positive"),
    translatable("give a number above zero"),
    translatable("the finite element model needs this value"),
    translatable("give it as a factor or a fixed value of the study"),
    translatable("plates {width} mm wide overlap at this spacing"),
    translatable("choose a spacing above the plate's width"),
    translatable("the finite element model needs the ply's constants, missing: {names}"),
    translatable("name a ply of the material card in the study"),
    translatable("stopped after {seconds} s"),
    translatable("row {row} of {file}"),
    # surfaces
    translatable("solve more cases or fit fewer terms"),
    translatable("{cases} solved cases cannot determine {terms} terms"),
    translatable("solved cases have no response to fit"),
    translatable("fit this response only for solvers that give it"),
    translatable("the response is the same in all cases"),
    translatable("check that the solver uses the factors of this study"),
    translatable("only one level of a factor has results"),
    translatable("solve cases at two levels or more, or leave the factor out"),
    translatable(
        "drop the aliased terms, or give the factor one level more than its highest power"
    ),
    translatable("the lamination form needs the constants of the plates' ply"),
    translatable("give the specimens of a ply, or leave the lamination form out"),
    translatable("the lamination form needs positive stiffness, spacing and thickness"),
    translatable("correct the cases"),
    translatable("the {link} link needs a positive response"),
    translatable("use the identity link for this response"),
    translatable("leave this surface out, or change its mean"),
    translatable("too few cases for a surface: {counts}"),
    translatable("this distribution is outside the cases ({low} to {high})"),
    translatable("give a distribution inside the range of the levels"),
    # uncertainty and decisions
    translatable("no case of study {study} has been solved by {solver}"),
    translatable("see cases.csv for what failed"),
    translatable("the reference design is outside the solved cases"),
    translatable("give a design inside the range of the levels"),
    translatable("no whole number of plates lies between the spacings of the cases"),
    translatable("solve cases over a wider range of spacings"),
    translatable("only {cases} cases of study {study} have {response}"),
    translatable("solve more cases"),
    translatable("study {study} has no such surface"),
    translatable("study {study} does not vary the plates"),
    translatable("leave the plates' mass out of the goals"),
    translatable("this rubber has no material card"),
    translatable("the card of this rubber has no standard error of C10"),
    translatable("test at least two specimens, or state sd_percent"),
    # specimens
    translatable("correct the name in the sheet"),
    translatable("file is empty"),
    translatable("export the test again"),
    translatable("is binary, not text"),
    translatable("export it as text or as XLSX"),
    translatable("name a strain_file in the sheet"),
    translatable("strain_axis is not a strain of the file"),
    translatable("axial strain falls while a {test} test loads"),
    translatable("only {rows} rows overlap in time"),
    translatable("largest strain {strain} is beyond {limit} (dimensionless)"),
    translatable("apparent modulus {modulus} MPa is outside {low} to {high} MPa"),
    translatable("time does not increase from reading {first} to {second}"),
    translatable("delete the reading, or export one test per file"),
    *SPECIMENS,
    # properties, cards and what follows them
    translatable("no {kind} load"),
    translatable("check the test type and the sign of the force"),
    translatable("write the number of one of them, first, last or envelope"),
    translatable("{model}: {constants} constants, the data determine {rank}"),
    translatable("widen the strain range, add another mode of deformation, or use a simpler model"),
    translatable("material {name}: no curve to fit"),
    translatable("ingest at least one included rubber specimen of this material"),
    translatable("material {name} has no included specimen of this name"),
    translatable("correct calibration.rubber.only_specimen or set it to null"),
    translatable("{points} points in the strain range {low} to {high}"),
    translatable("widen calibration.rubber.strain_range or leave the specimen out"),
    translatable("no stress in the direction of the test in the strain range {low} to {high}"),
    translatable("check the curve's strain origin, or leave the specimen out"),
    translatable("material {material}: {name} must be positive"),
    translatable("check the curves and the source of this constant"),
    translatable("add such specimens, include them, or name another source in the configuration"),
    translatable(
        "material {material}: the compliance matrix is not positive definite (lowest scaled "
        "eigenvalue {lowest}), Poisson's ratios nu12 {nu12}, nu13 {nu13}, nu23 {nu23}"
    ),
    translatable(
        "check the transverse strains and the assumed Poisson's ratios: |nu12| < sqrt(E1/E2), "
        "and likewise for nu13 and nu23"
    ),
    translatable(
        "load-bearing model: needs a displacement of {displacement} mm, more than the {room} "
        "mm that the wheel allows"
    ),
    translatable("give a smaller load, or a stiffer ring or spokes"),
    translatable("correct the tyre's dimensions or the ring's options"),
    translatable("solver '{solver}' says ok but gives no {missing}"),
    translatable(
        "a Gaussian process is not fitted to {cases} cases: its time grows with the cube of "
        "their number, its memory with the square (at most {most})"
    ),
    translatable("leave it out of this study's surfaces, or take fewer levels"),
    translatable("the lamination form has the factors {factors}"),
    translatable("leave the lamination form out of this study"),
    translatable("a surface over spokes needs the constants of the plates' ply"),
    translatable("give the specimens of a ply, or leave the surface out"),
    translatable("a surface over spokes needs positive factors"),
    translatable(
        "a surface over spokes has the factors {factors} and at least one of the ring, such "
        "as shear_band_c10_mpa"
    ),
    translatable("leave it out of this study"),
    translatable("leave this surface out, or solve more spokes"),
    translatable("{spokes} spokes are too few for a surface over spokes"),
    translatable("solve {fewest} spokes or more (design split_plot)"),
    translatable(
        "a spoke has {cases} solved cases, which cannot determine the {terms} terms of its "
        "polynomial"
    ),
    translatable(
        "solve more cases on each spoke, lower the degree, or narrow the range of the factors "
        "until no case fails"
    ),
    translatable(
        "the surface is the same everywhere, or not a number somewhere, and has no indices"
    ),
    translatable("look at surface_comparison.csv"),
    translatable("the plates' mass in the cases is not proportional to their number and thickness"),
    translatable("use a solver whose plates all have the same length"),
    translatable("study {study} is not solved by this solver"),
    translatable("name one of {choices}"),
    translatable("no case of study {study} by {solver} has {response}"),
    translatable("outside the cases that the surface was fitted to ({low} to {high})"),
    translatable("lies outside the cases ({low} to {high})"),
    translatable("hold it at a value inside, or solve cases there"),
)
"""What the stages write, without place, value and remedy."""

REMEDY, VALUE = ". Remedy: ", " (value: "


def message_text(message: str) -> str:
    """Write a message of a stage in the language of the run.

    Examples
    --------
    >>> message_text("plate_001: must be positive (value: -1.0). Remedy: give a number above zero")
    'plate_001: must be positive (value: -1.0). Remedy: give a number above zero'
    """
    language = current_language()
    return message if language == ENGLISH else _message_text(message, language)


@cache
def _message_text(message: str, language: Language) -> str:
    """Write a message in the current language, an argument so that each has its cache entry."""
    head, remedy_follows, remedy = message.partition(REMEDY)
    head, value_follows, value = head.partition(VALUE)
    text = _with_place(head)
    if value_follows:
        text += tr(" (value: {value})", value=value.removesuffix(")"))
    if remedy_follows:
        text += tr(". Remedy: {remedy}", remedy=translated(remedy, SENTENCES) or remedy)
    return text


def _with_place(head: str) -> str:
    """Write a message with the place before it; the place stays as it is."""
    parts = head.split(": ")
    for place in range(len(parts)):
        found = translated(": ".join(parts[place:]), SENTENCES)
        if found is not None:
            return ": ".join([*parts[:place], found])
    return flag_text(head)
