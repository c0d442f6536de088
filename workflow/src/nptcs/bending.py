"""A rectangular bar bent at three or four points: stress and strain of its outer face.

Small deflections of an Euler–Bernoulli beam on supports a span L apart, loaded at mid-span or by
two rollers a distance L_i apart, each carrying F/2 at a = (L - L_i)/2 from its support:

    σ = 3 F (L - L_i)/(2 b h²)
    ε = 12 h D/(3 L² - 4 a²)        D measured at mid-span
    ε = 3 h δ/(a (3 L - 4 a))       δ measured at the loading rollers (crosshead)

With L_i = 0 both are 3FL/(2bh²) and 6hD/L² (ASTM D790, D7264 procedure A, ISO 14125 method A);
L_i = L/2 gives 3FL/(4bh²) and 4.36 hD/L² (D7264 procedure B), L_i = L/3 gives FL/(bh²) and
4.70 hD/L² (ISO 14125 method B).
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class BentBar:
    """Dimensions of a bending test, mm; `loading_span_mm` is 0 at three points."""

    width_mm: float
    thickness_mm: float
    span_mm: float
    loading_span_mm: float = 0.0

    @property
    def points(self) -> int:
        """3 or 4."""
        return 4 if self.loading_span_mm else 3

    @property
    def stress_per_force(self) -> float:
        """σ/F of the outer face (1/mm²)."""
        arm = self.span_mm - self.loading_span_mm
        return 3 * arm / (2 * self.width_mm * self.thickness_mm**2)

    @property
    def strain_per_deflection(self) -> float:
        """ε/D with the deflection at mid-span (1/mm)."""
        arm = (self.span_mm - self.loading_span_mm) / 2
        return 12 * self.thickness_mm / (3 * self.span_mm**2 - 4 * arm**2)

    @property
    def strain_per_roller_travel(self) -> float:
        """ε/δ with the deflection at the loading rollers, as crosshead travel is (1/mm)."""
        arm = (self.span_mm - self.loading_span_mm) / 2
        return 3 * self.thickness_mm / (arm * (3 * self.span_mm - 4 * arm))

    def words(self) -> str:
        """Say how the bar was held: points, span, loading span, span to thickness."""
        parts = [f"{self.points} points", f"span {self.span_mm:g} mm"]
        if self.loading_span_mm:
            parts.append(f"loading span {self.loading_span_mm:g} mm")
        return ", ".join([*parts, f"L/h {self.span_mm / self.thickness_mm:.3g}"])
