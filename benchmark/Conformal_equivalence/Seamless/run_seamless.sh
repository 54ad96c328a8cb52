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

set -u

if [ $# -lt 1 ]; then
  sed -n '5,11s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
program=$(realpath "$1")
table=${2:-seamless.md}
shift
[ $# -gt 0 ] && shift
meshes=${CGAL_DATA_DIR:?must name the folder that holds CGAL\'s meshes/}/meshes
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

"$program" --header > "$table"
for mesh in "$meshes"/*.off; do
  timeout "${TIME_LIMIT:-300}" "$program" "$@" "$mesh" >> "$table" 2> /dev/null
  [ $? -eq 124 ] && printf '| %s | out of time |\n' "$mesh" >> "$table"
done
exit 0
