"""Names of responses as a reader knows them; tables and the configuration use other names."""

from __future__ import annotations

from collections.abc import Mapping

from nptcs.language import translatable

RESPONSE_TITLES: Mapping[str, str] = {
    "secant_stiffness": translatable("vertical stiffness"),
    "tangent_stiffness": translatable("tangent stiffness"),
    "contact_length": translatable("contact length"),
    "largest_pressure": translatable("largest contact pressure"),
    "mean_pressure": translatable("mean contact pressure"),
    "largest_spoke_force": translatable("largest spoke force"),
    "smallest_spoke_force": translatable("smallest spoke force"),
    "plate_largest_mises": translatable("peak plate stress (von Mises)"),
    "plate_largest_mean_mises": translatable("peak mean plate stress (von Mises)"),
    "plate_largest_along_fibres": translatable("largest plate stress along the fibres"),
    "plate_smallest_along_fibres": translatable("smallest plate stress along the fibres"),
    "plate_largest_across_fibres": translatable("largest plate stress across the fibres"),
    "plate_smallest_across_fibres": translatable("smallest plate stress across the fibres"),
    "plate_largest_shear": translatable("largest plate shear stress"),
    "plate_factor_maximum_stress": translatable("plate strength factor (maximum stress)"),
    "plate_factor_tsai_wu": translatable("plate strength factor (Tsai-Wu)"),
    "rubber_largest_principal_strain": translatable("largest rubber strain"),
    "rubber_largest_energy_density": translatable("largest rubber energy density"),
    "plate_mass": translatable("plate mass"),
    "plate_cost": translatable("plate cost"),
}
"""Title of each response, by its name in `nptcs.config.studies.response`."""
