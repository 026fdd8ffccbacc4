#!/usr/bin/env python3
"""Checks that pages are short and their sentences plain, by the rules of docs/contributing/index.md.

check_prose.py [PAGE...]   default: every page of the repository
check_prose.py FOLDER      only the "Next" links of its pages

From index.md, the "Next" links of the pages in docs/ lead to every one of them.

A page has at most 12 kB, without generated tables. Its sentences have at most 20 words on average and none more than 35. Tables,
code, formulas on lines of their own, and titles are not sentences. Files named in backticks exist. No sentence
has the hash of a commit, or a measurement without a marker.
"""
import pathlib
import re
import subprocess
import sys

MEAN, LONGEST, SIZE = 20, 35, 12_000
# Records that grow: neither their size nor their measurements are checked.
LONG = {"CHANGELOG.md", "experiments.md"}
# What readers stumble over, and what to write instead.
HABITS = {
    r"beside": "next to, outside, in addition to",
    r"by a hair": "the distance",
    r"whoever|whatever|whichever": "a subject",
    r"by itself|by themselves": "on its own",
    r"what becomes of|what comes out": "a noun",
    r"to the (same )?bits?\b|same bits": "bit-identical",
    r"mend(s|ed|ing)?": "fix, repair",
    r"(goes|go|going|gone|went) on (from|with)": "resume",
    r"stands? (in|for itself|beside|there)": "is",
    r"tells? (what|how|which|whether|that)": "reports, shows",
    r"rooms?|floors?|judges?": "module, layer, reference test",
    r"as it takes|it takes to": "is needed",
    r"is none\b": "is not an error, is not one of",
    r"round (a|an|the|its)": "around",
    r"\d %": "percent without a space",
}
# A measurement in a sentence has a marker, which benchmarks/paper/docs.py checks.
NUMBER = r"<!--n:[\w.-]+-->.*?<!--/n-->"
GENERATED = r"<!-- results: \w+ -->.*?<!-- end of results -->"
HASH = r"\b(?=[a-f]*\d)(?=\d*[a-f])[0-9a-f]{7,8}\b"
COUNT = r"\b(?:\d[\d.,]*|(?:two|three|four|five|six|seven|eight|nine|ten|twenty)(?= ))"
MEASUREMENT = (rf"{COUNT}(?: to {COUNT})? ?(?:s|ms|min|minutes|seconds|hours|KiB|MiB|GiB|MB|GB)\b(?!\w)"
               rf"|{COUNT} times (?:as |faster|slower)|\b\d[\d.,]* times the ")
# Limits and settings are no measurements.
LIMIT = r"(?i)default|limit|at most|at least|more than|less than|smaller than|within|timeout|target"
ROOT = pathlib.Path(__file__).resolve().parent.parent
ABBREVIATIONS = r"(?:e\.g|i\.e|cf|et al|vs|Fig|Figs|Eq|Eqs|Sec|No|approx|resp|[A-Z])\."


def blocks(text):
    """Paragraphs and list items, without code, tables, formulas, titles, and comments."""
    text = re.sub(r"\A---\n.*?\n---\n", "", text, flags=re.S)
    text = re.sub(r"^( *)(```|~~~).*?^\1?\s*\2[^\n]*$", "\n", text, flags=re.S | re.M)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"\$\$.*?\$\$", " formula ", text, flags=re.S)
    kept = []
    for line in text.split("\n"):
        if re.match(r"\s*(#|\||<|!\[|\[!\[|!!!|\?\?\?|---+$|===+$|\[[^]]*\]:)", line) or not line.strip():
            kept.append("")
        elif re.match(r"\s*([-*+]|\d+\.) ", line):
            kept += ["", re.sub(r"^\s*([-*+]|\d+\.) ", "", line)]
        else:
            kept.append(line)
    return [" ".join(block.split()) for block in re.split(r"\n\s*\n", "\n".join(kept)) if block.strip()]


