"""The study's configuration: one strict schema, a description for each key."""
