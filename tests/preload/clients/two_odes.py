#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two modules in one process that bring an ODE each: dartpy Debian's, in double precision, and panda3d
its own, in single precision."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import dartpy_pairs  # noqa: E402
import panda_meshes  # noqa: E402

if __name__ == "__main__":
    for module in dartpy_pairs, panda_meshes:
        print(module.__name__)
        module.main()
