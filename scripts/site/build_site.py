"""One static site of the README, the pages below docs/ and the manual pages.

build_site.py REPOSITORY FOLDER_OF_MANUAL_PAGES OUTPUT
"""
import html
import pathlib
import re
import shutil
import subprocess
import sys

import markdown

STYLE = """
body { margin: 0 auto; max-width: 56rem; padding: 0 1rem 4rem; font: 1rem/1.55 system-ui, sans-serif;
  color: #1b1f24; background: #fff; }
nav { padding: .8rem 0; border-bottom: 1px solid #d5dae0; margin-bottom: 1.5rem; }
nav a { margin-right: 1rem; white-space: nowrap; }
a { color: #0b5cad; }
img { max-width: 100%; }
pre { overflow-x: auto; padding: .8rem; background: #f4f6f8; border-radius: 4px; }
code { font-size: .92em; }
table { border-collapse: collapse; display: block; overflow-x: auto; }
th, td { border: 1px solid #d5dae0; padding: .3rem .6rem; text-align: left; vertical-align: top; }
@media (prefers-color-scheme: dark) {
  body { color: #dfe3e8; background: #15181c; } a { color: #79b8ff; }
  pre { background: #20242a; } nav, th, td { border-color: #3a4048; }
}
"""

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title><link rel="stylesheet" href="{up}style.css"></head>
<body><nav>{links}</nav>
<main>
{body}
</main></body></html>
"""

# In the order of the menu: source below the repository, page below the site, name.
PAGES = [("README.md", "index.html", "libflbc"),
         ("docs/reference.md", "docs/reference.html", "Reference"),
         ("docs/tutorials/2d_cage.md", "docs/tutorials/2d_cage.html", "A 2D cage"),
         ("docs/tutorials/model.md", "docs/tutorials/model.html", "A model"),
         ("docs/tutorials/openmesh.md", "docs/tutorials/openmesh.html", "OpenMesh"),
         ("docs/tutorials/game_engine.md", "docs/tutorials/game_engine.html", "A game engine"),
         ("docs/tutorials/change_the_solver.md", "docs/tutorials/change_the_solver.html",
          "Change the solver"),
         ("docs/method.md", "docs/method.html", "Method"),
         ("docs/results.md", "docs/results.html", "Results"),
         ("docs/reliability.md", "docs/reliability.html", "Reliability"),
         ("docs/architecture.md", "docs/architecture.html", "Architecture"),
         ("docs/lab_book.md", "docs/lab_book.html", "Lab book"),
         ("CONTRIBUTING.md", "CONTRIBUTING.html", "Contributing"),
         ("CHANGELOG.md", "CHANGELOG.html", "Changelog")]


def slug(text, separator):
    """The anchor of a heading, as readers of Markdown on code hosts make it."""
    text = re.sub(r"[^\w\- ]", "", text.strip().lower())
    return text.replace(" ", separator)


class Site:
    def __init__(self, repository, manuals, output):
        self.repository = repository
        self.manuals = manuals
        self.output = output
        self.page_of = {source: page for source, page, _ in PAGES}
        for source in sorted((repository / "docs").rglob("*.md")):
            name = source.relative_to(repository).as_posix()
            if name != "libflbc/mainpage.md" and name not in self.page_of:
                sys.exit(f"{name} is not in the menu of scripts/site/build_site.py")

    def menu(self, up):
        links = [(page, name) for _, page, name in PAGES]
        links += [("man/index.html", "Manual pages"), ("api/index.html", "C++")]
        return "\n".join(f'<a href="{up}{page}">{name}</a>' for page, name in links)

    def write(self, page, title, body):
        path = self.output / page
        path.parent.mkdir(parents=True, exist_ok=True)
        up = "../" * page.count("/")
        path.write_text(PAGE.format(title=html.escape(title), up=up, links=self.menu(up), body=body))

    def target(self, source, link):
        """Where a link of a page leads on the site; files that are no pages are copied there."""
        if re.match(r"[a-z]+:|#", link):
            return link
        path, _, anchor = link.partition("#")
        name = (self.repository / source).parent.joinpath(path).resolve()
        name = name.relative_to(self.repository).as_posix()
        up = "../" * self.page_of[source].count("/")
        if name in self.page_of:
            return up + self.page_of[name] + ("#" + anchor if anchor else "")
        file = self.repository / name
        if file.is_dir():
            return up + self.listing(name)
        copy = self.output / "files" / name if not name.startswith("docs/") else self.output / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        if file.exists():
            shutil.copyfile(file, copy)
        return up + copy.relative_to(self.output).as_posix()

    def listing(self, name):
        """A page with the files of a folder."""
        page = f"files/{name}/index.html"
        items = []
        for file in sorted((self.repository / name).iterdir()):
            if not file.is_file():
                continue
            copy = self.output / "files" / name / file.name
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, copy)
            items.append(f'<li><a href="{html.escape(file.name)}">{html.escape(file.name)}</a></li>')
        self.write(page, name, f"<h1>{name}</h1>\n<ul>\n" + "\n".join(items) + "\n</ul>")
        return page

    def write_pages(self):
        for source, page, name in PAGES:
            text = (self.repository / source).read_text()
            # Lists may follow a paragraph without a line between, as readers of Markdown allow.
            text = re.sub(r"(?m)^(?!\s*[-*] |\s*\d+\. |\s*$|\|)(.*\S.*)\n(?=- )", r"\1\n\n", text)
            body = markdown.markdown(
                text, extensions=["tables", "fenced_code", "toc", "sane_lists"],
                extension_configs={"toc": {"slugify": slug}}, tab_length=2)
            body = body.replace("\\|", "|")  # which a table needs and code would show
            body = re.sub(r'\b(href|src)="([^"]+)"',
                          lambda m: f'{m[1]}="{self.target(source, html.unescape(m[2]))}"', body)
            self.write(page, "libflbc" if name == "libflbc" else f"{name} - libflbc", body)

    def write_manuals(self):
        names = sorted(path.stem for path in self.manuals.glob("*.1"))
        if not names:
            sys.exit(f"no manual pages in {self.manuals}")
        for name in names:
            text = subprocess.run(["groff", "-man", "-Tutf8", "-P-cbou", "-rLL=90n",
                                   str(self.manuals / f"{name}.1")],
                                  check=True, capture_output=True, text=True).stdout
            self.write(f"man/{name}.html", f"{name}(1)", f"<pre>{html.escape(text)}</pre>")
        items = "\n".join(f'<li><a href="{name}.html">{name}(1)</a></li>' for name in names)
        self.write("man/index.html", "Manual pages - libflbc",
                   f"<h1>Manual pages</h1>\n<ul>\n{items}\n</ul>")


def main():
    repository, manuals, output = (pathlib.Path(name).resolve() for name in sys.argv[1:4])
    output.mkdir(parents=True, exist_ok=True)
    (output / "style.css").write_text(STYLE.lstrip())
    site = Site(repository, manuals, output)
    site.write_pages()
    site.write_manuals()


if __name__ == "__main__":
    main()
