"""The open finite element route: a spoke in 3D, its energy table, the tyre on 60 of them."""