def sentences(text):
    for block in blocks(text):
        block = re.sub(r"!?\[([^]]*)\](\([^)]*\)|\[[^]]*\])?", r"\1", block)
        block = re.sub(r"`[^`]*`|\$[^$]*\$", "code", block)
        block = re.sub(r"[*_]{1,2}(\S[^*_]*?)[*_]{1,2}", r"\1", block)
        block = re.sub(ABBREVIATIONS, lambda found: found[0][:-1], block)
        for sentence in re.split(r"(?<=[.!?])\s+", block):
            if sentence.strip(" .:|"):
                yield sentence.strip()


def missing_files(page, text):
    """Paths in backticks that begin with a folder of the repository and lead nowhere."""
    text = re.sub(r"^( *)(```|~~~).*?^\1?\s*\2[^\n]*$", "\n", text, flags=re.S | re.M)
    for name in re.findall(r"`([\w.-]+(?:/[\w.*-]+)+)/?`", text):
        first = name.split("/")[0]
        folders = [page.parent] if first == ".." else [ROOT, ROOT / "libflbc" / "src", page.resolve().parent]
        below = [folder for folder in folders if (folder / first).is_dir()]
        is_made = name.startswith(("build/", "out/", "web/dist/"))
        if below and not is_made and not any(
                list(folder.glob(name)) or list(folder.glob(name + ".*")) for folder in below):
            yield name


def words(sentence):
    return len([word for word in sentence.split() if re.search(r"\w", word)])


def check(path, text):
    """What is wrong with a page, a line each."""
    text = re.sub(GENERATED, "", text, flags=re.S)
    found = list(sentences(text))
    counts = [words(sentence) for sentence in found]
    if len(text.encode()) > SIZE and path.name not in LONG:
        yield f"{len(text.encode())} bytes; at most {SIZE}"
    if counts and sum(counts) / len(counts) > MEAN:
        yield f"{sum(counts) / len(counts):.1f} words in a sentence on average; at most {MEAN}"
    for name in missing_files(path, text):
        yield f"no file {name}"
    for sentence in sentences(re.sub(NUMBER, "measured", text)):
        match = re.search(HASH, sentence) or (path.name not in LONG and re.search(MEASUREMENT, sentence))
        if match and not re.search(LIMIT, sentence):
            yield f"'{match[0]}' without a marker (docs/contributing/index.md, Numbers): {sentence}"
    for sentence, count in zip(found, counts):
        if count > LONGEST:
            yield f"{count} words; at most {LONGEST}: {sentence}"
        for habit, instead in HABITS.items():
            match = re.search(rf"\b(?:{habit})(?!\w)", sentence)
            if match:
                yield f"'{match[0]}' (better: {instead}): {sentence}"


def unreached(folder):
    """Pages of a folder to which no chain of "Next" links from its index.md leads."""
    page, reached = folder / "index.md", []
    while page.is_file() and page not in reached:
        reached.append(page)
        found = re.findall(r"^Next: \[[^]]*\]\(([^)#]*)", page.read_text(), flags=re.M)
        page = (page.parent / found[-1]).resolve() if found else folder
    for missed in sorted(set(folder.rglob("*.md")) - set(reached)):
        yield f"{missed}: the \"Next\" links from {folder.name}/index.md end at {reached[-1].name} without this page"


def main():
    pages = [pathlib.Path(page) for page in sys.argv[1:]]
    chains = [page.resolve() for page in pages if page.is_dir()] if pages else [ROOT / "docs"]
    pages = [page for page in pages if not page.is_dir()]
    if not pages and len(sys.argv) == 1:
        listed = subprocess.run(["git", "ls-files", "*.md"], cwd=ROOT, capture_output=True, text=True)
        pages = [ROOT / line for line in listed.stdout.split("\n") if line]
    wrong = 0
    for line in (line for folder in chains for line in unreached(folder)):
        print(line)
        wrong += 1
    for page in pages:
        for line in check(page, page.read_text()):
            print(f"{page}: {line}")
            wrong += 1
    print(f"{len(pages)} pages, {wrong} findings")
    return 1 if wrong or not (pages or chains) else 0


if __name__ == "__main__":
    sys.exit(main())
