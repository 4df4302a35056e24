# SPDX-License-Identifier: BSD-3-Clause
"""The page docs/reproduction.md: the paper's numbers, typed in here, beside those of the results."""

import numpy

import deviations
from page import Page, nanoseconds, percent
from results import BUFFERS, PRODUCT_BUFFERS, RAY_BUFFERS, Missing

PARTS = ("figure6", "figure7", "table1", "table2")

# GRAPP section 5: figures 6 and 7, tables 1 and 2.
PAPER_FULL, PAPER_ITERATIVE, PAPER_DEFORMABLE = 1.31, 2.73, 1.84
PAPER_GAINS_MS = (2.84, 1.97, 2.05)
PAPER_REDUCTIONS = (0.79, 0.28)


def scenes_of(parts):
    scenes = []
    if parts != ["figure7"]:
        scenes.append("rigid")
    if parts != ["figure6"]:
        scenes.append("rigid-deformable")
    return scenes


def measured_speed_up(slow, fast):
    def measure(results):
        ratios, of_sums = results.speed_up(slow, fast)
        low, median, high = numpy.quantile(ratios, (0.1, 0.5, 0.9))
        return f"**{median:.2f}** ({low:.2f} … {high:.2f}); {of_sums:.2f}"
    return measure


def lockstep_speed_up(slow, fast, lanes):
    return lambda results: \
        f"{results.lockstep_speed_up(slow + '-count', fast + '-count', lanes):.2f}"


def write_speed_ups(page, parts, drawn):
    rows = []
    for part, what, scene, papers, slow, fast in (
            ("figure6", "Figure 6, full rays", "rigid", PAPER_FULL, "full-monolithic", "full"),
            ("figure6", "Figure 6, full and iterative rays", "rigid", PAPER_ITERATIVE,
             "iterative-monolithic", "iterative"),
            ("figure7", "Figure 7, full, iterative and basic rays", "rigid-deformable",
             PAPER_DEFORMABLE, "iterative-basic-monolithic", "iterative-basic"),
            ("figure7", "the same with refitted BVHs in place of basic rays", "rigid-deformable",
             None, "iterative-monolithic", "iterative")):
        if part in parts:
            measure = measured_speed_up(slow, fast)
            rows.append([what, f"{papers:.2f}" if papers else "not in the paper"] +
                        [page.cell(scene, lockstep_speed_up(slow, fast, n)) for n in (32, 64)] +
                        [page.cell(scene, measure), page.on_gpu(scene, measure)])
    if not rows:
        return
    page.add("## Speed-up by the pipeline (figures 6 and 7)")
    page.add("Without the pipeline over with it. *Predicted from divergence*: for how long groups "
             "of 32 and of 64 lanes in lockstep are busy, over all kernels that count, summed over "
             "the counted steps. *Measured*: the sum of kernel times (device events) of a step, "
             "its ratio, the median of all steps and the 10th and 90th percentile; then the ratio of "
             "what all steps take together.")
    page.table(["", "paper", "predicted, 32 lanes", "predicted, 64 lanes",
                "measured on this device", "measured on a GPU"], rows)
    for path in drawn.values():
        page.add(f"![{path}]({path})")
    write_lanes(page, parts)


def write_lanes(page, parts):
    rows = []
    names = {"figure6": ("rigid", ("full", "full-monolithic", "iterative", "iterative-monolithic")),
             "figure7": ("rigid-deformable", ("iterative-basic", "iterative-basic-monolithic",
                                              "iterative", "iterative-monolithic"))}
    for part, (scene, configurations) in names.items():
        if part not in parts or scene not in page.scenes:
            continue
        for name in configurations:
            try:
                work = page.scenes[scene].work(name + "-count")
                steps = len(page.scenes[scene].counted_steps(name + "-count"))
            except Missing as missing:
                page.report(str(missing))
                continue
            for kernel, sums in work.items():
                rows.append([f"{scene}: {name}", kernel.replace("_", " ")] +
                            [f"{sums[column] // steps:,}" for column in ("items", "units")] +
                            [percent(sums["units"] / sums[f"lockstep{n}"], 1) if sums["units"]
                             else "idle" for n in (32, 64)])
    if rows:
        page.add("Work of the kernels behind the predicted speed-ups, per counted step, and the "
                 "share of lanes at work while their group is busy:")
        page.table(["configuration", "kernel", "work-items", "units of work",
                    "lanes at work, of 32", "of 64"], rows)


