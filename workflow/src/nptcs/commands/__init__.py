"""The subcommands of ``nptcs``: one module for each, with ``register(subparsers)``.

Command-line arguments come in, the package's functions do the work, text and files go out.
``register`` only declares arguments and sets ``run`` as the parser's default; heavy imports
belong inside ``run(arguments) -> int`` so that ``nptcs --help`` stays quick. Code that a rule of
the workflow needs does not belong here.
"""
