"""What cards, surfaces, responses and uncertainties say about how a value was found."""

from __future__ import annotations

from nptcs.language import translatable

SENTENCES = (
    # hyperelastic models and cards
    translatable(
        "{model}, least squares on nominal stress, strain {low} to {high}, weights: "
        "{weights}, {points} points of {count} specimens; standard error: {rule}"
    ),
    translatable("not stable: {path}"),
    translatable("not stable in Drucker's sense: {path}"),
    translatable("{path} from strain {strain}"),
    translatable("{mode} tension"),
    translatable("{mode} compression"),
    translatable("uniaxial"),
    translatable("equibiaxial"),
    translatable("pure shear"),
    translatable("{sets}; {measured}: {verdict} ({distance} standard errors)"),
    translatable("{sets}; {measured} (no standard error to judge the difference by)"),
    translatable("reciprocity nu12/E1 = nu21/E2 sets nu21 = {value}"),
    translatable("measured {value} on {count} specimens"),
    translatable("agrees"),
    translatable("warning: does not agree"),
    translatable("nu21 was not measured"),
    # surfaces
    translatable("Matérn 5/2, variance and lengths in half ranges {sizes}; mean: {mean}"),
    translatable(
        "{response} on one spoke of degree {degree} in the ring's logarithms; {count} "
        "processes over spokes"
    ),
    translatable("log of the response"),
    translatable("without {level}: {reason}"),
    translatable("the design cannot estimate all {count} terms (rank {rank})"),
    translatable("aliased: {terms}"),
    translatable("these cases do not determine the {count} coefficients of the lamination form"),
    translatable(
        "terms or form kept, all parameters and hyperparameters fitted anew without each case "
        "or level"
    ),
    translatable("hyperparameters kept, all else fitted anew without each spoke or level"),
    translatable("levels left out; no case left out alone: there are more than {count} of them"),
    translatable("no surface is requested"),
    translatable("no surface: {solved} of {total} cases solved, at least {fewest} are required"),
    translatable("no surface: one level left of {names}"),
    translatable("no surface: {reason}"),
    translatable("all {count} terms"),
    translatable("powers of degree {degree}"),
    translatable("interactions of degree {degree}"),
    translatable("replicates differ"),
    translatable("replicates are equal"),
    translatable("no replicates"),
    translatable(
        "the chance of an effect this large from noise alone, as long as the lack of fit is "
        "not significant"
    ),
    translatable(
        "not a probability: the results have no noise, and a small p says only that the term is "
        "large compared with what the polynomial cannot follow"
    ),
    translatable(
        "not a probability where the results come from a deterministic solver, which has no "
        "noise: a small p then says only that the term is large compared with what the "
        "polynomial cannot follow"
    ),
    translatable("a case"),
    translatable("all cases that share a spoke"),
    # responses of tyres
    translatable("load over displacement"),
    translatable("slope of the curve smoothed over its nearest points"),
    translatable("√(12 Var) of the place, by pressure"),
    translatable("of the contact's points"),
    translatable("load over contact length and width"),
    translatable("radial, positive in tension"),
    translatable("radial, negative in compression"),
    translatable("in plane, {place}"),
    translatable("at the plates' faces, element centres"),
    translatable("at the plates' faces, element means"),
    translatable("at the integration points of the most loaded spokes"),
    translatable("σ1 {place}"),
    translatable("σ2 {place}"),
    translatable("|τ12| {place}"),
    translatable("λ - 1, {place}"),
    translatable("per unloaded volume, {place}"),
    translatable("{criterion}, {place}; stress may grow by this factor"),
    translatable("maximum stress"),
    translatable("all plates of the tyre, {density} kg/m³ as configured"),
    translatable("all plates of the tyre, {price} per kg as configured"),
    translatable("no plate_density_kg_per_m3 in the configuration"),
    translatable("strengths of the ply that are not tested: {names}"),
    translatable(
        "the contact is only {count} contact points long, too few to resolve it: refine the "
        "ring's mesh"
    ),
    # sensitivity
    translatable("uniform {low} to {high}"),
    translatable("normal, mean {mean}, SD {sd}"),
    # uncertainty
    translatable("no model of this response shows its effect"),
    translatable("ply {name}: {specimens}"),
    translatable("{name} ({value} MPa): {specimens}"),
    translatable("specimens {names}"),
    translatable("no entry in uncertainty.rubbers for {name}"),
    # files
    translatable("a README is a note, not test data"),
)
"""The sentences, as the stages write them; ``{…}`` stands for what differs."""
