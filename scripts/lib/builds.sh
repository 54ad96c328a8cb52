# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds and runs of tests, shared by scripts/test and .ci/run. After lib/common.sh.

all_on=(-DCONFORMAL_EQUIVALENCE_WITH_{CHOLMOD,METIS,TBB,JSON}=ON)
all_off=(-DCONFORMAL_EQUIVALENCE_WITH_{CHOLMOD,METIS,TBB,JSON,BENCHMARK}=OFF) # used by name in scripts/test, as the other one

# configure NAME PRESET OPTION...: of a build in build/NAME; prints what was found
configure()
{
  local name="$1" preset="$2"
  shift 2
  mkdir -p "$build"
  local options=(-S "$root" --preset "$preset" -B "$build/$name" "-DCGAL_DATA_DIR=$(data_dir)")
  if [ ! -f "$build/$name/CMakeCache.txt" ] && command -v ninja > /dev/null; then
    options+=(-G Ninja)
  fi
  if command -v ccache > /dev/null; then
    options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    export CCACHE_SLOPPINESS=pch_defines,time_macros # as precompiled headers need it
  fi
  logged "$build/$name.configure.log" cmake "${options[@]}" "$@"
  sed -n 's/^-- Conformal_equivalence: /   /p' "$build/$name.configure.log"
}

# compile NAME [TARGET...]: with as many processes as the memory allows
compile()
{
  local name="$1"
  shift
  local memory=1700
  [[ "$name" != *sanitized* ]] || memory=2500
  local start=$SECONDS
  if [ $# -gt 0 ]; then
    set -- --target "$@"
  fi
  logged "$build/$name.build.log" cmake --build "$build/$name" -j "$(number_of_jobs $memory)" "$@"
  echo "   built $name in $((SECONDS - start)) s"
}

# run_tests NAME [OPTION OF CTEST...]
run_tests()
{
  local name="$1" status=0
  shift
  ctest --test-dir "$build/$name" -E '^(compilation|check.build)' --output-on-failure --no-tests=error \
    -j "$(number_of_jobs 1000)" "$@" 2>&1 | tee "$build/$name.ctest.log" || status=$?
  mkdir -p "$build/summaries"
  sed -n '/% tests passed/,$p' "$build/$name.ctest.log" > "$build/summaries/$name"
  return $status
}

# The summaries of CTest of all runs since `forget_summaries`.
forget_summaries() { rm -rf "$build/summaries"; }

print_summaries()
{
  local summary
  for summary in "$build"/summaries/*; do
    [ -f "$summary" ] || continue
    echo
    echo "CTest of $(basename "$summary"):"
    cat "$summary"
  done
}

# later_cgal_options SUITE: those that make CMake use the CGAL unpacked in build/later/SUITE
later_cgal_options()
{
  local usr="$build/later/$1/usr"
  echo "-DCMAKE_PREFIX_PATH=$usr"
  echo "-DCGAL_DIR=$(dirname "$(find "$usr/lib" -name CGALConfig.cmake -print -quit)")"
  echo "-DEigen3_DIR=$(dirname "$(find "$usr" -name Eigen3Config.cmake -print -quit)")"
}

# all_headers SUITE COMPILER: every public header in one program, built and run, with the
# CGAL of a later suite, or `installed`
all_headers()
{
  local suite="$1" compiler="$2" options=() name="headers-$1-$2"
  [ "$suite" = installed ] || mapfile -t options < <(later_cgal_options "$suite")
  configure "$name" test -DCMAKE_CXX_FLAGS_RELEASE=-O0 "-DCMAKE_CXX_COMPILER=$compiler" \
    -DCONFORMAL_EQUIVALENCE_BUILD_COMPILED_LIBRARY=OFF -DCONFORMAL_EQUIVALENCE_PRECOMPILE_HEADERS=OFF \
    ${options[@]+"${options[@]}"} > /dev/null
  logged "$build/$name.build.log" cmake --build "$build/$name" --target all_headers_once
  echo "   $compiler: $("$build/$name/all_headers_once")"
}

# all_headers_everywhere COMPILER...: against the installed CGAL, and against that of each
# later suite that the mirror offers
all_headers_everywhere()
{
  local suite compiler jobs job status=0
  "$root/scripts/fetch_later_cgal" | tee "$build/later.log"
  for suite in installed trixie sid; do
    [ $suite = installed ] || [ -f "$build/later/$suite/versions" ] || continue
    jobs=()
    for compiler; do
      all_headers $suite "$compiler" &
      jobs+=($!)
      if [ "$(number_of_jobs)" = 1 ]; then wait $! || status=1; fi
    done
    for job in "${jobs[@]}"; do
      wait "$job" || status=1
    done
  done
  return $status
}

# The tests that are worth most with sanitizers: those of what works on arrays of indices.
sanitized_core=(test_{normal_coordinates,common_refinement,Surface_locator,retriangulation,flatten_retriangulated,flatten_any_topology,compute_cut_graph,repair_locally,map_to_sphere,map_to_disk,Surface_correspondence,place_cones,compute_seamless_parameterization,fuzz_flatten_mesh})

# The compilers for sanitizers, of C++ and of C: those of clang where it has their libraries, as g++ takes half as long again with them and
# twice the memory. (Both, as CMake names precompiled headers in the way of the language that was enabled last.)
sanitizing_compilers()
{
  local program="$build/sanitizers"
  mkdir -p "$build"
  if clang++ -fsanitize=address,undefined -x c++ - -o "$program" <<< 'int main() {}' 2> /dev/null && "$program"; then
    echo clang++ clang
  else
    echo c++ cc
  fi
}

# sanitized_tests TESTS OPTION...: the tests named in one word, or, if it is empty, all that are not slow, with address and
# undefined-behaviour sanitizers
sanitized_tests()
{
  local tests="$1" only=() compilers name
  shift
  read -ra compilers <<< "$(sanitizing_compilers)"
  name="sanitized-${compilers[0]}"
  [ -z "$tests" ] || only=(-R "^($(echo "$tests" | tr ' ' '|'))\$")
  configure "$name" sanitized "-DCMAKE_CXX_COMPILER=${compilers[0]}" "-DCMAKE_C_COMPILER=${compilers[1]}" "$@"
  compile "$name" $tests
  CONFORMAL_EQUIVALENCE_SKIP_SLOW_TESTS=1 run_tests "$name" -L '^test$' ${only[@]+"${only[@]}"}
}
