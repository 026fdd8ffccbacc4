"""No link of a static site leads nowhere: files and anchors within it are there.

check_links.py SITE
"""
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            elif name in ("id", "name") and value:
                self.anchors.add(value)


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    pages = {path: Page(path.read_text(errors="replace")) for path in sorted(site.rglob("*.html"))}
    dead, checked = [], 0
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            checked += 1
            name = urllib.parse.unquote(parts.path)
            folder = site if name.startswith("/") else path.parent
            target = (folder / name.lstrip("/")).resolve() if name else path
            anchor = urllib.parse.unquote(parts.fragment)
            # Doxygen's pages have anchors of its own that it does not always set.
            is_checked = path.relative_to(site).parts[0] != "api"
            if not target.exists() or target.is_dir():
                dead.append(f"{path.relative_to(site)}: {link}")
            elif is_checked and anchor and target in pages and anchor not in pages[target].anchors:
                dead.append(f"{path.relative_to(site)}: {link}: no such place on that page")
    for line in dead:
        print(line)
    print(f"{len(pages)} pages, {checked} links within the site, {len(dead)} of them dead")
    return 1 if dead or not pages or not checked else 0


if __name__ == "__main__":
    sys.exit(main())
