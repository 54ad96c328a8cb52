#!/bin/bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What a person meets who uses the program: whether help, manual page, manual, README and the completions of shells name the same options,
# several inputs, pipes, and whether reports are as their schema says.
#
#   run.sh PROGRAM SOURCE_FOLDER MESHES [REPORT...]
#
# MESHES is the folder of CGAL's meshes, and may be missing; REPORTs were written by other tests. What needs a program that is not there is skipped.

set -euo pipefail

program="$1" source="$2" meshes="$3"
shift 3
reports=("$@")

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"

failures=0
failed() { echo "FAILED: $*"; failures=$((failures + 1)); }
skipped() { echo "SKIPPED: $*"; }
has() { command -v "$1" > /dev/null; }

# same WHAT EXPECTED FOUND
same() { [ "$2" = "$3" ] || failed "$1: expected '$2', found '$3'"; }

# ------------------------------------------------------------- the options ----

# names: the long options in the text on the standard input, sorted
names() { { grep -oE -- '(^|[^a-zA-Z0-9-])--[a-z]+(-[a-z]+)*' || true; } | grep -oE -- '--.*' | LC_ALL=C sort -u; }

"$program" --help > help
for what in man bash zsh fish; do "$program" --print $what > $what; done

# those that the help declares, at the beginnings of lines
sed -nE 's/^  (-. \[ )?(--[a-z-]+).*/\2/p' help | LC_ALL=C sort -u > options
[ "$(wc -l < options)" -ge 40 ] || failed "the help text declares only $(wc -l < options) options"

# compare WHERE: its options, on the standard input, are those of the program
compare()
{
  names | diff options - > difference || { failed "the options of $1 are not those of the program (<):"; cat difference; }
}
compare "the manual page"         < <(sed -n '/^\.TP/{n;p}' man | sed -E 's/\\f[BIR]/ /g; s/\\//g')
compare "the completion of bash"  < <(sed -nE '/compgen -W .*--/p' bash | sed -E "s/\\\\n/ /g; s/\\$'/ /; s/ -- .*//")
compare "the completion of zsh"   < <(sed "s/[*'{,]/ /g" zsh | sed 's/\[.*//')
compare "the completion of fish"  < <(sed -nE 's/.* -l ([a-z-]+).*/ --\1/p' fish)
compare "the manual"              < <(sed -n 's/<dt>\(.*\)<\/dt>.*/\1/p' "$source/doc/Conformal_equivalence/Program_options.txt")

# every other mention is of an option that there is (these are of other programs)
for file in README.md doc/Conformal_equivalence/Conformal_equivalence.txt doc/Conformal_equivalence/Program_options.txt CHANGES.md; do
  unknown="$(names < "$source/$file" | grep -vxF -e --build -e --install -e --prefix -e --preset -e --all -e --cflags -e --libs -e --target \
             | grep -vxF -f options || true)"
  [ -z "$unknown" ] || failed "$file mentions options that there are not: $unknown"
done
same "values are shown" "" "$(grep -E '^  [^ ].* arg( |$)' help || true)"

# -------------------------------------------- the manual page, and shells ----

if has man; then
  same "warnings about the manual page" "" "$(MANROFFSEQ= LC_ALL=C.UTF-8 man --warnings -l man 2>&1 > /dev/null || true)"
else
  skipped "the manual page, without man"
fi
for shell in zsh fish; do
  if has $shell; then $shell -n $shell || failed "$shell cannot read its completion"; else skipped "the completion of $shell"; fi
done
touch lion.off

# completed EXPECTED WORD...: what bash makes of the last word
completed()
{
  local expected="$1"
  shift
  same "completion of $*" "$expected" "$(bash -c 'source ./bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _flatten_mesh; echo "${COMPREPLY[@]}"' bash "$@")"
}
completed --target                  flatten_mesh --targ
completed sphere                    flatten_mesh lion.off --target sp
completed sphere                    flatten_mesh --target = sp
completed lion.off                  flatten_mesh li
completed lion.off                  flatten_mesh --boundary angles = li
completed "man bash zsh fish"       flatten_mesh --print ""

# -------------------------------------------------- several inputs, and pipes ----

# A tetrahedron without its base, as OFF and as PLY; and what is no surface.
tent="0 0 1
1 0 0
0 1 0
-1 -1 0"
{ printf 'OFF\n4 3 0\n%s\n' "$tent"; printf '3 0 %d %d\n' 1 2 2 3 3 1; } > "a b.off"
{ printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n'
  printf 'element face 3\nproperty list uchar int vertex_indices\nend_header\n%s\n' "$tent"; printf '3 0 %d %d\n' 1 2 2 3 3 1; } > c.ply
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 0\n3 0 1 0\n' > bad.off
has_reports=yes
"$program" --quiet c.ply --report one.json 2> err || { grep -q nlohmann err && has_reports=no; } || failed "a report: $(cat err)"

