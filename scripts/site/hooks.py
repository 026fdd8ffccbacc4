# SPDX-License-Identifier: BSD-3-Clause
"""What MkDocs does not do on its own: command pages, the Python module, the changelog, and links to files
outside docs/.

The command pages have the help of the program FLBC_PROGRAM.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import python_reference  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
KATEX = pathlib.Path("/usr/share/javascript/katex")
OUTSIDE = "outside:"  # MkDocs leaves links with a scheme alone
LINK = re.compile(r"(\]\()([^)\s#]+)(#[^)\s]*)?(\))")


def help_of(*arguments):
    return subprocess.run([os.environ["FLBC_PROGRAM"], *arguments], check=True, capture_output=True, text=True).stdout


def generated():
    """Pages that are not in docs/, by their path on the site."""
    pages = {"changelog.md": (ROOT / "CHANGELOG.md").read_text(), "reference/python.md": python_reference.page()}
    index = "# Commands\n\nThe program `flbc` has these commands.\n\n| Command | Purpose |\n|---|---|\n"
    commands = help_of("--help").partition("Commands:")[2]
    for name, purpose in re.findall(r"^  ([a-z]+) +(.*(?:\n {30}.*)*)", commands, re.M):
        index += f"| [`flbc {name}`]({name}.md) | {' '.join(purpose.split())} |\n"
        example = (DOCS / "reference" / "cli" / f"{name}.sh").read_text()
        pages[f"reference/cli/{name}.md"] = (
            f"# flbc {name}\n\n```text\n{help_of(name, '--help-all')}```\n\n## Example\n\n```sh\n{example}```\n\n"
            "See also: [exit status](../file_formats.md#exit-status), [all commands](index.md).\n")
    pages["reference/cli/index.md"] = index
    return pages


def on_files(files, config):
    folder = pathlib.Path(config["site_dir"] + ".generated")
    shutil.rmtree(folder, ignore_errors=True)
    for name, text in generated().items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        files.append(File(name, str(folder), config["site_dir"], config["use_directory_urls"]))
    for file in files.media_files():
        if file.src_path.startswith("reference/cli/"):
            files.remove(file)
    return files


def on_page_markdown(markdown, page, config, files):
    """Links to files outside docs/ lead to copies below files/."""
    def relink(found):
        target = found[2]
        if re.match(r"[a-z]+:", target) or files.get_file_from_path(
                os.path.normpath(os.path.join(os.path.dirname(page.file.src_path), target))):
            return found[0]
        if page.file.src_path == "changelog.md":
            name = ROOT / target
        else:
            name = (DOCS / page.file.src_path).parent / target
        name = pathlib.Path(os.path.normpath(name))
        if not name.exists() or not name.is_relative_to(ROOT):
            return found[0]
        inside = name.relative_to(ROOT)
        if inside.parts[0] == "docs" and name.suffix == ".md":
            up = os.path.relpath(inside.relative_to("docs"), os.path.dirname(page.file.src_path) or ".")
            return f"{found[1]}{up}{found[3] or ''}{found[4]}"
        copy = pathlib.Path(config["site_dir"]) / "files" / inside
        linked.append((name, copy))
        if name.is_dir():
            inside = inside / "index.html"
        up = os.path.relpath(pathlib.Path("files") / inside, os.path.dirname(page.file.src_path) or ".")
        return f"{found[1]}{OUTSIDE}{up}{found[4]}"
    return LINK.sub(relink, markdown)


linked = []


def on_post_page(output, page, config):
    return output.replace(OUTSIDE, "")


def listing(folder, copy):
    """The files of a folder, and a page that links to them."""
    copy.mkdir(parents=True, exist_ok=True)
    names = sorted(file.name for file in folder.iterdir() if file.is_file())
    for name in names:
        shutil.copyfile(folder / name, copy / name)
    title = folder.relative_to(ROOT).as_posix()
    items = "\n".join(f'<li><a href="{name}">{name}</a></li>' for name in names)
    (copy / "index.html").write_text(
        f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>{title}</title>\n'
        f"<h1>{title}</h1>\n<ul>\n{items}\n</ul></html>\n")


def on_post_build(config):
    site = pathlib.Path(config["site_dir"])
    katex = site / "assets" / "katex"
    (katex / "fonts").mkdir(parents=True, exist_ok=True)
    for name in ("katex.min.css", "katex.min.js", "contrib/auto-render.js"):
        shutil.copyfile(KATEX / name, katex / pathlib.Path(name).name)
    for font in (KATEX / "fonts").iterdir():
        if font.suffix in (".woff2", ".woff", ".ttf"):
            shutil.copyfile(font, katex / "fonts" / font.name)
    for name, copy in linked:
        if name.is_dir():
            listing(name, copy)
        else:
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(name, copy)
    shutil.rmtree(config["site_dir"] + ".generated", ignore_errors=True)
