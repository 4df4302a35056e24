# SPDX-License-Identifier: BSD-3-Clause
"""A page of Markdown whose cells come from results, or say that there are none."""

from results import Missing

NO_GPU = "not measured: no GPU was available"
NOT_MEASURED = "not measured"


def percent(share, digits=2):
    return "none" if share is None else f"{100 * share:.{digits}f} %"


def nanoseconds(value):
    return "none" if value is None else f"{value:.0f}"


class Page:
    def __init__(self, scenes, gpu, report):
        self.scenes = scenes
        self.gpu = gpu
        self.report = report
        self.lines = []

    def add(self, *lines):
        self.lines += [*lines, ""]

    def table(self, head, rows):
        self.lines += ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
        self.lines += ["| " + " | ".join(row) + " |" for row in rows]
        self.lines.append("")

    def cell(self, scene, measure, results=None):
        """What `measure` says of the scene's results, or that there is nothing."""
        found = (self.scenes if results is None else results).get(scene)
        if found is None:
            return NOT_MEASURED if results is None else NO_GPU
        try:
            return measure(found)
        except Missing as missing:
            self.report(str(missing))
            return NOT_MEASURED

    def on_gpu(self, scene, measure):
        here = self.scenes.get(scene)
        if not self.gpu and here is not None and here.machine["device_type"] == "gpu":
            return self.cell(scene, measure)
        return self.cell(scene, measure, self.gpu)
