"""Configuration of studies: factors, designs, responses, surfaces, sensitivity, decisions.

What is asked of the tyre is here. How a solver meshes and solves it is in
`nptcs.config.solvers`.
"""
