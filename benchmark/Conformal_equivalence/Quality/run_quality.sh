#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Compares the layouts of all disks among CGAL's meshes, and writes a table in Markdown.
#
#   run_quality.sh PROGRAM [TABLE]
#
# PROGRAM is the built `quality`; TABLE is quality.md unless given. CGAL_DATA_DIR names the
# folder that holds CGAL's meshes/. TIME_LIMIT: seconds of one process, default 300.

source "$(dirname "$0")/../lib/tables.sh"

check_number_of_arguments 1 2 "$@"
program=$(realpath "$1")
table=${2:-quality.md}
meshes=$(folder_of_meshes) || exit

"$program" --header > "$table"
for mesh in "$meshes"/*.off; do
  for method in ours lscm arap dcm; do
    add_rows "$(basename "$mesh" .off) | | $method" "$program" "$mesh" "$method"
    case $? in
      1 | 2) break ;; # cannot be read, or is no disk
    esac
  done
done