mkdir out
report=()
[ $has_reports = no ] || report=(--report out/all.json)
status=0
"$program" "a b.off" bad.off c.ply --quiet -o 'out/%.obj' --svg 'out/100%%_%.svg' "${report[@]}" > text 2> err || status=$?
same "status of three inputs, one of them bad" 1 $status
same "lines of complaint" 1 "$(wc -l < err)"
grep -q '^flatten_mesh: bad.off: ' err || failed "the bad input is not named: $(cat err)"
same "what is said" "" "$(cat text)"
expected="$(printf '%s\n' "a b.obj" "a b.mtl" "a b.checker.png" c.obj c.mtl c.checker.png "100%_a b.svg" 100%_c.svg; [ $has_reports = no ] || echo all.json)"
same "files of three inputs" "$(LC_ALL=C sort <<< "$expected")" "$(LC_ALL=C ls out)"
"$program" "a b.off" --quiet -o single.obj
same "a mesh by itself and among others" "$(grep -v mtllib single.obj)" "$(grep -v mtllib "out/a b.obj")"
rm -rf out/*

# refused REASON ARGUMENT...: before anything is written
refused()
{
  local reason="$1" status=0
  shift
  "$program" "$@" > text 2> err || status=$?
  same "status of $*" 2 $status
  grep -qF -- "$reason" err || failed "$* is refused for another reason: $(cat err)"
  same "files after $*" "" "$(ls out)"
}
mkdir other
cp c.ply other/c.off.ply
cp "a b.off" other/c.off
refused "-o needs a %"            "a b.off" c.ply -o out/o.obj
refused "--svg needs a %"         "a b.off" c.ply --svg -
refused "two outputs have the same name" c.ply other/c.off -o 'out/%.obj'
refused "two outputs have the same name" "a b.off" c.ply -o 'out/%.obj' --svg 'out/%.checker.png'
refused "overwrite the input"     "a b.off" c.ply --svg '%.ply'
refused "overwrite the input"     c.ply "a b.off" --svg 'other/../%.off'
refused "only once"               - -
refused "only once"               "a b.off" c.ply --cones -
refused "unknown value 'stl2'"    c.ply --format stl2
refused "unknown value 'tcsh'"    --print tcsh

# in pipes, with and without a word about the format; and a name that says nothing
"$program" c.ply -o single.obj --quiet
same "from pipe to pipe" "$(grep -vE 'mtllib|usemtl' single.obj)" "$("$program" - -o - < c.ply 2> err | grep -v usemtl)"
grep -q '4 vertices, 3 triangles' err || failed "the summary is not on the standard error stream"
same "with a format" "$(grep -vE 'mtllib|usemtl' single.obj)" "$(cat c.ply | "$program" - --format ply -o - --quiet | grep -v usemtl)"
cp c.ply data.txt
"$program" data.txt --quiet > text 2> err && failed "a file of unknown kind is read" || grep -q -- --format err || failed "--format is not proposed: $(cat err)"
"$program" data.txt --format ply --quiet || failed "a file with a format"
"$program" - --format off < c.ply > text 2> err && failed "PLY is read as OFF" || true

# ------------------------------------------------------------------ reports ----

python=
for candidate in python3 /usr/bin/python3; do
  if [ -z "$python" ] && $candidate -c 'import jsonschema' 2> /dev/null; then python=$candidate; fi
done

if [ $has_reports = no ]; then
  skipped "reports: the program was built without nlohmann-json"
elif [ -z "$python" ]; then
  skipped "reports: there is no python3 with jsonschema"
else
  "$program" "a b.off" bad.off c.ply --quiet --tolerance 1e-9 --boundary natural --report - > all.json 2> err || true
  { printf 'OFF\n8 6 0\n%s\n%s\n' "$tent" "$tent"; printf '3 0 %d %d\n' 1 2 2 3 3 1; printf '3 4 %d %d\n' 5 6 6 7 7 5; } > two.off
  "$program" two.off --target disk --quiet --report disk.json
  "$program" two.off --seamless --repair --quiet --report two.json
  if [ -d "$meshes" ]; then
    "$program" "$meshes/eight.off" --target hyperbolic --quiet --report hyperbolic.json
    "$program" "$meshes/bear.off" --target sphere --quiet --report sphere.json
    "$program" "$meshes/torus_quad.off" --projective --quiet --report torus.json
    "$program" "$meshes/blob.off" --local-repair --quiet --report repaired.json
    "$program" "$meshes/eight.off" --cones auto=8 --seamless --quiet --report handles.json
  fi
  $python - "$source/examples/Conformal_equivalence/flatten_mesh/report.schema.json" *.json "${reports[@]}" << 'END' || failed "reports"
import json
import sys

import jsonschema

schema = json.load(open(sys.argv[1]))
jsonschema.Draft7Validator.check_schema(schema)
failures = 0

def check(holds, what):
    global failures
    if not holds:
        print("   ", what)
        failures += 1

# The schema says "one of several things": what is wrong with a report is told of the part that it is meant for.
parts = dict(schema["definitions"]["report"], definitions=schema["definitions"])
validator = jsonschema.Draft7Validator(parts)

def validate(report, name):
    for error in validator.iter_errors(report):
        check(False, "%s, %s: %s" % (name, "/".join(str(x) for x in error.absolute_path), error.message))

for name in sys.argv[2:]:
    reports = json.load(open(name))
    check(jsonschema.Draft7Validator(schema).is_valid(reports), name + " is not as the schema says")
    for report in reports if isinstance(reports, list) else [reports]:
        validate(report, name)

reports = json.load(open("all.json"))
check([r["input"] for r in reports] == ["a b.off", "bad.off", "c.ply"], "inputs of the joint report")
check([r["status"] for r in reports] == ["OK", "FAILED", "OK"], "status in the joint report")
check(reports[0]["options"] == {"quiet": True, "tolerance": "1e-9", "boundary": "natural", "report": "-"}, "options in the report")

# both directions: what is not as it must be is refused
for spoil in (lambda r: r.pop("version"), lambda r: r.update(faces=-1), lambda r: r.update(surprise=0), lambda r: r["options"].update(x=[]),
              lambda r: r.update(status="FINE"), lambda r: r["seconds"].update(solve="long")):
    report = json.loads(json.dumps(reports[0]))
    spoil(report)
    check(not validator.is_valid(report), "a spoilt report is accepted")
print("%d files of reports, %d failures" % (len(sys.argv) - 2, failures))
sys.exit(failures != 0)
END
fi

[ $failures = 0 ] || { echo "$failures failures"; exit 1; }
echo "The program is as it is described."
