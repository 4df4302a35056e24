#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# The recipes of packaging/ as far as they can be tried without conda and vcpkg: they can be read, name
# the project's version and files that are there, and their commands configure this tree. So does the
# preset of the library alone, which finds nothing but ODE and OpenCL.
set -euo pipefail

root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
  echo "recipes: $*" >&2
  exit 1
}

version=$(sed -n 's/^project(ode_ext VERSION \([0-9.]*\) .*/\1/p' "$root/CMakeLists.txt")
[[ -n $version ]] || fail "CMakeLists.txt has no version"
# Debian's, for which python3-yaml is installed, whichever else comes first.
/usr/bin/python3 - "$root" "$version" <<'TEXT'
import json, os, sys, yaml
root, version = sys.argv[1:]
def check(holds, what):
    if not holds: sys.exit(f'recipes: {what}')
def is_version(where, found):
    check(found == version, f'{where} is of version {found}, the project of {version}')
recipe = yaml.safe_load(open(f'{root}/packaging/conda/recipe.yaml'))
is_version('recipe.yaml', recipe['context']['version'])
for file in [recipe['build']['script'], recipe['about']['license_file']]:
    check(os.path.exists(f'{root}/{file}'), f'recipe.yaml names {file}, which is not there')
for tool in recipe['tests'][0]['package_contents']['bin']:
    check(os.path.isdir(f'{root}/ode_ext/tools/' + tool.split('-')[1]), f'there is no {tool}')
port = json.load(open(f'{root}/packaging/vcpkg/ode-ext/vcpkg.json'))
is_version('vcpkg.json', port['version'])
citation = yaml.safe_load(open(f'{root}/CITATION.cff'))
is_version('CITATION.cff', citation['version'])
for key in ['cff-version', 'message', 'title', 'authors', 'license', 'references']:
    check(citation.get(key), f'CITATION.cff has no {key}')
TEXT
echo "versions: $version"

for features in "" tools; do
  rm -rf "$work/build"
  cmake -DPORT="$root/packaging/vcpkg/ode-ext" -DFEATURES="$features" -DWORK="$work" \
    -P "$root/tests/install/vcpkg.cmake" > "$work/log" 2>&1 || { cat "$work/log" >&2; fail vcpkg; }
done
echo "vcpkg: configures, with tools and without"

# The first command configures, for real; what would build and install is only looked at.
mkdir "$work/bin"
cat > "$work/bin/cmake" <<TEXT
#!/bin/bash
case "\$1" in
  -S) exec $(command -v cmake) "\${@/build\\/conda/$work/conda}" ;;
  --build | --install) echo "\$@" >> "$work/calls" ;;
  *) exit 1 ;;
esac
TEXT
chmod +x "$work/bin/cmake"
(cd "$root" && PATH=$work/bin:$PATH PREFIX=$work/prefix packaging/conda/build.sh) \
  > "$work/log" 2>&1 || { cat "$work/log" >&2; fail conda; }
grep -q "not used by the project" "$work/log" && { cat "$work/log" >&2; fail "conda"; }
[[ $(wc -l < "$work/calls") -eq 2 ]] || fail "conda: expected one build and one install"
echo "conda: configures"

# What it finds is what it needs.
cmake -S "$root" -B "$work/lib" --preset lib > "$work/log" 2>&1 ||
  { cat "$work/log" >&2; fail "the preset lib does not configure"; }
for package in CLI11 assimp nlohmann_json GTest Eigen3 CGAL; do
  ! grep -q -E "^(${package}_DIR|FIND_PACKAGE_MESSAGE_DETAILS_$package)" \
    "$work/lib/CMakeCache.txt" || fail "the preset lib looks for $package"
done
echo "lib: finds ODE and OpenCL, and looks for nothing else"
