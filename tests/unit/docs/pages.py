"""Follow a how-to page: write its files, apply its edits, run its commands, compare the output.

A fenced block with a file name after the language is that file's content; ``diff FILE`` edits a
file; ``sh`` runs commands, of which a comment ``# exit code N`` states the exit code, and words
after the language keep them from being run; ``text`` without a file name quotes lines that the last
commands printed.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

BLOCK = re.compile(r"^```(\w+) *([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
EXIT_CODE = re.compile(r"# exit code (\d+)$")
PROGRAMS = {
    "nptcs": [sys.executable, "-m", "nptcs.cli"],
    "snakemake": [sys.executable, "-m", "snakemake"],
    "python": [sys.executable],
    "cat": ["cat"],
    "cp": ["cp"],
    "mkdir": ["mkdir"],
}


def follow(page: Path, tree: Path) -> None:
    """Carry out in `tree`, a copy of the project, what `page` says."""
    printed = None
    blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
    assert blocks, f"{page} has no fenced blocks"
    for language, file, content in blocks:
        if language == "sh" and file:
            continue  # words after the language say what the block needs that is not here
        if language == "sh":
            printed = run_commands(content, tree)
        elif language == "diff":
            edit(tree / file, content)
        elif file:
            write(tree / file, content)
        else:
            assert printed is not None, f"nothing was run before this block:\n{content}"
            missing = [line for line in content.splitlines() if line not in printed]
            assert not missing, f"not printed: {missing}\nprinted:\n{printed}"


def write(path: Path, content: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content, encoding="utf-8")


def edit(path: Path, diff: str) -> None:
    """Apply the hunks of a diff, separated by ``@@`` lines; each must fit exactly one place."""
    text = path.read_text(encoding="utf-8")
    for hunk in re.split(r"^@@.*\n", diff, flags=re.MULTILINE):
        lines = [line or " " for line in hunk.splitlines()]
        old = "".join(f"{line[1:]}\n" for line in lines if line[0] in " -")
        new = "".join(f"{line[1:]}\n" for line in lines if line[0] in " +")
        assert old, f"a hunk of {path} has no line that shows where it belongs:\n{hunk}"
        assert text.count(old) == 1, f"{text.count(old)} places in {path} read:\n{old}"
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")


def run_commands(lines: str, tree: Path) -> str:
    """Run the commands of a shell block with the package of `tree`; return what they printed."""
    environment = {
        **os.environ,
        "PYTHONPATH": str(tree / "workflow" / "src"),
        "OPENBLAS_NUM_THREADS": "1",
    }
    printed = ""
    for line in lines.replace("\\\n", " ").splitlines():
        code = EXIT_CODE.search(line)
        program, *words = shlex.split(line, comments=True)
        arguments = [name for word in words for name in expand(word, tree)]
        done = subprocess.run(
            [*PROGRAMS[program], *arguments],
            cwd=tree,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        printed += done.stdout + done.stderr
        expected = int(code.group(1)) if code else 0
        assert done.returncode == expected, f"{line}: exit code {done.returncode}\n{printed}"
    return printed


def expand(word: str, tree: Path) -> list[str]:
    """Return the files that a word with wildcards stands for, as a shell does, or the word."""
    if not set("*[") & set(word) or "=" in word:
        return [word]
    found = sorted(str(file.relative_to(tree)) for file in tree.glob(word))
    return found or [word]
