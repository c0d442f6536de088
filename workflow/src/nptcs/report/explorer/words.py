"""All texts of the explorer in the language of the run; the scripts themselves contain none.

Scripts put values where ``{name}`` stands; a text is one whole sentence or one term.
"""

from __future__ import annotations

from nptcs.language import tr


def page_words() -> dict[str, str]:
    """Return the texts that the scripts show, by key."""
    return {
        "study": tr("Study"),
        "solver": tr("Solver"),
        "model": tr("Model"),
        "best": tr("smallest left-out error for each response"),
        "response": tr("Response"),
        "load": tr("load F"),
        "held": tr("Held at {value} {unit} in this study: its models do not depend on it."),
        "not_in_study": tr("This study does not vary it, and its cases do not state it."),
        "one_load": tr("The stiffness is fitted at this load only."),
        "load_stops": tr("Stops at the loads that have a surface: {loads} N."),
        "box": tr("Solved cases: {low} to {high} {unit}"),
        "outside": tr(
            "Outside the solved cases: {list}. Models that cannot be trusted there give no number."
        ),
        "outside_one": tr("{label} {value} {unit} (cases {low} to {high})"),
        "inside": tr("Inside the box of the solved cases."),
        "plates_used": tr("{solver} uses whole plates: {count} plates at a pitch of {pitch} mm."),
        "plates_given": tr(
            "{solver} takes the spacing as given. Whole plates in the width of {width} mm: "
            "{count} at a pitch of {pitch} mm."
        ),
        "displacement": tr("displacement"),
        "derived": tr("load divided by the stiffness of the same model"),
        "exact": tr("exact"),
        "unbounded": tr("no bound"),
        "refused": tr("no number: outside the cases, where this model is refused"),
        "flagged": tr("outside the cases: value without an interval"),
        "not_by_model": tr("this model is not fitted to this response"),
        "not_fitted": tr(
            "not fitted: add {name} to “responses” of study {study} ({count} solved cases have it)"
        ),
        "not_given": tr("{solver} does not give it"),
        "constant": tr(
            "the same in all {count} solved cases: it depends on no factor of this study"
        ),
        "left_out": tr("left-out error {rms} {unit} (rms)"),
        "left_out_head": tr("left-out error (rms)"),
        "bias_head": tr("bias band"),
        "bias_note": tr(
            "Bias band: where the published FE model is expected, from the {cases} blind cases of "
            "this study, which differ from it by {least} to {most} % (mean {mean} %). It is not "
            "part of the interval."
        ),
        "bias_reference": tr("This solver is the published values themselves: it has no bias."),
        "bias_none": tr("Bias not assessed: no blind case has a published value."),
        "value_head": tr("value"),
        "interval_head": tr("95 % interval"),
        "band": tr("Target band"),
        "band_low": tr("lower end of the target band"),
        "band_high": tr("upper end of the target band"),
        "band_in": tr("inside the target band"),
        "band_sure": tr("inside with its whole interval"),
        "band_out": tr("outside the target band"),
        "profiles": tr("Profiles"),
        "profile_alt": tr(
            "{response} against {factor}: {start} at {low}, {here} at the design, {end} at {high} "
            "{unit}"
        ),
        "profile_refused": tr("{response} against {factor}: no value at this design"),
        "plane": tr("Plane of two factors"),
        "across": tr("horizontal axis"),
        "up": tr("vertical axis"),
        "plane_response": tr("shown"),
        "plane_alt": tr(
            "Contour map of {response} over {across} and {up}; {share} % of the plane is inside "
            "the target band"
        ),
        "plane_share": tr(
            "{share} % of this plane is inside the target band of the stiffness, {sure} % with "
            "the whole interval."
        ),
        "plane_none": tr("The other factors lie outside the cases: no value in this plane."),
        "plane_one": tr("The study varies only one factor: there is no plane."),
        "view3d": tr("3-D view"),
        "view3d_alt": tr(
            "{response} as a surface over {across} and {up}, seen from {turn} degrees"
        ),
        "turn": tr("turn"),
        "tilt": tr("tilt"),
        "ring": tr("Deformed ring"),
        "ring_alt": tr(
            "Deformed ring at {load} N, displacement {delta} mm, contact length {length} mm"
        ),
        "ring_from": tr(
            "Load-bearing analysis (LCA), solved in this page: ring with T-C {band} MPa, spokes of "
            "S-C {spoke} MPa ({table}) with their stiffness times {factor}, so that the "
            "displacement is that of the chosen model, {delta} mm. By the LCA: contact length "
            "{length} mm (contact angle {contact}°), transition at {transition}°."
        ),
        "ring_own": tr(
            "Load-bearing analysis (LCA), solved in this page: ring with T-C {band} MPa, spokes of "
            "S-C {spoke} MPa ({table}). Displacement {delta} mm, contact length {length} mm "
            "(contact angle {contact}°), transition at {transition}°."
        ),
        "ring_none": tr("No ring is drawn: no study of this run is solved by the LCA."),
        "ring_outside": tr(
            "No ring is drawn: the spoke table {table} covers only S-C {low} to {high} MPa."
        ),
        "ring_unsolved": tr("No ring is drawn: the LCA does not reach this load."),
        "ring_unknown": tr("No ring is drawn: this study does not state its rubbers."),
        "magnified": tr("drawn to scale"),
        "spokes_tension": tr("spokes in tension"),
        "spokes_compression": tr("spokes in compression"),
        "curve": tr("Load and displacement"),
        "curve_alt": tr("Load against displacement of this design: {list}"),
        "curve_point": tr("{load} N at {delta} mm"),
        "models": tr("All models at this design"),
        "models_lead": tr(
            "Each stored surface of {response}. Values of another study apply to the values that "
            "it holds fixed, which are given next to them."
        ),
        "not_same": tr("applies to {list}, not to this design"),
        "copy_link": tr("Copy link to this state"),
        "copy_find": tr("Copy nptcs design: find a design in the band"),
        "copy_judge": tr("Copy nptcs design: judge this design"),
        "copy_config": tr("Copy config block of this design"),
        "copied": tr("Copied."),
        "copy_by_hand": tr("Copy it from here:"),
        "config_lead": tr(
            "# A design from the explorer: paste this under the study {study} of the configuration."
        ),
        "reset": tr("Back to the reference design"),
        "case": tr("solved cases near the slice"),
        "legend_value": tr("model"),
        "legend_interval": tr("95 % interval"),
        "legend_bias": tr("bias band"),
        "legend_band": tr("target band"),
        "legend_edge": tr("edge of the target band of the stiffness"),
        "legend_sure": tr("edge of the region where the whole interval is inside"),
        "legend_dim": tr("dimmed: outside the band"),
        "no_value": tr("no value"),
        "synthetic": tr("SYNTHETIC DATA"),
        "slider": tr("{label}, slider"),
        "number": tr("{label}, number"),
        "settings": tr("Design and model"),
        "results": tr("Prediction"),
    }
