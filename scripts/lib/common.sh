# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the scripts share. Each of them begins with: source "$(dirname "$0")/lib/common.sh"

set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
build="${CONFORMAL_EQUIVALENCE_BUILD_DIR:-$root/build}"

say()  { printf '%s\n' "$*" >&2; }
fail() { say "$(basename "$0"): $*"; exit 1; }

# section TITLE: a heading, with the time that the section before has taken
section()
{
  end_section
  printf '\n==== %s\n' "$*"
  section_title="$*"
  section_start=$SECONDS
}

end_section()
{
  if [ -n "${section_title:-}" ]; then
    printf -- '---- %s: %d s (%d s since the start)\n' "$section_title" $((SECONDS - section_start)) "$SECONDS"
    section_title=
  fi
}

# as_root COMMAND...: runs it as root, by sudo if need be
as_root()
{
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo > /dev/null; then
    sudo "$@"
  else
    say "This needs root and there is no sudo. Run as root:"
    say "  $*"
    return 1
  fi
}

# logged LOG COMMAND...: runs it, with its output in LOG, which is shown if it fails
logged()
{
  local log="$1" status=0
  shift
  mkdir -p "$(dirname "$log")"
  "$@" > "$log" 2>&1 || status=$?
  if [ $status != 0 ]; then
    say "failed ($status): $*"
    cat "$log" >&2
    say "failed ($status): $* (output above, in $log)"
    return $status
  fi
}

# the number of compilers to run at once: one a core, and one for each 2 GB (or $1 MB) of free memory
number_of_jobs()
{
  local each=$((${1:-2000} * 1024)) cores memory jobs
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)
  for limit in /sys/fs/cgroup/memory.max /sys/fs/cgroup/memory/memory.limit_in_bytes; do
    if [ -r $limit ] && grep -q '^[0-9]\{1,15\}$' $limit && [ $(($(cat $limit) / 1024)) -lt "$memory" ]; then
      memory=$(($(cat $limit) / 1024))
    fi
  done
  jobs=$((memory / each))
  [ $jobs -ge 1 ] || jobs=1
  [ $jobs -le "$cores" ] || jobs=$cores
  echo "${CONFORMAL_EQUIVALENCE_JOBS:-$jobs}"
}

# apt_get COMMAND...: apt-get without questions, waiting for another apt to finish
apt_get()
{
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=600 "$@"
}

# has_apt: whether this is a system of Debian's kind
has_apt() { command -v apt-get > /dev/null && command -v dpkg-query > /dev/null; }

# is_offered PACKAGE: whether the configured mirrors have it, as far as is known here
is_offered()
{
  local policy
  policy="$(apt-cache policy "$1" 2> /dev/null)"
  grep -q 'Candidate: [^(]' <<< "$policy"
}

# the folder that holds meshes/, of the environment or our own
data_dir() { echo "${CGAL_DATA_DIR:-$build/data}"; }

# public_headers: their names as one includes them, sorted
public_headers()
{
  (cd "$root/include" && find CGAL -name '*.h' -not -path '*/internal/*' | LC_ALL=C sort)
}
