#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Puts the lines and files of each room into docs/performance.md, between <!-- sizes.py: begin -->
and <!-- sizes.py: end -->, beside those that it had before the search was rebuilt."""
import argparse
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = {'.cl', '.h', '.c', '.cpp'}
# What it is called, what it had at 35a323e, rooms of now. 'kernels' is its files alone, without
# folders.
ROWS = [
    ('`include/ode_ext`', '388 (3)', ['include/ode_ext']),
    ('`ode_ext/api`', '335 (1)', ['ode_ext/api']),
    ('`ode_ext/ode`', '1,875 (27)', ['ode_ext/ode']),
    ('`ode_ext/pipeline`, now `collide`, `search`, `contacts`, `paper`', '2,599 (35)',
     ['ode_ext/collide', 'ode_ext/search', 'ode_ext/contacts', 'ode_ext/paper']),
    ('`ode_ext/geometry`, now `mesh`', '3,362 (50)', ['ode_ext/mesh']),
    ('`ode_ext/device`, now `opencl`', '1,308 (16)', ['ode_ext/opencl']),
    ('`ode_ext/preload`, `ode_ext/tools`', 'none', ['ode_ext/preload', 'ode_ext/tools']),
    ('`kernels` but for these:', '1,766 (9)', ['kernels']),
    ('`kernels/shared`, now `lib`, `abi`', '2,582 (23)', ['kernels/lib', 'kernels/abi']),
    ('`kernels/contacts`, `kernels/paper`', 'among the others', ['kernels/contacts', 'kernels/paper']),
]
BEGIN, END = '<!-- sizes.py: begin -->', '<!-- sizes.py: end -->'


def size_of(room):
    folder = ROOT / room
    paths = folder.glob('*') if room == 'kernels' else folder.rglob('*')
    files = [path for path in paths if path.suffix in SOURCES]
    if not files:
        sys.exit(f'sizes.py: there is no source in {room}')
    return sum(len(path.read_text().splitlines()) for path in files), len(files)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('document', type=pathlib.Path)
    document = parser.parse_args().document
    commit = subprocess.run(['git', 'describe', '--always', '--dirty'], cwd=ROOT, text=True,
                            capture_output=True, check=True).stdout.strip()
    lines = [f'| room | at 35a323e | at {commit} |', '|---|---|---|']
    for name, then, rooms in ROWS:
        now = ', '.join('{:,} ({})'.format(*size_of(room)) for room in rooms)
        lines.append(f'| {name} | {then} | {now} |')
    text = document.read_text()
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f'sizes.py: {document} has no place for the table')
    before, _, rest = text.partition(BEGIN)
    document.write_text(before + BEGIN + '\n\n' + '\n'.join(lines) + '\n\n' + END + rest.partition(END)[2])


if __name__ == '__main__':
    main()
