#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of GRAPP section 5 and writes docs/reproduction.md, from raw results alone."""

import argparse
import os
import sys

import numpy

import document
from results import Missing, load

try:
    import matplotlib
except ImportError:
    sys.exit("figures.py: matplotlib is missing; install the Debian package python3-matplotlib")
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402 (after the choice of the backend)

# file, scene, title, without the pipeline, with it, the paper's speed-up
FIGURES = (
    ("figure6a", "rigid", "full ray tracing only (GRAPP figure 6)", "full-monolithic", "full",
     document.PAPER_FULL),
    ("figure6b", "rigid", "full and iterative ray tracing (GRAPP figure 6)",
     "iterative-monolithic", "iterative", document.PAPER_ITERATIVE),
    ("figure7", "rigid-deformable", "full, iterative and basic ray tracing (GRAPP figure 7)",
     "iterative-basic-monolithic", "iterative-basic", document.PAPER_DEFORMABLE),
)
SMOOTHED_OVER = 5  # steps; their median is drawn, and every step faintly behind it


def smoothed(values):
    half = SMOOTHED_OVER // 2
    padded = numpy.pad(values, half, mode="edge")
    return numpy.median(numpy.lib.stride_tricks.sliding_window_view(padded, SMOOTHED_OVER), axis=1)


def draw(results, title, slow, fast, papers, path):
    ratios, _ = results.speed_up(slow, fast)
    figure, axes = pyplot.subplots(figsize=(8, 4.6))
    for name, label, colour in ((slow, "without the pipeline", "tab:red"),
                                (fast, "with the pipeline", "tab:blue")):
        seconds, ms = results.seconds(name), results.kernel_ms(name)
        label = f"{label} ({name})"
        if len(ms) < results.summary["steps"]:  # measured in some steps only
            axes.plot(seconds, ms, "o-", color=colour, linewidth=0.7, markersize=3, label=label)
            continue
        axes.plot(seconds, ms, color=colour, alpha=0.25, linewidth=0.7)
        axes.plot(seconds, smoothed(ms), color=colour, linewidth=1.4, label=label)
    axes.set_title(f"Scene '{results.scene}', {document.size_of(results.summary)}:\n{title}",
                   fontsize=10)
    axes.set_xlabel("simulated time [s]")
    axes.set_ylabel("kernel times of a step, summed [ms]")
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    axes.legend(fontsize=8, title_fontsize=8, title=f"speed-up: {numpy.median(ratios):.2f} here "
                f"(median of steps), {papers:.2f} in the paper")
    figure.text(0.01, 0.01, f"{results.machine['device']}\n{results.machine['command']}",
                fontsize=6, va="bottom")
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    figure.savefig(path, dpi=100, metadata={"Software": None})
    pyplot.close(figure)


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__,
        epilog="Exit codes: 0 everything was made, 1 something was not (a sentence says why), "
               "2 wrong usage.")
    parser.add_argument("--results", default="docs/results/paper", metavar="DIR",
                        help="a folder for each scene; the figures go there (default: %(default)s)")
    parser.add_argument("--gpu", metavar="DIR", help="results of a GPU, laid out in the same way")
    parser.add_argument("--doc", default="docs/reproduction.md", metavar="FILE",
                        help="the page to write (default: %(default)s)")
    parser.add_argument("--only", choices=document.PARTS, action="append",
                        help="a part of all this; repeatable")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    parts = arguments.only or list(document.PARTS)
    problems = []

    def report(problem):
        if problem not in problems:
            problems.append(problem)
            print(f"figures.py: {problem}", file=sys.stderr)

    def load_all(folder):
        found = {}
        for scene in document.scenes_of(parts):
            try:
                found[scene] = load(folder, scene)
            except Missing as missing:
                report(str(missing))
        return found

    scenes = load_all(arguments.results)
    gpu = load_all(arguments.gpu) if arguments.gpu else {}
    drawn = {}
    for name, scene, title, slow, fast, papers in FIGURES:
        if not any(name.startswith(part) for part in parts) or scene not in scenes:
            continue
        path = os.path.join(arguments.results, name + ".png")
        try:
            draw(scenes[scene], title, slow, fast, papers, path)
            drawn[name] = os.path.relpath(path, os.path.dirname(arguments.doc) or ".")
            print(path)
        except Missing as missing:
            report(f"{name} is not drawn: {missing}")
    text = document.write(parts, scenes, gpu, drawn, report)
    os.makedirs(os.path.dirname(arguments.doc) or ".", exist_ok=True)
    with open(arguments.doc, "w") as file:
        file.write(text)
    print(arguments.doc)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
