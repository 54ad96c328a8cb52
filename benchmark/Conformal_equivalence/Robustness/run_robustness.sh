#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Finds metrics with flips under extreme conditions and on all of CGAL's meshes, and writes a table in Markdown.
#
#   run_robustness.sh PROGRAM [TABLE [FAILURES]]
#
# PROGRAM is the built `robustness`; TABLE is robustness.md unless given, FAILURES, one in a line, are in robustness_failures.txt.
# CGAL_DATA_DIR names the folder that holds CGAL's meshes/. From the environment too: GROUPS_TO_RUN (default: all), TIME_LIMIT
# (seconds of one group in one mode, default 600), OMP_NUM_THREADS and OPENBLAS_NUM_THREADS (default 1).

source "$(dirname "$0")/../lib/tables.sh"

check_number_of_arguments 1 3 "$@"
program=$(realpath "$1")
table=${2:-robustness.md}
failures=${3:-robustness_failures.txt}
folder_of_meshes > /dev/null || exit

"$program" --header > "$table"
messages=$failures
: > "$failures"
for group in ${GROUPS_TO_RUN:-$("$program" --list)}; do
  for mode in when-needed always; do
    TIME_LIMIT=${TIME_LIMIT:-600} add_rows "$group | $mode" "$program" "$group" "$mode"
    [ $? != 1 ] || printf '| %s | %s | cannot be run |\n' "$group" "$mode" >> "$table"
  done
done
