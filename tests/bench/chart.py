#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what pair_times or pile_times wrote with --csv: how many times as fast as each of the other
colliders this library's batch is, a group of bars for each case."""
import argparse
import csv
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = ["#4269d0", "#efb118", "#3ca951", "#ff725c", "#a463f2"]


def cases_of(rows):
    """{case: {collider: ms}}, in the order of the file."""
    cases = {}
    for row in rows:
        if "pile" in row:
            case = f"{row['pile']}, {row['bodies']} bodies,\ndriven by {row['driver']}"
        else:
            triangles = (int(row["triangles_a"]) + int(row["triangles_b"])) // 2
            case = f"{row['shape']} of {triangles:,},\n{row['depth']}"
        cases.setdefault(case, {})[row["collider"]] = float(row["ms"])
    return cases


def draw(cases, path):
    colliders = [name for name in next(iter(cases.values())) if name != "batch"]
    height = 0.8 / len(colliders)
    figure, axes = plt.subplots(figsize=(8, 0.9 + 0.16 * len(cases) * (len(colliders) + 1)))
    for k, name in enumerate(colliders):
        places = [i + (k - (len(colliders) - 1) / 2) * height for i in range(len(cases))]
        faster = [case[name] / case["batch"] for case in cases.values()]
        axes.barh(places, [f - 1 for f in faster], height, left=1, label=name,
                  color=COLOURS[k % len(COLOURS)])
    axes.axvline(1, color="black", linewidth=1)
    axes.set_xscale("log")
    axes.set_yticks(range(len(cases)), list(cases), fontsize=7)
    axes.invert_yaxis()
    axes.set_xlabel("time over that of the batch; left of 1 the other is faster")
    axes.legend(fontsize=7)
    axes.grid(axis="x", which="both", linewidth=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("csv", help="from pair_times or pile_times --csv")
    parser.add_argument("png")
    arguments = parser.parse_args()
    try:
        with open(arguments.csv, newline="") as file:
            cases = cases_of(csv.DictReader(file))
    except (OSError, KeyError, ValueError) as error:
        sys.exit(f"chart.py: {arguments.csv}: {error}")
    if not cases:
        sys.exit(f"chart.py: {arguments.csv} has no figures")
    draw(cases, arguments.png)


if __name__ == "__main__":
    main()
