"""What all configuration sections share: unknown keys are refused, values are frozen."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]
"""Name of a study, factor, solver or decision: part of file names."""


class Strict(BaseModel):
    """A configuration section that refuses unknown keys and infinite numbers."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
