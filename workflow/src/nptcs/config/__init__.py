"""The study's configuration: one strict schema, a description for each key.

A mapping from YAML comes in; a checked `root.Config` goes out (`root.read_config`), or an error
that names the key. Defaults are here; what is done with a setting is not.
"""
