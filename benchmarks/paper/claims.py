# SPDX-License-Identifier: BSD-3-Clause
"""Numbers in sentences of README.md and docs, each as the stored results give it.

A claim is a file, a sentence in which {} stands for a number, the result it comes from, and a function
that makes the numbers, as text, of the result's rows. Spaces of the sentence may be line ends.
"""

import pathlib
import re

import results
import tables

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORDS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")
NUMBER = r"([0-9][0-9.,e+-]*[0-9]|[0-9]|" + "|".join(WORDS) + ")"


def find(rows, **cells):
    """The first row with these cells. Raises LookupError if there is none."""
    found = [row for row in rows if all(row[column] == cell for column, cell in cells.items())]
    if not found:
        raise LookupError(cells)
    return found[0]


def number(row, column, form):
    return format(results.value(row, column), form)


def ends(values, form):
    """The least and the largest of some numbers."""
    return [format(end(values), form) for end in (min, max)]


def ends_of(column, form):
    """The claim that gives the least and the largest number of a column."""
    return lambda rows: ends([results.value(row, column) for row in rows if row[column]], form)


def horse_by_default(rows):
    row = find(rows, model="horse")
    return [row["control_points"], results.thousands(row["vertices"]), number(row, "total_seconds", ".1f")]


def made_cage(control_points, tolerance):
    """The claim that gives the size and the seconds of a cage of that many control points."""
    def make(rows):
        row = find(rows, control_points=control_points, tolerance=tolerance)
        return [results.thousands(row["vertices"]), number(row, "seconds", ".1f")]
    return make


def active_set_at_1000(rows):
    """Speed and memory on all pairs relative to those on the active set."""
    row = find(rows, cage="made", tolerance="1e-06", control_points="1000")
    return [number(row, "times", ".0f"),
            f"{results.value(row, 'all_mebibytes') / results.value(row, 'mebibytes'):.0f}"]


def influences(rows):
    return (ends_of("mean_influences", ".1f")(rows) + ends_of("harmonic_influences", ".1f")(rows))


def default_in_race(rows):
    return ends([results.value(row, "total_seconds") for row in rows if row["method"] == "value"], ".2f")


def larger_than_published(rows):
    """On how many models method paper stops with a larger error than published, in words."""
    found = [row for row in rows if row["method"] == "paper" and row["paper_flbc_error"]]
    return [WORDS[sum(results.value(row, "error") > results.value(row, "paper_flbc_error") for row in found)]]


def powers_of_many(rows):
    """From 110 to 1,000 control points at 20,000 vertices, by the two ends."""
    curve = [find(rows, cage="made", tolerance="1e-06", control_points=n) for n in ("110", "1000")]
    n = [results.value(row, "control_points") for row in curve]
    return [f"{results.exponent(n, [results.value(row, column) for row in curve]):.2f}"
            for column in ("seconds", "mebibytes")]


def over_value(rows, method):
    """The least and the largest time of a method relative to that of value."""
    times = [results.value(row, "total_seconds") /
             results.value(find(rows, model=row["model"], method="value"), "total_seconds")
             for row in rows if row["method"] == method]
    return [f"{time:.1f}" if time < 9.95 else f"{time:.0f}" for time in (min(times), max(times))]


def powers_of_growth(rows):
    powers = []
    for column in ("total_seconds", "peak_mebibytes"):
        both = []
        for model in results.in_order(row["model"] for row in rows):
            curve = [row for row in rows if row["model"] == model]
            both.append(results.exponent([results.value(row, "vertices") for row in curve],
                                         [results.value(row, column) for row in curve]))
        powers += [f"{min(both):.2f}", f"{max(both):.2f}"]
    return powers


def iterations_within_and_beyond_caches(rows):
    """Milliseconds that an iteration of value takes on a small and on a large horse."""
    return [f"{1000 * results.value(row, 'solve_seconds') / results.value(row, 'iterations'):.2g}"
            for row in (find(rows, model="horse", method="value", vertices=vertices)
                        for vertices in ("2021", "20288"))]


def million_cells(rows):
    row = find(rows, model="horse", cells="1015389")
    return [results.thousands(row["vertices"]), row["control_points"],
            number(row, "peak_mebibytes", ",.0f")]


def smallest_without(rows):
    return [f"{-results.value(find(rows, model=model), 'min_weight_without'):.1e}"
            for model in ("shark", "armadillo", "beast")]


def over_published(rows):
    """Errors of method paper relative to those published."""
    found = [find(rows, model=model, method="paper")
             for model in ("logo", "woody", "cactus", "horse", "armadillo")]
    return [f"{results.value(row, 'error') / results.value(row, 'paper_flbc_error'):.2g}" for row in found]


def published_penalty_over_value(rows):
    """Seconds to 1e-5 on woody with the 2014 solver's published penalty, relative to value's."""
    seconds = []
    for method in ("lbc2014", "value"):
        curve = [dict(row, time=str(tables.after_setup(row))) for row in rows
                 if row["model"] == "woody" and row["method"] == method]
        seconds.append(tables.reach(curve, 1e-5, "time"))
    return [f"{seconds[0] / seconds[1]:.0f}"]


def worst_promise(rows):
    return [f"{max(results.value(row, 'error') for row in rows):.2f}"]


INDEX, SPEED, MANY, ACCURACY, TABLES, FIGURES = (
    f"docs/benchmarks/{page}.md" for page in ("index", "speed", "many_control_points", "accuracy",
                                              "paper_tables", "paper_figures"))
RATIO = "takes {} to {} times as long as the default method"
CLAIMS = [
    ("README.md", "does not reproduce the published errors on {} models", "table2", larger_than_published),
    ("README.md", "takes {} times as long on woody as the default method", "figure5",
     published_penalty_over_value),
    (INDEX, "| seven models | {} to {} s |", "race", default_in_race),
    (INDEX, "| horse, n = {}, V = {} | {} s |", "models", horse_by_default),
    (INDEX, "| n = 250, V = {} | {} s |", "many", made_cage("250", "1e-07")),
    (INDEX, "| n = 1,000, V = {} | {} s |", "many", made_cage("1000", "1e-05")),
    (INDEX, "| horse, V = {}, n = {} | {} MiB |", "growth", million_cells),
    (INDEX, "| default settings | {} to {}, instead of {} to {} |", "models", influences),
    (INDEX, "| nine models | {} |", "tolerance", worst_promise),
    (INDEX, f"The 2014 splitting with its tuned penalty {RATIO}", "race",
     lambda rows: over_value(rows, "lbc2014-tuned")),
    (INDEX, f"The gradient ADMM {RATIO}", "race", lambda rows: over_value(rows, "gradient")),
    (INDEX, f"The published 2019 method {RATIO}", "race", lambda rows: over_value(rows, "paper")),
    (INDEX, "With its published penalty, the 2014 splitting takes {} times as long on woody", "figure5",
     published_penalty_over_value),
    (INDEX, "certified relative gap of the references is {} to {}", "table2",
     ends_of("reference_gap", ".1e")),
    (SPEED, "takes {} to {} times as long as harmonic coordinates", "speed", ends_of("over_harmonic", ".1f")),
    (SPEED, "Time grows as V^{} to V^{} and memory as V^{} to V^{}", "growth", powers_of_growth),
    (MANY, "the active set is {} times as fast as all pairs, which need {} times the memory", "many",
     active_set_at_1000),
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
