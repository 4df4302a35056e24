#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of docs/performance.md and README.md, made of what scripts/measure wrote. In a document
a table stands between <!-- tables.py NAME: begin --> and <!-- tables.py NAME: end -->."""
import argparse
import pathlib
import re
import statistics
import sys


class Missing(Exception):
    """A file has not what a table is made of."""


def digits(value):
    """Three of them, all that are before the point, and none that says nothing."""
    if abs(value) >= 100 or value == int(value):
        return f"{value:,.0f}"
    return f"{float(f'{value:.3g}'):f}".rstrip("0").rstrip(".")


def spread(values):
    """From the least to the largest."""
    least, most = digits(min(values)), digits(max(values))
    return least if least == most else f"{least} to {most}"


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def texts(results, name):
    """Of each run of a program."""
    files = sorted(results.glob(f"{name}-*.txt"))
    if not files:
        raise Missing(f"{results} has no {name}-1.txt")
    return [path.read_text(errors="replace") for path in files]


def numbers(pattern, text):
    found = re.search(pattern, text)
    if not found:
        raise Missing(f"nothing like '{pattern}'")
    return [float(value.replace(",", "")) for value in found.groups()]


def bowl(results):
    runs = texts(results, "bowl")
    rows = []
    for title, part in [("", "all steps"), ("the last ", "last third")]:
        figures = [numbers(part + r" +([\d.]+)x.*\((\d+) steps; batch ([\d.]+) ms, ODE ([\d.]+) ms",
                           text) for text in runs]
        ratios, steps, batch, ode = zip(*figures)
        rows.append([f"{title}{digits(steps[0])} steps, ms a step",
                     digits(statistics.median(batch)), digits(statistics.median(ode)),
                     spread(ratios)])
    batch, ode = numbers(r"contacts per step +batch (\d+) .*ODE (\d+) median", runs[0])
    rows.append(["contacts a step", digits(batch), digits(ode), ""])
    return table(["", "batch", "ODE", "ODE / batch, by run"], rows)


def stages(results):
    """Of a pass of the bowl, kernel by kernel."""
    text = texts(results, "exact")[0]
    stage = {name: float(ms) for name, ms in re.findall(r"  (\w+) +([\d.]+) +[\d.]+\n", text)}
    kernels = ["pair_step", "cull", "match", "cross", "flood", "bvh_rays", "assembly",
               "contact_step"]
    whole = sum(stage[name] for name in kernels)
    return table(["", *kernels, "together"],
                 [["ms, median"] + [digits(stage[name]) for name in kernels] + [digits(whole)],
                  ["%"] + [digits(100 * stage[name] / whole) for name in kernels] + [""]])


PILE = re.compile(r"(.+), (\d+) bodies, driven by (.+); .*: (\d+) pairs, (\d+) collide")


def piles_of(text):
    """{(pile, driver): {collider: [ms, ratio to the batch]}}, with the counts of pairs."""
    piles = {}
    for line in text.splitlines():
        head = PILE.match(line)
        if head:
            piles[head[1], head[3]] = rows = {"counts": [float(head[4]), float(head[5])]}
        row = re.match(r"  (batch|ODE|FCL all|FCL any|GImpact) +([\d.]+) +([\d.]+) ", line)
        if row:
            rows[row[1]] = [float(row[2]), float(row[3])]
    return piles


def all_piles(results):
    """The piles of each run, by what drives them."""
    runs = {}
    for name in ["piles-batch", "piles-ode", "shapes-ode"]:
        for text in texts(results, name):
            for pile, rows in piles_of(text).items():
                runs.setdefault(pile, []).append(rows)
    return runs


def piles(results):
    rows = []
    for (pile, driver), runs in all_piles(results).items():
        of = lambda name, k: [run[name][k] for run in runs]  # noqa: E731
        pairs, colliding = runs[0]["counts"]
        rows.append([pile, driver, f"{digits(pairs)}, {digits(colliding)}",
                     digits(statistics.median(of("batch", 0))), spread(of("ODE", 1))]
                    + [digits(statistics.median(of(name, 1)))
                       for name in ["FCL all", "FCL any", "GImpact"]])
    return table(["", "driven by", "pairs, colliding", "batch, ms a pass", "ODE, by run",
                  "FCL, all contacts", "FCL, yes or no", "GImpact"], rows)


PAIR = re.compile(r"(\w[\w: ]* \d+)(?:, (\w+))? +(\d+)/ *(\d+) +(.*)")


def pairs_of(text):
    """[(shape, depth, colliding, all, figures)], figures as pair_times lists them."""
    found = [PAIR.match(line) for line in text.splitlines()]
    return [(m[1], m[2], m[3], m[4], [float(value) for value in m[5].split()])
            for m in found if m]


CROSSINGS, RAYS, BATCH, ALONE, ODE = range(5)
OVER_BATCH, OVER_ALONE = -2, -1


def shaped(shape):
    kind, triangles = shape.rsplit(" ", 1)
    return f"{kind}, {int(triangles):,} triangles"


def pair_rows(results):
    """Of each case what all runs say of it."""
    for name in ["tori", "rocks", "hills", "ground"]:
        runs = [pairs_of(text) for text in texts(results, name)]
        if len({len(run) for run in runs}) != 1:
            raise Missing(f"{results}: runs of {name} have not the same rows")
        yield from zip(*runs)


def pairs(results):
    rows = []
    for of_row in pair_rows(results):
        shape, depth, colliding, count, first = of_row[0]
        of = lambda k: [row[4][k] for row in of_row]  # noqa: E731
        title = depth if depth != "apart" else f"{shaped(shape)}, {depth}"
        rows.append([title, f"{colliding} of {count}",
                     f"{first[CROSSINGS]:,.0f}, {first[RAYS]:,.0f}"]
                    + [digits(statistics.median(of(k))) for k in (BATCH, ALONE, ODE)]
                    + [spread(of(OVER_BATCH)), spread(of(OVER_ALONE))])
    return table(["", "colliding", "crossings, rays of vertices a pair", "batch", "alone", "ODE",
                  "ODE / batch", "ODE / alone"], rows)


def hard(results):
    rows = []
    for shape, _, _, _, figures in pairs_of(texts(results, "worst")[0]):
        rows.append([shaped(shape.removeprefix("worst: ")),
                     f"{figures[CROSSINGS]:,.0f}, {figures[RAYS]:,.0f}", digits(figures[BATCH]),
                     digits(figures[ODE]), digits(figures[OVER_BATCH])])
    return table(["", "crossings, rays of vertices", "batch", "ODE", "ODE / batch"], rows)


def objects(results):
    rows = []
    for text in texts(results, "objects"):
        count, = numbers(r"scene rigid: (\d+) objects", text)
        of = lambda name: numbers(rf"  {name} +([\d.]+) ", text)[0]  # noqa: E731
        rows.append([count, of("pairs"), of("pass"), 1000 * of("pass") / of("pairs"),
                     of("whole_step"), of("gather"), of("meshes")])
    return table(["objects", "pairs a step", "ms a pass", "µs a pair", "of the pass, whole step",
                  "gathering", "meshes"], [[digits(x) for x in row] for row in sorted(rows)])


def meshes(results):
    rows = []
    for line in texts(results, "meshes")[0].splitlines():
        found = re.match(r"(rock|hills|needles) +(\d+) +(.*)", line)
        if found:
            rows.append([f"{found[1]}, {int(found[2]):,}"]
                        + [digits(float(value)) for value in found[3].split()])
    return table(["", "ms", "ns a triangle", "bytes a triangle", "a cube beside it, ms",
                  "ODE's own build, ms"], rows)


def summary(results):
    """README's: ratios alone."""
    every = all_piles(results)
    drivers = {driver: {pile: spread([run["ODE"][1] for run in runs])
                        for (pile, by), runs in every.items() if by == driver}
               for driver in ["the batch", "ODE"]}
    rows = [[f"pile of 60 {pile}" if pile.startswith("rocks") else f"300 bodies of {pile}",
             drivers["the batch"].get(pile, ""), ratio] for pile, ratio in drivers["ODE"].items()]
    return table(["ODE's time over the batch's, medians, by run", "the batch drives",
                  "ODE drives, piles are deep"], rows)


