#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Follows every link within a finished site: the file is there, and what it names in it."""
import argparse
import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.links, self.names = [], set()
        self.feed(file.read_text())

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ('id', 'name') and value:
                self.names.add(value)
            if key in ('href', 'src') and value and tag != 'link':
                self.links.append(value)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('site', type=pathlib.Path)
    site = parser.parse_args().site.resolve()
    pages = {file: Page(file) for file in site.rglob('*.html') if file.name != '404.html'}
    broken, followed = [], 0
    for file, page in pages.items():
        for link in page.links:
            url = urllib.parse.urlsplit(link)
            if url.scheme or url.netloc:
                continue
            followed += 1
            target = (file.parent / urllib.parse.unquote(url.path)).resolve() if url.path else file
            if target.is_dir():
                target /= 'index.html'
            name = urllib.parse.unquote(url.fragment)
            if not target.exists():
                broken.append(f'{file.relative_to(site)}: {link}: no such file')
            elif name and target in pages and name not in pages[target].names:
                broken.append(f'{file.relative_to(site)}: {link}: no such place')
    print('\n'.join(sorted(set(broken))))
    if broken or not followed:
        sys.exit(f'{len(set(broken))} broken links')
    print(f'{followed} links of {len(pages)} pages lead somewhere')


main()
