"""The campaign: many solver cases, each isolated, each recorded, none solved twice."""