def pair_summary(results):
    """README's: ratios of batches alone."""
    shapes = {}
    for of_row in pair_rows(results):
        shape, depth = of_row[0][:2]
        shapes.setdefault(shape, {})[depth] = spread([row[4][OVER_BATCH] for row in of_row])
    depths = ["apart", "near", "shallow", "deep"]
    return table(["ODE's time over the batch's", "apart", "near first contact", "1 % deep",
                  "20 % deep"],
                 [[shaped(shape)] + [of[depth] for depth in depths] for shape, of in shapes.items()])


TABLES = {f.__name__: f for f in [bowl, stages, piles, pairs, objects, hard, meshes, summary,
                                  pair_summary]}


def with_tables(document, results):
    def replaced(found):
        return f"{found[1]}\n\n{TABLES[found[2]](results)}\n\n{found[4]}"

    names = "|".join(TABLES)
    mark = rf"(<!-- tables\.py ({names}): begin -->)(.*?)(<!-- tables\.py \2: end -->)"
    text, count = re.subn(mark, replaced, document, flags=re.DOTALL)
    if count == 0:
        raise Missing("there is no mark of a table in it")
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=pathlib.Path, help="what scripts/measure wrote")
    parser.add_argument("documents", nargs="*", type=pathlib.Path,
                        help="whose tables are written anew; without any they are printed")
    parser.add_argument("--check", action="store_true", help="write nothing, fail where they differ")
    arguments = parser.parse_args()
    try:
        if not arguments.documents:
            for name, make in TABLES.items():
                print(f"{name}\n\n{make(arguments.results)}\n")
        for path in arguments.documents:
            is_there = path.read_text()
            text = with_tables(is_there, arguments.results)
            if arguments.check and text != is_there:
                sys.exit(f"tables.py: {path} has other figures than {arguments.results}")
            if not arguments.check:
                path.write_text(text)
    except (Missing, OSError) as error:
        sys.exit(f"tables.py: {error}")


if __name__ == "__main__":
    main()
