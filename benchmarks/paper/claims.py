# SPDX-License-Identifier: BSD-3-Clause
"""Numbers in sentences of README.md and docs, each as the stored results give it.

A claim is a file, a sentence in which {} stands for a number, the result it comes from, and a function
that makes the numbers, as text, of the result's rows. Spaces of the sentence may be line ends.
"""

import math
import pathlib
import re

import results
from results import ratio, value

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORDS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
NUMBER = r"([0-9][0-9.,e+-]*[0-9]|[0-9]|" + "|".join(WORDS) + ")"


def find(rows, **wanted):
    """The first row with these cells. Raises LookupError if there is none."""
    found = [row for row in rows if all(row[column] == cell for column, cell in wanted.items())]
    if not found:
        raise LookupError(wanted)
    return found[0]


def where(*kinds, **wanted):
    """The claim that gives cells of the row with these cells; kinds as in results.cell."""
    return lambda rows: results.cells(find(rows, **wanted), *kinds)


def ends(form, number):
    """The claim that gives the least and the largest number of the rows that have one."""
    def make(rows):
        numbers = [x for x in map(number, rows) if not math.isnan(x)]
        return [format(end(numbers), form) for end in (min, max)]
    return make


def ends_of(column, form):
    return ends(form, lambda row: value(row, column))


def ratio_of(column, other, form):
    return lambda row: format(ratio(row, column, other), form)


def default_in_race(rows):
    return ends_of("total_seconds", ".2f")([row for row in rows if row["method"] == "value"])


def larger_than_published(rows):
    """On how many models method paper stops with a larger error than published, in words."""
    found = [row for row in rows if row["method"] == "paper" and row["paper_flbc_error"]]
    return [WORDS[sum(ratio(row, "error", "paper_flbc_error") > 1 for row in found)]]


def over_published(rows):
    """Errors of method paper relative to those published."""
    return [format(ratio(find(rows, model=model, method="paper"), "error", "paper_flbc_error"), ".2g")
            for model in ("logo", "woody", "cactus", "horse", "armadillo")]


def powers(rows, *columns):
    vertices = [value(row, "vertices") for row in rows]
    return [results.exponent(vertices, [value(row, column) for row in rows]) for column in columns]


def powers_of_many(rows):
    """From 110 to 1,000 control points at 20,000 vertices, by the two ends."""
    curve = [find(rows, cage="made", tolerance="1e-06", control_points=n) for n in ("110", "1000")]
    n = [value(row, "control_points") for row in curve]
    return [f"{results.exponent(n, [value(row, column) for row in curve]):.2f}"
            for column in ("seconds", "mebibytes")]


def powers_of_growth(rows):
    found = [powers(curve, "total_seconds", "peak_mebibytes") for curve in results.by(rows, "model")]
    return [f"{end(mine):.2f}" for mine in zip(*found) for end in (min, max)]


def over_value(method):
    """The claim that gives the least and the largest time of a method relative to that of value."""
    def make(rows):
        times = [value(row, "total_seconds") /
                 value(find(rows, model=row["model"], method="value"), "total_seconds")
                 for row in rows if row["method"] == method]
        return [f"{time:.1f}" if time < 9.95 else f"{time:.0f}" for time in (min(times), max(times))]
    return make


def published_penalty_over_value(rows):
    """Seconds to 1e-5 on woody with the 2014 solver's published penalty, relative to value's."""
    seconds = [results.reach([(results.after_setup(row), value(row, "error")) for row in rows
                              if row["model"] == "woody" and row["method"] == method], 1e-5)
               for method in ("lbc2014", "value")]
    return [f"{seconds[0] / seconds[1]:.0f}"]


def smallest_without(rows):
    return [f"{-value(find(rows, model=model), 'min_weight_without'):.1e}"
            for model in ("shark", "armadillo", "beast")]


def iterations_within_and_beyond_caches(rows):
    """Milliseconds that an iteration of value takes on a small and on a large horse."""
    return [f"{1000 * ratio(find(rows, model='horse', method='value', vertices=vertices), 'solve_seconds', 'iterations'):.2g}"
            for vertices in ("2021", "20288")]


def influences(rows):
    return ends_of("mean_influences", ".1f")(rows) + ends_of("harmonic_influences", ".1f")(rows)


def worst_promise(rows):
    return [f"{max(value(row, 'error') for row in rows):.2f}"]


INDEX, SPEED, MANY, ACCURACY, TABLES, FIGURES = (
    f"docs/benchmarks/{page}.md" for page in ("index", "speed", "many_control_points", "accuracy",
                                              "paper_tables", "paper_figures"))
