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

set -u

if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  sed -n '5,10s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
program=$(realpath "$1")
table=${2:-quality.md}
meshes=${CGAL_DATA_DIR:?must name the folder that holds CGAL\'s meshes/}/meshes

"$program" --header > "$table"
for mesh in "$meshes"/*.off; do
  for method in ours lscm arap dcm; do
    timeout "${TIME_LIMIT:-300}" "$program" "$mesh" "$method" >> "$table" 2> /dev/null
    case $? in
      0) ;;
      1 | 2) break ;; # cannot be read, or is no disk
      124) printf '| %s | | %s | out of time | | | | | | | |\n' "$(basename "$mesh" .off)" "$method" >> "$table" ;;
      *) printf '| %s | | %s | crashed | | | | | | | |\n' "$(basename "$mesh" .off)" "$method" >> "$table" ;;
    esac
  done
done
