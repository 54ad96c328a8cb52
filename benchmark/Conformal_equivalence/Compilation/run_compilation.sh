#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What programs cost to compile: README's program, one for the sphere and one for seamless textures, beside one that calls CGAL's LSCM. All
# are compiled one after the other, in rounds, with the same flags; what counts are processor seconds, the least of the rounds, and the
# ratio to LSCM's. Writes a table in Markdown.
#
#   run_compilation.sh [TABLE]           the table is compilation.md unless given
#
# From the environment: CXX (default g++), CXXFLAGS (default -O2), ROUNDS (default 3).

source "$(dirname "$0")/../lib/tables.sh"
set -e

check_number_of_arguments 0 1 "$@"
table=${1:-compilation.md}
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# README's program: its first block of C++
awk '/^```cpp/ { inside = 1; next } /^```/ { if(inside) exit } inside' "$root/README.md" > "$work/readme.cpp"

# Prints processor seconds and megabytes of one compilation.
measure()
{
  local compiled=() used
  [ "$2" = headers ] || compiled=(-DCGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED)
  used=$( { /usr/bin/time -f '%U %S %M' "${CXX:-g++}" -std=c++17 ${CXXFLAGS:--O2} -frounding-math -DCGAL_EIGEN3_ENABLED \
    ${compiled[@]+"${compiled[@]}"} -I "$root/include" -isystem /usr/include/eigen3 -c "$1" -o "$work/object.o"; } 2>&1 | tail -n 1)
  awk '{ printf "%.2f %.0f\n", $1 + $2, $3 / 1024 }' <<< "$used"
}

programs="LSCM:$here/compile_LSCM.cpp:headers README:$work/readme.cpp:headers README:$work/readme.cpp:compiled
          sphere:$here/compile_sphere.cpp:headers sphere:$here/compile_sphere.cpp:compiled
          seamless:$here/compile_seamless.cpp:headers seamless:$here/compile_seamless.cpp:compiled"
for round in $(seq "${ROUNDS:-3}"); do
  for program in $programs; do
    IFS=: read -r name source kind <<< "$program"
    echo "$name:$kind $(measure "$source" "$kind")"
  done
done > "$work/measured"

{
  printf '| program | seconds | / LSCM | MB | / LSCM | with the compiled library: seconds | / LSCM | MB | / LSCM |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n'
  awk '{ if(!($1 in s) || $2 < s[$1]) s[$1] = $2; if(!($1 in m) || $3 < m[$1]) m[$1] = $3 }
    END {
      t = s["LSCM:headers"]; b = m["LSCM:headers"]
      printf "| LSCM | %.1f | 1 | %d | 1 | | | | |\n", t, b
      n = split("README sphere seamless", name)
      for(i = 1; i <= n; ++i)
      {
        h = name[i] ":headers"; c = name[i] ":compiled"
        printf "| %s | %.1f | %.2f | %d | %.2f | %.1f | %.2f | %d | %.2f |\n",
          name[i], s[h], s[h] / t, m[h], m[h] / b, s[c], s[c] / t, m[c], m[c] / b
      }
    }' "$work/measured"
} > "$table"
cat "$table"
