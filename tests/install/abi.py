#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares what a compiled program keeps of the public header, the values of enumerators and the
layout of structs, and what it is linked against, the functions, with the table abi.txt.

Nothing in the table may change, since programs that were built before have it in them. What is new
is added to the table, by --add."""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TABLE = HERE / "abi.txt"


def facts_in_words(header):
    """Lines of C that print the facts of the header, by their names."""
    text = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    lines = []
    for body in re.findall(r"^enum \{(.*?)^\};", text, flags=re.DOTALL | re.MULTILINE):
        for name in re.findall(r"^\s*(\w+)\s*=", body, flags=re.MULTILINE):
            lines.append(f'printf("value {name} %lld\\n", (long long){name});')
    for name, body in re.findall(r"^typedef struct (\w+) \{(.*?)^\} \1;", text,
                                 flags=re.DOTALL | re.MULTILINE):
        fields = re.findall(r"(\w+);", body)
        for field in fields:
            lines.append(f'printf("offset {name}.{field} %zu %zu\\n", offsetof({name}, {field}), '
                         f"sizeof((({name} *)0)->{field}));")
        if "struct_size" not in fields:  # with it a struct may grow at its end
            lines.append(f'printf("size {name} %zu\\n", sizeof({name}));')
    return lines


def functions(header):
    """Names, and declarations without the names of parameters."""
    text = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    found = re.findall(r"^ODE_EXT_API ([\w\s*]+?)(dBatch\w+)\((.*?)\);", text,
                       flags=re.DOTALL | re.MULTILINE)
    for result, name, parameters in found:
        types = [re.sub(r"(?<=[\s*])\w+$", "", " ".join(p.split())).strip()
                 for p in parameters.split(",")]
        yield name, f"function {result.strip()} {name}({', '.join(types)})"


def facts(build):
    header = (ROOT / "include/ode_ext/ode_ext.h").read_text()
    lines = facts_in_words(header)
    with tempfile.TemporaryDirectory() as folder:
        source, program = pathlib.Path(folder, "abi.c"), pathlib.Path(folder, "abi")
        source.write_text("#include <ode_ext/ode_ext.h>\n#include <stdio.h>\nint main(void) {\n" +
                          "\n".join(lines) + "\nreturn 0;\n}\n")
        generated = build / "generated/include"
        subprocess.run(["cc", "-std=c11", "-I", ROOT / "include", "-I", generated, "-iquote",
                        generated / "ode_ext", source, "-o", program], check=True)
        printed = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    symbols = subprocess.run(["nm", "-D", "--defined-only", build / "libode_ext.so"], check=True,
                             capture_output=True, text=True).stdout.split()
    return printed.splitlines() + [words for name, words in functions(header) if name in symbols]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, help="a build directory with a shared library")
    parser.add_argument("--add", action="store_true", help="write what is new into the table")
    arguments = parser.parse_args()
    now = facts(arguments.build)
    table = TABLE.read_text().splitlines()
    missing = [line for line in table if line not in now and not line.startswith("#")]
    new = [line for line in now if line not in table]
    for line in missing:
        print(f"abi: no longer so: {line}", file=sys.stderr)
    if missing:
        sys.exit("abi: programs built before would go wrong; give it the value, place or name that "
                 "it had, or take its line out of tests/install/abi.txt and raise the version")
    if new and not arguments.add:
        print(*new, sep="\n", file=sys.stderr)
        sys.exit("abi: the lines above are new; tests/install/abi.py --add BUILD adds them to the "
                 "table, and from then on they stay")
    if new:
        TABLE.write_text("\n".join(table + new) + "\n")
    print(f"{len(now)} facts are as they were, {len(new)} added")


main()
