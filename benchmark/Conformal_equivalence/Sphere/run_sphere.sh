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

set -u

full=
if [ "${1:-}" = --full ]; then
  full=1
  shift
fi
if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  sed -n '5,11s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
program=$(realpath "$1")
table=${2:-sphere.md}
meshes=${CGAL_DATA_DIR:?must name the folder that holds CGAL\'s meshes/}/meshes
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

"$program" --header > "$table"
for mesh in "$meshes"/*.off; do # what is no mesh, or of another kind, gives no row
  timeout "${TIME_LIMIT:-300}" "$program" "$mesh" >> "$table" 2> /dev/null
  case $? in
    0 | 1) ;;
    124) printf '| %s | out of time |\n' "$(basename "$mesh" .off)" >> "$table" ;;
    *) printf '| %s | crashed |\n' "$(basename "$mesh" .off)" >> "$table" ;;
  esac
done

if [ -n "$full" ]; then
  printf '\n' >> "$table"
  "$program" --time 1000000 >> "$table"
fi
