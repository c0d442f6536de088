"""The subcommands of ``nptcs``: one module each, with ``register(subparsers)``.

``register`` only declares arguments and sets ``run`` as the parser's default; heavy imports
belong inside ``run(arguments) -> int`` so that ``nptcs --help`` stays fast.
"""