def write_table1(page):
    def gain(exact, predicted):
        def measure(results):
            each = results.both(exact, predicted, lambda name: results.column(name, "device_ms"))
            low, median, high = numpy.quantile(each[0] - each[1], (0.1, 0.5, 0.9))
            return f"{median:.3f} ms ({low:.3f} … {high:.3f})"
        return measure

    def waits(exact, predicted):
        def measure(results):
            each = [int(numpy.median(results.column(name, "synchronizations")))
                    for name in (exact, predicted)]
            return f"{each[0]} → {each[1]}"
        return measure

    rows = []
    for what, scene, papers, name in (
            ("rigid, full rays", "rigid", PAPER_GAINS_MS[0], "full"),
            ("rigid, full and iterative rays", "rigid", PAPER_GAINS_MS[1], "iterative"),
            ("rigid and deformable, full, iterative and basic rays", "rigid-deformable",
             PAPER_GAINS_MS[2], "iterative-basic"),
            ("the same with refitted BVHs", "rigid-deformable", None, "iterative")):
        measure = gain(name + "-exact", name)
        rows.append([what, f"{papers:.2f} ms" if papers else "not in the paper",
                     page.cell(scene, measure), page.on_gpu(scene, measure),
                     page.cell(scene, waits(name + "-exact", name))])
    page.add("## Gain by predicted workloads (table 1)")
    page.add("Exact minus predicted, same poses, first upload to last read-back by the host's "
             "clock; the median of all steps and the 10th and 90th percentile. Beside it how often "
             "the host waits for the device in a step, exact → predicted (medians).")
    page.table(["", "paper", "this device", "on a GPU", "synchronisations a step"], rows)


def write_table2(page):
    def share(counts, results):
        lost, total = counts
        if total == 0:
            raise Missing(f"nothing was predicted in the scene '{results.scene}'")
        return lost / total

    def ignored(name, buffers):
        return lambda results: [share(results.missed(name + words, buffers), results)
                                for words in ("-ignore", "-plain-ignore")]

    def foreseen(name, buffers):
        return lambda results: [share(results.foreseen(name, buffers, scaled), results)
                                for scaled in (True, False)]

    rows = []
    for what, scene, papers, name in (
            ("rigid, full and iterative rays", "rigid", PAPER_REDUCTIONS[0], "iterative"),
            ("rigid and deformable, full and iterative rays", "rigid-deformable",
             PAPER_REDUCTIONS[1], "iterative"),
            ("rigid, full rays", "rigid", None, "full")):
        for of, shares in (("rays", ignored(name, RAY_BUFFERS)),
                           ("all entries", ignored(name, BUFFERS)),
                           ("rays, from true counts", foreseen(name, RAY_BUFFERS))):
            def reduction(results, shares=shares):
                scaled, plain = shares(results)
                return "nothing was lost" if plain == 0 else percent(1 - scaled / plain, 0)
            rows.append([what, of,
                         percent(papers, 0) if papers and of != "all entries"
                         else "not in the paper",
                         page.cell(scene, reduction)] +
                        [page.cell(scene, lambda results, k=k: percent(shares(results)[k], 3))
                         for k in (0, 1)])
    for scene in ("rigid", "rigid-deformable"):
        for buffer in PRODUCT_BUFFERS:
            def lost(results, scaled, buffer=buffer):
                return share(results.foreseen("full-edges", (buffer,), scaled), results)
            rows.append([f"{scene}, the library by default", buffer.replace("_", " ") +
                         ", from true counts", "not in the paper",
                         page.cell(scene, lambda results, lost=lost: "nothing was lost"
                                   if lost(results, False) == 0
                                   else percent(1 - lost(results, True) / lost(results, False), 0))]
                        + [page.cell(scene, lambda results, lost=lost, scaled=scaled:
                                     percent(lost(results, scaled), 3))
                           for scaled in (True, False)])
    page.add("## Errors of predictions (table 2)")
    page.add("Misprediction *ignore*, confidence 1.02: what exceeds the prediction of a buffer is "
             "lost. Share of entries lost over the whole run, and by how much Eq. 1 (scaled by the "
             "pairs) has less of it than Eq. 2. *Rays*: the append buffers of rays. *All entries*: "
             "those of chunks, hits and contacts too; a chunk that is lost has no rays that could "
             "be counted. *From true counts*: what either equation would have lost had the step "
             "before lost nothing, worked out from the counts of the run that loses nothing.")
    page.table(["", "lost of", "reduction, paper", "reduction, here", "lost, Eq. 1", "lost, Eq. 2"],
               rows)


