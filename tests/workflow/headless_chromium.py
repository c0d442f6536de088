"""Chromium without a window, without network and with a clock of its own."""

import shutil

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome")


def quiet(milliseconds):
    """Options of a run that ends after so much of the page's own time."""
    return [
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-quic",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        f"--virtual-time-budget={milliseconds}",
    ]
