#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Flattens meshes of many topologies among CGAL's, and writes tables in Markdown.
#
#   run_topology.sh [--full] PROGRAM [TABLE]
#
# PROGRAM is the built `topology`; TABLE is topology.md unless given. With --full, cuts of a million vertices
# are compared with factorizations, too (half a minute). CGAL_DATA_DIR names the folder that holds CGAL's meshes/. From the
# environment too: TIME_LIMIT (seconds of one process, default 300), OMP_NUM_THREADS and OPENBLAS_NUM_THREADS (default 1).

set -u

full=
if [ "${1:-}" = --full ]; then
  full=1
  shift
fi
if [ $# -lt 1 ] || [ $# -gt 2 ]; then
  sed -n '5,12s/^# \{0,1\}//p' "$0" >&2
  exit 2
fi
program=$(realpath "$1")
table=${2:-topology.md}
meshes=${CGAL_DATA_DIR:?must name the folder that holds CGAL\'s meshes/}/meshes
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

# run MESH [OPTION...]: one row
run()
{
  local mesh=$1
  shift
  timeout "${TIME_LIMIT:-300}" "$program" "$@" "$meshes/$mesh.off" >> "$table"
  case $? in
    0) ;;
    1) printf '| %s | cannot be run |\n' "$mesh" >> "$table" ;;
    124) printf '| %s | out of time |\n' "$mesh" >> "$table" ;;
    *) printf '| %s | crashed |\n' "$mesh" >> "$table" ;;
  esac
}

"$program" --header > "$table"
for mesh in armadillo bear bunny00 blobby dino fandisk homer elephant knot1 pinion; do
  run "$mesh"
done
run elephant --features 0.5
run knot1 --cones 2
run pinion --cones 2
run pinion --features 0.3
run turbine
run turbine --features 0.3
run cheese
run cheese --features 0.1
for mesh in lion holes mech-holes-shark blade head; do
  run "$mesh"
done

if [ -n "$full" ]; then
  printf '\n' >> "$table"
  "$program" --cut 1000000 >> "$table"
fi