def write_iterative(page):
    rows = []
    for scene, results in page.scenes.items():
        for name in ("full", "iterative", "iterative-checked", "iterative-basic"):
            if name not in results.summary["configurations"]:
                continue
            settled = results.summary["configurations"][name]["settled"]
            rows.append([f"{scene}: {name}", percent(settled["iterative_share"], 1),
                         percent(settled["unproven_share"], 1),
                         nanoseconds(settled["ns_per_iterative_ray"]),
                         nanoseconds(settled["ns_per_bvh_ray"])])
    page.add("## Iterative rays")
    page.add("Over the settled part, the last third of the steps: how many of the rays are "
             "iterative, how many of those were cast by the BVH after all, as far as the walk got, and "
             "kernel time over rays.")
    page.table(["configuration", "iterative", "of those cast in full", "ns per iterative ray",
                "ns per BVH ray"], rows)
    write_papers_rule(page)


def write_papers_rule(page):
    rows = []
    for scene, results in page.scenes.items():
        for name, entry in results.summary["configurations"].items():
            if "missed" not in entry or name != "iterative":
                continue
            missed = entry["missed"]
            rows.append([f"{scene}: {name}",
                         f"{missed['missed_pairs']:,} of {missed['pairs']:,}",
                         percent(missed["missed_pair_share"], 3),
                         f"{missed['missed_contacts']:,} of {missed['contacts']:,}",
                         percent(missed["missed_contact_share"], 3),
                         f"{missed['false_pairs']:,}"])
    page.add("The paper's rule (`iterative`: no temporal data, no ray; what the walk finds is "
             "believed) against full rays at the same poses, over all steps. A contact is "
             "missed where a pair has fewer of them.")
    page.table(["configuration", "pairs missed", "share", "contacts missed", "share",
                "pairs invented"], rows)


def write_refit(page):
    scene = "rigid-deformable"
    rows = []
    for what, slow, fast in (("pipelined", "iterative-basic", "iterative"),
                             ("monolithic", "iterative-basic-monolithic", "iterative-monolithic")):
        measure = measured_speed_up(slow, fast)
        rows.append([what, page.cell(scene, measure)])
    page.add("## A refitted BVH against basic rays")
    page.add("Kernel times with basic rays over those with a BVH that is refitted on the device in "
             "every step, deformation included, as above.")
    page.table(["", "basic over refit"], rows)


def write_verdicts(page):
    rows = []
    for scene, results in page.scenes.items():
        for verdict in results.summary["verdicts"]:
            result = "identical" if verdict["identical"] else f"{verdict['differing']} DIFFER"
            rows.append([scene, verdict["claim"], f"{verdict['steps']:,}", result])
    page.add("## Identical contacts")
    page.add("Every bit of every contact of every step, by hash; one comparison is of two "
             "configurations in one step.")
    page.table(["scene", "claim", "comparisons", "result"], rows)


def size_of(summary):
    sheets = summary.get("sheets", 0)
    return f"{summary['objects']:,} objects" + (f" and {sheets} sheets" if sheets else "")


def write_machine(page):
    page.add("## Machine and commands")
    for scene, results in list(page.scenes.items()) + list(page.gpu.items()):
        m, s = results.machine, results.summary
        page.add(f"    {m['command']}")
        page.add(f"Scene '{scene}': {size_of(s)}, {s['steps']} steps at {s['hz']:g} Hz, "
                 f"seed {s['seed']}, driven by `{s['driver']}`, what is slow "
                 f"measured in every {s['every']}th step. Device {m['device']} ({m['device_type']}), {m['platform']} "
                 f"{m['driver']}, {m['opencl']}; {m['cpu']}, {m['cores']} cores; {m['compiler']}, "
                 f"{m['build_type']}, commit {m['commit']}, {m['date']}.")
        if results.note:
            page.add(results.note)


def write(parts, scenes, gpu, drawn, report):
    page = Page(scenes, gpu, report)
    page.add("# Reproduction of the paper")
    page.add("The figures and tables of section 5 of Lehericey, Gouranton and Arnaldi, *GPU "
             "Ray-Traced Collision Detection: Fine Pipeline Reorganization*, GRAPP 2015. Written "
             "by demos/paper/figures.py from raw results alone; the paper's numbers are all that was "
             "typed in. `scripts/reproduce` makes everything again.")
    write_speed_ups(page, parts, drawn)
    if "table1" in parts:
        write_table1(page)
    if "table2" in parts:
        write_table2(page)
    if set(PARTS) <= set(parts):
        write_iterative(page)
        write_refit(page)
    write_verdicts(page)
    write_machine(page)
    page.add("## Deviations from the paper")
    page.add("\n".join(f"- {text}" for text in deviations.TEXT))
    return "\n".join(page.lines).rstrip() + "\n"
