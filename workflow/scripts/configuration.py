"""Write the whole configuration of the run, defaults included."""

from typing import Any

import yaml

from nptcs.console import clear_errors
from nptcs.files import write_text


def write(job: dict[str, Any], configuration: str) -> None:
    text = yaml.safe_dump(job["config"], allow_unicode=True, sort_keys=False)
    write_text(configuration, text)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        write(**snakemake.params, **snakemake.output)
