#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Maps all closed surfaces of genus 0 among CGAL's meshes to the sphere, and all disks to the disk, and writes a table in Markdown.
#
#   run_sphere.sh [--full] PROGRAM [TABLE]
#
# PROGRAM is the built `sphere`; TABLE is sphere.md unless given. With --full, a sphere of a million vertices is compared with
# a plane solve of that size, too (a minute). CGAL_DATA_DIR names the folder that holds CGAL's meshes/. From the
# environment too: TIME_LIMIT (seconds of one process, default 300), OMP_NUM_THREADS and OPENBLAS_NUM_THREADS (default 1).

source "$(dirname "$0")/../lib/tables.sh"

full=
if [ "${1:-}" = --full ]; then
  full=1
  shift
fi
check_number_of_arguments 1 2 "$@"
program=$(realpath "$1")
table=${2:-sphere.md}
meshes=$(folder_of_meshes) || exit

"$program" --header > "$table"
for mesh in "$meshes"/*.off; do # what is no mesh, or of another kind, gives no row
  add_rows "$(basename "$mesh" .off)" "$program" "$mesh"
done

if [ -n "$full" ]; then
  printf '\n' >> "$table"
  "$program" --time 1000000 >> "$table"
fi
