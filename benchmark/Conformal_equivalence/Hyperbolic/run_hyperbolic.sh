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

set -u

if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  sed -n '5,11s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
program=$(realpath "$1")
table=${2:-hyperbolic.md}
meshes=${CGAL_DATA_DIR:?must name the folder that holds CGAL\'s meshes/}/meshes
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

"$program" > "$table" # the head of the table
for mesh in "$meshes"/*.off plate:4000:3 plate:4000:5 plate:8000:9 plate:8000:13; do # what is of another kind gives no row
  timeout "${TIME_LIMIT:-300}" "$program" "$mesh" 2> /dev/null | tail -n +3 >> "$table"
  case ${PIPESTATUS[0]} in
    0) ;;
    124) printf '| %s | out of time |\n' "$(basename "$mesh" .off)" >> "$table" ;;
    *) printf '| %s | crashed |\n' "$(basename "$mesh" .off)" >> "$table" ;;
  esac
done
