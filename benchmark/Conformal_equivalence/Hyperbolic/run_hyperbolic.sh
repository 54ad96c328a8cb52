#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Finds the hyperbolic surfaces of all closed connected meshes of genus 2 and more among CGAL's, and of plates with handles, and writes a table in
# Markdown.
#
#   run_hyperbolic.sh PROGRAM [TABLE]
#
# PROGRAM is the built `hyperbolic`; TABLE is hyperbolic.md unless given. CGAL_DATA_DIR names the folder that holds CGAL's meshes/. From the
# environment too: TIME_LIMIT (seconds of one process, default 300), OMP_NUM_THREADS and OPENBLAS_NUM_THREADS (default 1).

source "$(dirname "$0")/../lib/tables.sh"

check_number_of_arguments 1 2 "$@"
program=$(realpath "$1")
table=${2:-hyperbolic.md}
meshes=$(folder_of_meshes) || exit

"$program" --header > "$table"
for mesh in "$meshes"/*.off plate:4000:3 plate:4000:5 plate:8000:9 plate:8000:13; do # what is of another kind gives no row
  add_rows "$(basename "$mesh" .off)" "$program" "$mesh"
done
