"""Check the built site: `python docs/check_site.py build/site`.

Every link and picture must lead to a file of the site, every anchor to an element with that name,
and no page may load anything from a network.
"""

from __future__ import annotations

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}
"""What a browser fetches by itself; a link is followed by the reader only."""


class Page(HTMLParser):
    """The names, the links and the loaded files of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.names: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what the tag names and where it leads."""
        for key, value in attrs:
            if value is None:
                continue
            if key == "id" or (tag == "a" and key == "name"):
                self.names.add(value)
            elif (tag, key) in LOADED:
                self.loaded.append(value)
            elif (tag, key) == ("a", "href"):
                self.links.append(value)


def faults(site: Path) -> list[str]:
    """Return what is wrong with the links of a site, one line each."""
    pages = {file: Page(file.read_text(encoding="utf-8")) for file in sorted(site.rglob("*.html"))}
    found = []
    for file, page in pages.items():
        here = file.relative_to(site)
        found += [f"{here}: loads {url}" for url in page.loaded if _is_outside(url)]
        for url in [*page.links, *page.loaded]:
            parts = urlsplit(url)
            if _is_outside(url) or parts.scheme in {"mailto", "data"}:
                continue
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            if not target.is_file():
                found.append(f"{here}: {url} leads to no file")
            elif parts.fragment and target.suffix == ".html":
                names = pages[target].names if target in pages else set()
                if unquote(parts.fragment) not in names:
                    found.append(f"{here}: {url} leads to no such heading")
    return found


def _is_outside(url: str) -> bool:
    parts = urlsplit(url)
    return parts.scheme in {"http", "https"} or bool(parts.netloc)


def main() -> int:
    """Print the faults of the site; 1 if there are any."""
    site = Path(sys.argv[1]).resolve()
    if not (site / "index.html").is_file():
        print(f"{site} is not a built site: it has no index.html", file=sys.stderr)
        return 2
    wrong = faults(site)
    pages = len(list(site.rglob("*.html")))
    print("\n".join(wrong) or f"all links of {pages} pages lead somewhere")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
