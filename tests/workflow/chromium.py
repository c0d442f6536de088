"""One page in Chromium, with its requests and complaints; real key presses and touches."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from axe_check import CHROMIUM as CHROMIUM
from axe_check import LIMIT_MS, chromium
from axe_check import NO_CHROMIUM as MISSING

__all__ = ["CHROMIUM", "MISSING", "Tab", "browser"]

LOCAL = ("file:", "data:", "about:", "blob:")
PHONE_PX = 390
TWO_FRAMES = "new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(() => r())))"


class Tab:
    """A page in a browser.

    Parameters
    ----------
    started : playwright's Browser
    width : int
        Of the screen in CSS pixels; a phone can be touched.
    dark : bool
        Whether its user prefers dark colours.
    """

    def __init__(self, started, width: int = 1280, *, dark: bool = False) -> None:
        self.complaints: list[str] = []
        self.requests: list[str] = []
        phone = width <= PHONE_PX
        self._context = started.new_context(
            viewport={"width": width, "height": 900},
            color_scheme="dark" if dark else "light",
            has_touch=phone,
            is_mobile=phone,
        )
        self.page = self._context.new_page()
        self.page.set_default_timeout(LIMIT_MS)
        self.page.on("console", self._said)
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("request", self._asked)

    def _said(self, message) -> None:
        if message.type in ("error", "warning", "assert"):
            self.complaints.append(message.text)

    def _asked(self, request) -> None:
        if not request.url.startswith(LOCAL):
            self.requests.append(request.url)

    def close(self) -> None:
        """Close the page."""
        self._context.close()

    def open(self, address: str) -> None:
        """Load a page anew, even if only the part after # differs."""
        self.page.goto("about:blank")
        self.page.goto(address)
        self.drawn()

    def drawn(self) -> None:
        """Wait until the page has drawn what changed."""
        self.value(TWO_FRAMES)

    def value(self, expression: str):
        """Evaluate an expression of the page."""
        return self.page.evaluate(expression)

    def text(self, selector: str) -> str:
        """Return the text of an element as it is shown."""
        return self.page.locator(selector).inner_text()

    def press(self, *keys: str) -> None:
        """Press keys one after the other."""
        for key in keys:
            self.page.keyboard.press(key)
        self.drawn()

    def touch(self, x: float, y: float) -> None:
        """Tap with a finger."""
        self.page.touchscreen.tap(x, y)
        self.drawn()


@contextlib.contextmanager
def browser(width: int = 1280, *, dark: bool = False) -> Iterator[Tab]:
    """Start Chromium with one page."""
    with chromium() as started:
        tab = Tab(started, width, dark=dark)
        yield tab
        tab.close()