RATIO = "takes {} to {} times as long as the default method"
CLAIMS = [
    ("README.md", "does not reproduce the published errors on {} models", "table2", larger_than_published),
    ("README.md", "takes {} times as long on woody as the default method", "figure5",
     published_penalty_over_value),
    (INDEX, "| seven models | {} to {} s |", "race", default_in_race),
    (INDEX, "| horse, n = {}, V = {} | {} s |", "models",
     where("control_points", "vertices:,.0f", "total_seconds:.1f", model="horse")),
    (INDEX, "| n = 250, V = {} | {} s |", "many",
     where("vertices:,.0f", "seconds:.1f", control_points="250", tolerance="1e-07")),
    (INDEX, "| n = 1,000, V = {} | {} s |", "many",
     where("vertices:,.0f", "seconds:.1f", control_points="1000", tolerance="1e-05")),
    (INDEX, "| horse, V = {}, n = {} | {} MiB |", "growth",
     where("vertices:,.0f", "control_points", "peak_mebibytes:,.0f", model="horse", cells="1015389")),
    (INDEX, "| default settings | {} to {}, instead of {} to {} |", "models", influences),
    (INDEX, "| nine models | {} |", "tolerance", worst_promise),
    (INDEX, f"The 2014 splitting with its tuned penalty {RATIO}", "race", over_value("lbc2014-tuned")),
    (INDEX, f"The gradient ADMM {RATIO}", "race", over_value("gradient")),
    (INDEX, f"The published 2019 method {RATIO}", "race", over_value("paper")),
    (INDEX, "With its published penalty, the 2014 splitting takes {} times as long on woody", "figure5",
     published_penalty_over_value),
    (INDEX, "certified relative gap of the references is {} to {}", "table2",
     ends_of("reference_gap", ".1e")),
    (SPEED, "takes {} to {} times as long as harmonic coordinates", "speed",
     ends(".1f", lambda row: ratio(row, "total_seconds", "harmonic_seconds"))),
    (SPEED, "Time grows as V^{} to V^{} and memory as V^{} to V^{}", "growth", powers_of_growth),
    (MANY, "the active set is {} times as fast as all pairs, which need {} times the memory", "many",
     where(ratio_of("all_seconds", "seconds", ".0f"), ratio_of("all_mebibytes", "mebibytes", ".0f"),
           cage="made", tolerance="1e-06", control_points="1000")),
    (MANY, "From 110 to 1,000 control points, time grows as n^{} and memory as n^{}", "many",
     powers_of_many),
    (ACCURACY, "so the worst ratio, {}, is a fitted figure", "tolerance", worst_promise),
    (TABLES, "It stops with {} times the published error on logo, {} times on woody, and {} times on cactus. "
     "On horse and armadillo it stops with {} and {} of it", "table2", over_published),
    (TABLES, "shark, armadillo, and beast are negative by {}, {}, and {}", "table1", smallest_without),
    (FIGURES, "| 2,021 | {} |\n| 20,288 | {} |", "figure3", iterations_within_and_beyond_caches),
    ("docs/explanation/method/differences_from_papers.md",
     "`paper` stops with {} times the published error on logo, {} times on woody and {} "
     "times on cactus", "table2", lambda rows: over_published(rows)[:3]),
]


def pattern_of(sentence):
    parts = [r"\s+".join(re.escape(word) for word in part.split(" ")) for part in sentence.split("{}")]
    return re.compile(NUMBER.join(parts))


def of_busy_machine(comments):
    return any(comment.startswith("busy machine") for comment in comments)


def check(stored, root=None, claims=None):
    """Sentences that are absent or whose numbers differ from the stored results, as messages."""
    problems = []
    for file, sentence, name, make in claims or CLAIMS:
        rows, comments = results.read(stored, name)
        path = (root or ROOT) / file
        found = path.exists() and pattern_of(sentence).search(path.read_text())
        if not found:
            problems.append(f"{file} does not say: {sentence}")
            continue
        wanted = numbers_of(make, rows, comments)
        if wanted is None:
            print(f"{file}, {name}: nothing measured yet, so not checked")
        elif list(found.groups()) != wanted:
            problems.append(f"{file} says {', '.join(found.groups())} in '{sentence}', "
                            f"but docs/results/{name}.csv gives {', '.join(wanted)}")
    return problems


def rewrite(stored, root=None, claims=None):
    """Puts the numbers of the stored results into the sentences."""
    for file, sentence, name, make in claims or CLAIMS:
        rows, comments = results.read(stored, name)
        wanted = numbers_of(make, rows, comments)
        path = (root or ROOT) / file
        text = path.read_text() if path.exists() else ""
        found = pattern_of(sentence).search(text)
        if not found or wanted is None:
            continue
        for group in range(len(wanted), 0, -1):
            begin, end = found.span(group)
            text = text[:begin] + wanted[group - 1] + text[end:]
        path.write_text(text)


def numbers_of(make, rows, comments):
    """None where the result, or a row of it, is not stored yet or no measurement."""
    try:
        return make(rows) if rows and not of_busy_machine(comments) else None
    except LookupError:
        return None
