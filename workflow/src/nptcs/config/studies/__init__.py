"""Configuration of studies: factors, designs, responses, surfaces, sensitivity, decisions.

What a study asks about the tyre is here. How a solver meshes and solves it is in
`nptcs.config.solvers`.
"""
