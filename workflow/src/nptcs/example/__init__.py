"""The seeded, synthetic example data: known truth, realistic files."""
