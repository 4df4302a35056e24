# SPDX-License-Identifier: BSD-3-Clause
"""The raw results of a run of `paper`, and what follows from them."""

import csv
import gzip
import json
import os

import numpy

# From the clocks of the device's own events; the other stages are of the host.
KERNEL_STAGES = ("deform_step", "pair_step", "vertex_step", "iterative_rays", "bvh_rays",
                 "basic_rays", "monolithic", "contact_step")
RAY_BUFFERS = ("rays_iterative", "rays_bvh", "rays_basic")
PRODUCT_BUFFERS = ("meshlets", "meshlet_pairs", "crossings", "flood_words", "rays_bvh", "hits",
                   "contacts")
BUFFERS = ("chunks_small", "chunks_high", "chunks_deformable") + RAY_BUFFERS + ("hits", "contacts")
PAPER_CONFIDENCE = 1.02  # GRAPP section 5.4


class Missing(Exception):
    """A sentence that says which results are not there."""


def _open(path):
    if os.path.exists(path):
        return open(path, newline="")
    if os.path.exists(path + ".gz"):
        return gzip.open(path + ".gz", "rt", newline="")
    raise Missing(f"there is no {path}")


def _rows(path):
    with _open(path) as file:
        return list(csv.DictReader(file))


def _json(path):
    with _open(path) as file:
        return json.load(file)


class Results:
    """One scene: a folder with steps.csv, work.csv, machine.json and summary.json, and perhaps a
    note.txt: what whoever ran it has to say of the run."""

    def __init__(self, folder):
        self.scene = os.path.basename(os.path.normpath(folder))
        self._steps = {}
        for row in _rows(os.path.join(folder, "steps.csv")):
            self._steps.setdefault(row["configuration"], []).append(row)
        self._work = {}
        for row in _rows(os.path.join(folder, "work.csv")):
            self._work.setdefault(row["configuration"], []).append(row)
        self.machine = _json(os.path.join(folder, "machine.json"))
        self.summary = _json(os.path.join(folder, "summary.json"))
        self.note = ""
        note = os.path.join(folder, "note.txt")
        if os.path.exists(note):
            with open(note) as file:
                self.note = " ".join(file.read().split())

    def require(self, *configurations):
        for name in configurations:
            if name not in self._steps:
                raise Missing(
                    f"the results of the scene '{self.scene}' hold no configuration '{name}'")

    def column(self, configuration, name):
        self.require(configuration)
        return numpy.array([float(row[name]) for row in self._steps[configuration]])

    def seconds(self, configuration):
        return self.column(configuration, "step") / self.summary["hz"]

    def kernel_ms(self, configuration):
        """The sum of kernel times of each step."""
        return sum(self.column(configuration, stage + "_ms") for stage in KERNEL_STAGES)

    def both(self, first, second, measure):
        """What `measure` says of either configuration, in the steps in which both were measured."""
        steps = [self.column(name, "step") for name in (first, second)]
        _, *places = numpy.intersect1d(*steps, assume_unique=True, return_indices=True)
        if len(places[0]) == 0:
            raise Missing(f"'{first}' and '{second}' were not measured in the same steps of the "
                          f"scene '{self.scene}'")
        return [measure(name)[place] for name, place in zip((first, second), places)]

    def speed_up(self, slow, fast):
        """Of each step in which there is a pair to collide, and of all of them together."""
        slow_ms, fast_ms = self.both(slow, fast, self.kernel_ms)
        pairs, _ = self.both(slow, fast, lambda name: self.column(name, "pairs"))
        if not (pairs > 0).any():
            raise Missing(f"no step of the scene '{self.scene}' has a pair to collide")
        return (slow_ms / fast_ms)[pairs > 0], slow_ms.sum() / fast_ms.sum()

    def work(self, configuration):
        """{kernel: {column: sum over the counted steps that were computed once}}."""
        counted = [row for row in self._work.get(configuration, []) if row["redone"] == "0"]
        if not counted:
            raise Missing(f"the results of the scene '{self.scene}' hold no counted work of "
                          f"'{configuration}'")
        total = {}
        for row in counted:
            kernel = total.setdefault(row["kernel"], {})
            for name in ("items", "units", "lockstep32", "lockstep64"):
                kernel[name] = kernel.get(name, 0) + int(row[name])
        return total

    def counted_steps(self, configuration):
        return {row["step"] for row in self._work.get(configuration, []) if row["redone"] == "0"}

    def lockstep_speed_up(self, slow, fast, lanes):
        """How much longer groups of so many lanes are busy with `slow`, over all kernels."""
        if self.counted_steps(slow) != self.counted_steps(fast):
            raise Missing(f"'{slow}' and '{fast}' were not counted in the same steps of the scene "
                          f"'{self.scene}'")
        busy = [sum(kernel[f"lockstep{lanes}"] for kernel in self.work(name).values())
                for name in (slow, fast)]
        return busy[0] / busy[1]

    def missed(self, configuration, buffers):
        """Entries that did not fit, and all entries, of these buffers over all measured steps."""
        lost = total = 0
        for buffer in buffers:
            actual = self.column(configuration, "actual_" + buffer)
            capacity = self.column(configuration, "capacity_" + buffer)
            lost += numpy.maximum(actual - capacity, 0).sum()
            total += actual.sum()
        return lost, total

    def foreseen(self, configuration, buffers, scaled):
        """As `missed`, had each step been predicted from the true counts of the one before, by
        Eq. 1 (scaled) or Eq. 2. Of a configuration that misses nothing."""
        steps = self.column(configuration, "step")
        if len(steps) < 2 or (numpy.diff(steps) != 1).any():
            raise Missing(f"'{configuration}' was not measured in every step of the scene "
                          f"'{self.scene}'")
        pairs = self.column(configuration, "pairs_computed")
        known = pairs[:-1] > 0
        ratio = pairs[1:][known] / pairs[:-1][known] if scaled else 1
        lost = total = 0
        for buffer in buffers:
            actual = self.column(configuration, "actual_" + buffer)
            predicted = numpy.ceil(actual[:-1][known] * ratio * PAPER_CONFIDENCE)
            lost += numpy.maximum(actual[1:][known] - numpy.maximum(predicted, 1), 0).sum()
            total += actual[1:][known].sum()
        return lost, total


def load(folder, scene):
    """The results of a scene. Raises Missing, a sentence."""
    path = os.path.join(folder, scene)
    if not os.path.isdir(path):
        raise Missing(f"the scene '{scene}' was not run: there is no folder {path}")
    return Results(path)
