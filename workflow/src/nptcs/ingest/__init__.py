"""Raw files of test machines and cameras into one tidy curve a specimen."""
