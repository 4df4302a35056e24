#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Puts together what the documentation site is made of, in the layout of the project: its pages, and
every file of the project that they link to, sources as text. A link to what is not there is an
error. What GitHub's Markdown allows and Python's does not is mended."""
import argparse
import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = [ROOT / 'README.md', ROOT / 'CHANGELOG.md', ROOT / 'CONTRIBUTING.md',
         ROOT / 'packaging/README.md', *sorted((ROOT / 'docs').glob('*.md'))]
AS_IT_IS = {'.md', '.svg', '.png', '.webp'}
LINK = re.compile(r'\[([^\]]*)\]\(([^)\s#]*)(#[^)\s]*)?\)')
ITEM = re.compile(r'^(?:[-*]|\d+\.) ')


def stage(page, target):
    """Copies what `page` links to; returns its text with links to the copies."""

    def replace(match):
        link = match[2]
        if not link or re.match(r'[a-z]+:', link):
            return match[0]
        file = (page.parent / link).resolve()
        if not file.exists() or ROOT not in file.parents:
            sys.exit(f'{page.relative_to(ROOT)}: links to {link}, which is not there')
        if file.suffix == '.md' and file in PAGES:
            return match[0]
        if file.is_dir():  # nothing to show: the text stands
            return match[1]
        suffix = '' if file.suffix in AS_IT_IS - {'.md'} else '.txt'
        copy = target / file.relative_to(ROOT)
        copy = copy.with_name(copy.name + suffix)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, copy)
        place = match[3] if match[3] and not suffix else ''
        return f'[{match[1]}]({link}{suffix}{place})'

    return LINK.sub(replace, page.read_text())


def for_python(text):
    """A list needs an empty line before it."""
    lines, fenced = [], False
    for line in text.splitlines():
        before = lines[-1] if lines else ''
        if ITEM.match(line) and not fenced and before.strip() and not ITEM.match(before) and \
                not before.startswith(' '):
            lines.append('')
        fenced ^= line.startswith('```')
        lines.append(line)
    return '\n'.join(lines) + '\n'


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('target', type=pathlib.Path)
    target = parser.parse_args().target.resolve()
    for page in PAGES:
        text = for_python(stage(page, target))
        copy = target / page.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(text)
    # Here the reference is at hand.
    reference = target / 'docs/reference.md'
    text = reference.read_text()
    here = re.sub(r'The \[documentation site\]\([^)]*\) has the same as pages, made by Doxygen\.',
                  '[The same as pages](../reference/ode__ext_8h.html), made by Doxygen.', text)
    if here == text:
        sys.exit('docs/reference.md: where is the sentence about the site?')
    reference.write_text(here)


main()
