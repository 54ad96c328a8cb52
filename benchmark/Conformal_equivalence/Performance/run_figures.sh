#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The figures by which the speed of the package is judged, in one run, as tables in Markdown.
#
#   run_figures.sh [--full] PROGRAM [FLATTEN_MESH]
#
# PROGRAM is the built `performance`; FLATTEN_MESH the program of that name, whose time from file to file is measured if it is given. Without
# --full on terrains of 10 000 to 160 000 vertices, in a minute; with it up to 4 000 000. The factorization of CHOLMOD, ordered by METIS, to which
# seconds are compared is measured in the same process, right before. CGAL_DATA_DIR names the folder that holds CGAL's meshes/.

source "$(dirname "$0")/../lib/tables.sh"

full=
if [ "${1:-}" = --full ]; then
  full=1
  shift
fi
check_number_of_arguments 1 2 "$@"
program=$(realpath "$1")
flatten_mesh=${2:+$(realpath "$2")}
meshes=$(folder_of_meshes) || exit
sizes="10000 40000 160000${full:+ 640000 1000000 4000000}"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# value KEY FILE
value()
{
  awk -v key="$1" '$1 == key { print $2; exit }' "$2"
}

# calculate EXPRESSION FORMAT: empty where a number is missing
calculate()
{
  awk "BEGIN { printf \"$2\", $1 }" 2> /dev/null
}

# row NAME MESH
row()
{
  local of="$folder/ours" bytes="$folder/bytes" two="$folder/two" n metis solve discarded
  "$program" "$2" ours-beside > "$of" 2> /dev/null
  "$program" "$2" ours-2 > "$two" 2> /dev/null
  "$program" "$2" ours > "$bytes" 2> /dev/null
  n=$(value vertices "$of")
  metis=$(value metis_seconds "$of")
  solve=$(value solve_seconds "$of")
  discarded=$(value discarded_seconds "$of")
  [ "$(value edges_flipped "$of")" != 0 ] || discarded=
  printf '| %s | %d | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n' "$1" "$n" "$metis" "$solve" \
    "$(calculate "$solve / $metis" %.2f)" "$(calculate "$solve / $(value amd_seconds "$of")" %.2f)" \
    "$(calculate "$(value user_seconds "$of") + 0" %.2f) + $(calculate "$(value system_seconds "$of") + 0" %.2f)" \
    "$(calculate "1e6 * $(value total_seconds "$of") / $n" %.2f)" "$(calculate "1e6 * $(value layout_seconds "$of") / $n" %.2f)" \
    "$(calculate "$(value memory "$bytes") / $n" %.0f)" \
    "$(calculate "($(value memory "$bytes") - $(value memory_before "$bytes")) / $n" %.0f)" \
    "${discarded:+$(calculate "$discarded / ($solve - $discarded)" %.2f)}" \
    "$(calculate "$(value solve_elapsed_seconds "$bytes") / $(value solve_elapsed_seconds "$two")" %.2f)"
}

echo "| mesh | vertices | METIS | solve | / METIS | / AMD | whole: user + system | whole, us a vertex | layout, us a vertex | bytes a vertex | of which flatten() | discarded / rest | two threads, times as fast |"
echo "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
for n in $sizes; do
  row "terrain" "terrain:$n"
done
row lion-head-Loop-2 "loop:2:0:$meshes/lion-head.off"
row mannequin-Loop-2 "loop:2:0:$meshes/mannequin-devil.off"

[ -n "$flatten_mesh" ] || exit 0
echo
echo "| mesh | flatten_mesh, file to file: user + system |"
echo "|---|--:|"
for name in lion-head mannequin-devil; do
  { TIMEFORMAT='%U + %S'; time "$flatten_mesh" "$meshes/$name.off" "$folder/flat.obj" > /dev/null 2>&1; } 2> "$folder/time"
  printf '| %s | %s |\n' "$name" "$(cat "$folder/time")"
done
