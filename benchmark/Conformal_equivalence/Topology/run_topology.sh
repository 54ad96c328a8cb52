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

source "$(dirname "$0")/../lib/tables.sh"

full=
if [ "${1:-}" = --full ]; then
  full=1
  shift
fi
check_number_of_arguments 1 2 "$@"
program=$(realpath "$1")
table=${2:-topology.md}
meshes=$(folder_of_meshes) || exit

# run MESH [OPTION...]: one row
run()
{
  local mesh=$1
  shift
  add_rows "$mesh" "$program" "$@" "$meshes/$mesh.off"
  [ $? != 1 ] || printf '| %s | cannot be run |\n' "$mesh" >> "$table"
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
