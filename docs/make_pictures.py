"""Make the pictures of the docs from finished runs, in headless Chromium.

``python docs/make_pictures.py FOLDER`` takes a project folder in which the tutorial was followed
and writes ``docs/images/tutorial-*.png``: sections of its report. With ``--report`` the folder is
one in which the default study was run, and ``docs/images/report.png`` is the top of its report.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

IMAGES = Path(__file__).parent / "images"
BROWSER = shutil.which("chromium") or shutil.which("google-chrome")
OPTIONS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--hide-scrollbars",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--virtual-time-budget=10000",
]
ONLY = """<style>
section:not(#{section}), h1, nav, header, footer {{ display: none !important }}
</style>"""
FIGURES = """<style>
section *:not(:has(.plots), .plots, .plots *, h2) { display: none !important }
</style>"""
WIDTH = 1000
TUTORIAL = {
    "first-screen": ("", 760),
    "explorer": ("explore", 900),
    "curves": ("specimens figures", 640),
    "materials": ("materials", 760),
    "surface": ("surfaces figures", 640),
    "decision": ("decision", 620),
}
"""Picture → section of the report and height in pixels.

Without a section it is the page from its top; ``figures`` leaves out tables and text.
"""


def shoot(page: Path, what: str, height: int, picture: Path) -> None:
    """Draw the top of a page, or of one of its sections, into a PNG file of 64 colours."""
    section, _, figures = what.partition(" ")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        text = page.read_text(encoding="utf-8")
        if section and f'id="{section}"' not in text:
            raise SystemExit(f"{page} has no section {section!r}")
        copy = folder / "page.html"
        style = ONLY.format(section=section) if section else ""
        copy.write_text(text + style + (FIGURES if figures else ""), "utf-8")
        size = [f"--window-size={WIDTH},{height}", f"--user-data-dir={folder / 'profile'}"]
        shot = folder / "shot.png"
        command = [str(BROWSER), *OPTIONS, *size, f"--screenshot={shot}", copy.as_uri()]
        subprocess.run(command, check=True, capture_output=True, timeout=180)
        with Image.open(shot) as image:
            picture.parent.mkdir(exist_ok=True)
            image.convert("RGB").quantize(64).save(picture, optimize=True)
    print(f"{picture} ({picture.stat().st_size / 1000:.0f} kB)")


def main() -> int:
    """Write the pictures; 2 if there is no browser or no report."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", type=Path, help="project folder with a finished run")
    parser.add_argument("--report", action="store_true", help="only docs/images/report.png")
    arguments = parser.parse_args()
    page = arguments.folder.resolve() / "results" / "report.html"
    if BROWSER is None or not page.is_file():
        why = "Chromium is not installed" if BROWSER is None else f"{page} does not exist"
        print(why, file=sys.stderr)
        return 2
    if arguments.report:
        shoot(page, "", 900, IMAGES / "report.png")
    else:
        for name, (what, height) in TUTORIAL.items():
            shoot(page, what, height, IMAGES / f"tutorial-{name}.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
