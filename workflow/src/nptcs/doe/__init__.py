"""Design of experiments: points in coded units, [-1, 1] for each factor, without a study."""
