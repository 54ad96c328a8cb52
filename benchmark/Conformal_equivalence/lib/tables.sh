# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the scripts that write tables share. Each of them begins with its usage as a comment, and: source "$(dirname "$0")/../lib/tables.sh"

set -u

# One thread unless threads are the subject, so that processor seconds can be compared.
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OPENBLAS_NUM_THREADS=${OPENBLAS_NUM_THREADS:-1}

# check_number_of_arguments LEAST MOST "$@": prints the usage, which is the comment at the head of the script, and exits if there are others.
check_number_of_arguments()
{
  local least=$1 most=$2
  shift 2
  if [ $# -lt "$least" ] || [ $# -gt "$most" ]; then
    awk '/^$/ { exit } NR > 4' "$0" | sed 's/^# \{0,1\}//' >&2
    exit 2
  fi
}

# folder_of_meshes: that of CGAL's meshes
folder_of_meshes()
{
  echo "${CGAL_DATA_DIR:?must name the folder that holds CGAL\'s meshes/}/meshes"
}

# add_rows NAME COMMAND...: what the command prints is added to $table within TIME_LIMIT seconds, its messages to the file $messages if there is
# one; if it does not come to its end, a row says so. Returns its exit status: of 1 and 2 (no mesh, one of another kind, an exception) each program has its own opinion.
add_rows()
{
  local name=$1 status=0
  shift
  timeout "${TIME_LIMIT:-300}" "$@" >> "$table" 2>> "${messages:-/dev/null}" || status=$?
  if [ $status = 124 ]; then
    printf '| %s | out of time |\n' "$name" >> "$table"
  elif [ $status -gt 2 ]; then
    printf '| %s | crashed |\n' "$name" >> "$table"
  fi
  return $status
}
