#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The table of section 7 of Springborn, Schroeder and Pinkall (2008) for some of CGAL's meshes, in Markdown.
#
#   run_paper_table.sh [--all] PROGRAM [TABLE]
#
# PROGRAM is the built `paper_table`; TABLE is paper_table.md unless given. With --all, instead, seamless maps of all disks
# (4 cones) and spheres (8 cones) among CGAL's meshes, and how many of them succeed. CGAL_DATA_DIR names the folder that
# holds CGAL's meshes/. From the environment too: TIME_LIMIT (seconds of one process, default 300), OMP_NUM_THREADS and
# OPENBLAS_NUM_THREADS (default 1).

source "$(dirname "$0")/../lib/tables.sh"

all=
if [ "${1:-}" = --all ]; then
  all=1
  shift
fi
check_number_of_arguments 1 2 "$@"
program=$(realpath "$1")
table=${2:-paper_table.md}
meshes=$(folder_of_meshes) || exit

print_rows() # NAME ARGUMENT...
{
  name=$1
  shift
  add_rows "$name" "$program" "$@"
  [ $? != 1 ] || printf '| %s | exception |\n' "$name" >> "$table" # (2: what is no mesh, or of another kind, gives no row)
}

"$program" --header > "$table"
if [ -n "$all" ]; then
  for mesh in "$meshes"/*.off; do
    print_rows "$(basename "$mesh" .off)" --seamless "$mesh"
  done
  count=$(awk 'NR > 2 { ++rows } / ok \|$/ { ++good } END { printf "%d of %d succeed.", good, rows }' "$table")
  printf '\n%s\n' "$count" >> "$table"
  exit
fi

while read -r name cones; do
  print_rows "$name" "$meshes/$name.off" "$cones"
done << 'MODELS'
lion-head 5
nefertiti 4
mannequin-devil 4
mushroom 4
three_peaks 4
bear 8
bull 8
sphere 8
blobby 8
fandisk 12
homer 8
bunny00 8
MODELS
