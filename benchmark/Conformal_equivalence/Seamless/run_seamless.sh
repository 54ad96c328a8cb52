#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Turns the handles of CGAL's closed meshes, and writes a table in Markdown.
#
#   run_seamless.sh PROGRAM [TABLE [OPTION...]]
#
# PROGRAM is the built `seamless`; TABLE is seamless.md unless given; options are those of the program. CGAL_DATA_DIR names the folder that holds CGAL's
# meshes/. From the environment too: TIME_LIMIT (seconds of one process, default 300), OMP_NUM_THREADS and OPENBLAS_NUM_THREADS (default 1).

source "$(dirname "$0")/../lib/tables.sh"
check_number_of_arguments 1 99 "$@"
program=$(realpath "$1")
table=${2:-seamless.md}
shift
[ $# -gt 0 ] && shift
meshes=$(folder_of_meshes) || exit

"$program" --header > "$table"
for mesh in "$meshes"/*.off; do
  add_rows "$(basename "$mesh" .off)" "$program" "$@" "$mesh"
done
exit 0
