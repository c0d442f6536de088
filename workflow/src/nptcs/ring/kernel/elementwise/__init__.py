"""Energies of the ring's parts: residuals and tangents as formulas for NumPy and for numba.

Each function takes its unknowns by component: `m[3]` is ψ, a number where numba compiles the
function and calls it element by element, an array over all elements where NumPy runs it. So no
branch may depend on a value. Loops over elements, nodes and spokes belong to the kernels.

An element's variables are the means m = (u_x, u_y, θ, ψ, s) of its two nodes' unknowns and their
differences over its length, d = (Δu_x, Δu_y, Δθ, Δψ, Δs)/L; force and tangent have ten components,
m before d. θ and ψ turn the tangent t towards the outward normal n:

    t(ψ) = (cos α, sin α),  n(ψ) = (sin α, -cos α),  α = Θ - ψ,  Θ the element's angle.
"""
