#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compiles every block of C and C++ in the documentation against an installed library, runs those
that are whole programs, and builds the first of them by the block of CMake that follows it. Of a
block that shows a change (diff) what it becomes is compiled."""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
WARNINGS = ['-Wall', '-Wextra', '-Wpedantic', '-Werror', '-Wno-unused-variable']
LANGUAGES = {'c': 'c', 'cpp': 'cpp', 'c++': 'cpp', 'diff': 'c', 'cmake': 'cmake'}


def run(command, what, **options):
    result = subprocess.run(command, capture_output=True, text=True, timeout=300, **options)
    if result.returncode != 0:
        sys.exit(f'{what}: {" ".join(map(str, command))}\n{result.stdout}{result.stderr}')
    return result.stdout


def blocks(document):
    """(line, language, text) of each fenced block; a language that is not known here is an error."""
    fence = re.compile(r'^```(\S*)\n(.*?)^```$', re.M | re.S)
    text = document.read_text()
    for match in fence.finditer(text):
        line = text[:match.start()].count('\n') + 2
        language = match[1]
        if language in ('text', 'toml'):  # a scene: SceneFile of ode_ext_tests reads it
            continue
        if language not in LANGUAGES:
            sys.exit(f'{document}:{line}: no way to try a block of "{language}"')
        yield line, language, match[2]


def after(diff):
    """What a diff leaves; "..." stands for what is not shown."""
    lines = [line[1:] for line in diff.splitlines() if not line.startswith('-')]
    return '\n'.join(line for line in lines if line.strip() != '...') + '\n'


class Library:
    """An installed library, and how to compile with it."""

    def __init__(self, build, prefix):
        self.prefix = prefix
        run(['cmake', '--install', build, '--prefix', prefix], 'install')
        pc = next(prefix.rglob('ode_ext.pc')).parent
        flags = run(['pkg-config', '--cflags', '--libs', 'ode_ext'], 'pkg-config',
                    env={'PKG_CONFIG_PATH': str(pc), 'PATH': '/usr/local/bin:/usr/bin:/bin'})
        self.flags = flags.split() + [f'-Wl,-rpath,{pc.parent}']

    def compile(self, source, to, options=()):
        compiler = ['cc', '-std=c11'] if source.suffix == '.c' else ['c++', '-std=c++20']
        run([*compiler, *WARNINGS, *options, source, '-o', to, *self.flags], source.name)


def check(document, library, work):
    name = document.stem
    program, statements, counts = None, [], dict(programs=0, fragments=0, projects=0)
    for line, language, text in blocks(document):
        kind = LANGUAGES[language]
        here = f'#line {line} "{document.name}"\n'
        if kind == 'cmake':
            build_by_cmake(document, line, text, program, library, work)
            counts['projects'] += 1
        elif 'int main(' in text:
            program = work / f'{name}_{line}.{kind}'
            program.write_text(text)
            library.compile(program, work / 'program')
            run([work / 'program'], f'{document}:{line}')
            counts['programs'] += 1
        else:
            statements.append(here + (after(text) if language == 'diff' else text))
            counts['fragments'] += 1
    if statements:
        source = work / f'{name}.c'
        source.write_text((HERE / 'frame.c').read_text().replace('/* HERE */', '\n' + '\n'.join(statements)))
        library.compile(source, work / 'fragments.o', ['-c'])
    return counts


def build_by_cmake(document, line, text, program, library, work):
    if program is None:
        sys.exit(f'{document}:{line}: no whole program before it that this would build')
    project = work / 'project'
    project.mkdir()
    (project / 'CMakeLists.txt').write_text(text)
    source = re.search(r'add_executable\(\S+ (\S+)\)', text)[1]
    (project / source).write_text(program.read_text())
    what = f'{document}:{line}'
    run(['cmake', '-S', project, '-B', project / 'build', '-G', 'Ninja',
         f'-DCMAKE_PREFIX_PATH={library.prefix}'], what)
    run(['cmake', '--build', project / 'build'], what)
    run([project / 'build' / pathlib.Path(source).stem], what)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('build', type=pathlib.Path, help='build folder, to install the library from')
    parser.add_argument('documents', type=pathlib.Path, nargs='+')
    arguments = parser.parse_args()
    totals = dict(programs=0, fragments=0, projects=0)
    with tempfile.TemporaryDirectory() as work:
        library = Library(arguments.build, pathlib.Path(work) / 'prefix')
        for document in arguments.documents:
            folder = pathlib.Path(work) / document.stem
            folder.mkdir()
            for key, count in check(document, library, folder).items():
                totals[key] += count
    if not all(totals.values()):
        sys.exit(f'too little was tried: {totals}')
    print(', '.join(f'{count} {key}' for key, count in totals.items()))


main()
