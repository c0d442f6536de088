"""What every part of the configuration has in common: nothing unknown, nothing changed later."""

from pydantic import BaseModel, ConfigDict


class Strict(BaseModel):
    """A configuration section that refuses unknown keys and infinite numbers."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
