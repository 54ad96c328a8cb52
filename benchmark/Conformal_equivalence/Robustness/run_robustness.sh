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

set -u

if [ $# -lt 1 ] || [ $# -gt 3 ]; then
  sed -n '5,11s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
program=$(realpath "$1")
table=${2:-robustness.md}
failures=${3:-robustness_failures.txt}
: "${CGAL_DATA_DIR:?must name the folder that holds CGAL\'s meshes/}"
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

"$program" --header > "$table"
: > "$failures"
for group in ${GROUPS_TO_RUN:-$("$program" --list)}; do
  for mode in when-needed always; do
    timeout "${TIME_LIMIT:-600}" "$program" "$group" "$mode" >> "$table" 2>> "$failures"
    case $? in
      0) ;;
      1) printf '| %s | %s | cannot be run |\n' "$group" "$mode" >> "$table" ;;
      124) printf '| %s | %s | out of time |\n' "$group" "$mode" >> "$table" ;;
      *) printf '| %s | %s | crashed |\n' "$group" "$mode" >> "$table" ;;
    esac
  done
done
