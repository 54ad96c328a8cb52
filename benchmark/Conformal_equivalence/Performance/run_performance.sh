#!/usr/bin/env bash
# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Runs every method on every mesh, one process each, and writes a table in Markdown.
#
#   run_performance.sh [--full] PROGRAM [TABLE]
#
# PROGRAM is the built `performance`; TABLE is benchmark.md unless given. Without --full
# only meshes of up to 33 000 vertices, in about a minute; with it the disks among CGAL's meshes of at
# least 500 vertices, subdivided ones, and a terrain of a million. CGAL_DATA_DIR names the folder that
# holds CGAL's meshes/. From the environment too: METHODS, TIME_LIMIT (processor seconds of one process,
# default 600), MEMORY_LIMIT (GB of one process, default 8), OMP_NUM_THREADS and OPENBLAS_NUM_THREADS (default 1).

source "$(dirname "$0")/../lib/tables.sh"

full=
if [ "${1:-}" = --full ]; then
  full=1
  shift
fi
check_number_of_arguments 1 2 "$@"
program=$(realpath "$1")
table=${2:-benchmark.md}
meshes=$(folder_of_meshes) || exit
methods=${METHODS:-baseline ours ours-simplicial lscm arap dcm}
ulimit -S -t "${TIME_LIMIT:-600}"
ulimit -v $((${MEMORY_LIMIT:-8} * 1024 * 1024))

results=$(mktemp)
trap 'rm -f "$results"' EXIT

# run NAME MESH: all methods on one mesh. The lines of one run are those of the program,
# behind the name of the mesh and of the method.
run()
{
  local method vertices
  vertices=$("$program" "$2" check 2> /dev/null) || return
  vertices=$(awk '$1 == "vertices" { print $2 }' <<< "$vertices")
  [ "$vertices" -ge 500 ] || return
  for method in $methods; do
    printf '%s: %s\n' "$1" "$method" >&2
    {
      "$program" "$2" "$method" 2> /dev/null
      printf 'exit %d\n' $?
    } | sed "s/^/$1 $method /" >> "$results"
  done
}

if [ -n "$full" ]; then
  for mesh in "$meshes"/*.off; do
    run "$(basename "$mesh" .off)" "$mesh"
  done
else
  for name in three_peaks lion-head; do
    run "$name" "$meshes/$name.off"
  done
  run lion-head-Loop-1 "loop:1:0:$meshes/lion-head.off"
fi
run terrain-10k terrain:10000
if [ -n "$full" ]; then
  for noise in 0 0.05; do
    run "lion-head-Loop-2-noise-$noise" "loop:2:$noise:$meshes/lion-head.off"
    run "mannequin-Loop-2-noise-$noise" "loop:2:$noise:$meshes/mannequin-devil.off"
    run "mannequin-Loop-3-noise-$noise" "loop:3:$noise:$meshes/mannequin-devil.off"
  done
  run terrain-1M terrain:1000000
fi

awk '
function figure(key, format) { return (key in value) ? sprintf(format, value[key]) : "" }

# of two times, where they are long enough to be told from the ticks of the clock
function ratio(a, b) { return a > 0.05 && b > 0.05 ? sprintf("%.2f", a / b) : "" }

function baseline_row(ordering, key,    seconds)
{
  seconds = (key in value) ? value[key] : 0
  printf "| %s | %d | CHOLMOD, %s | %s | | | | | | %s | %s | | | | | | | |\n", mesh, value["vertices"], ordering,
         figure(key, "%.2f"), ratio(seconds, amd), ratio(seconds, metis)
}

# of a solve with flips: what was spent before they were found to be needed, as part of the rest
function discarded(    seconds)
{
  seconds = ("discarded_seconds" in value) ? value["discarded_seconds"] : 0
  return value["edges_flipped"] > 0 && seconds > 0 ? sprintf("%.2f", seconds / (value["solve_seconds"] - seconds)) : ""
}

function failure()
{
  if(!("status" in value))
    return value["exit"] == 152 ? "out of time" : "crashed"
  if(value["status"] == "ok")
    return ""
  sub(/^failed: /, "", value["status"])
  sub(/;.*/, "", value["status"])
  return value["status"]
}

function row(    status, seconds, own_amd)
{
  if(method == "")
    return
  if(method == "baseline")
  {
    amd = ("amd_seconds" in value) ? value["amd_seconds"] : 0
    metis = ("metis_seconds" in value) ? value["metis_seconds"] : 0
    baseline_row("AMD", "amd_seconds")
    baseline_row("METIS", "metis_seconds")
    return
  }
  # of the solve where it is known apart; of AMD what the same process measured, else that of the mesh
  seconds = ("solve_seconds" in value) ? value["solve_seconds"] : ("total_seconds" in value) ? value["total_seconds"] : 0
  own_amd = ("amd_seconds" in value) ? value["amd_seconds"] : amd
  status = failure()
  printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n",
         mesh, figure("vertices", "%d"), method, figure("total_seconds", "%.2f"), figure("import_seconds", "%.2f"),
         figure("solve_seconds", "%.2f"), discarded(), figure("layout_seconds", "%.2f"), figure("verify_seconds", "%.2f"),
         ratio(seconds, own_amd), ratio(seconds, metis), ("memory" in value) ? sprintf("%.0f", value["memory"] / 1e6) : "",
         figure("newton_steps", "%d"), figure("pcg_iterations", "%d"),
         status != "" ? status : figure("qc_mean", "%.5g"), figure("qc_max", "%.4g"), figure("flips", "%d"),
         figure("border_error", "%.1e")
}

BEGIN {
  print "| mesh | vertices | method | seconds | import | solve | discarded / rest | layout | verify | / AMD | / METIS | MB | steps | PCG | mean qc | max qc | flips | border error |"
  print "|---|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|"
}
$1 != mesh || $2 != method {
  row()
  if($1 != mesh)
    amd = metis = 0
  mesh = $1
  method = $2
  for(key in value)
    delete value[key]
}
{
  key = $3
  text = $0
  sub(/^[^ ]+ [^ ]+ [^ ]+ /, "", text)
  value[key] = text
}
END { row() }
' "$results" > "$table"
