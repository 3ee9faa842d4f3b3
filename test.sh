#!/usr/bin/env bash
# Installs missing packages (Debian 12 or 13), builds Release and runs the tests.
#   ./test.sh         all but the long ones (label slow)
#   ./test.sh --all   the long ones too
#   ./test.sh discrete   the discrete panel without deal.II
#   ./test.sh debug      unit tests of discrete/, continuum/ and coupling/ with assertions of deal.II, Eigen and our own
#   ./test.sh sanitize   unit tests of discrete/ and coupling/ with address and undefined-behaviour sanitizers
#   ./test.sh thread     solver, stepping and panel under the thread sanitizer
#   ./test.sh fuzz [S]   fuzzers of scenes, tables and contact problems, S seconds each (60); their inputs are in build/fuzz/inputs
set -euo pipefail
cd "$(dirname "$0")"
source ./.build.sh

preset=release
select=(-LE slow)
seconds=60
for word in "$@"; do
  case "$word" in
    --all) select=() ;;
    release | debug | sanitize | discrete | thread | fuzz) preset=$word ;;
    [1-9]*) seconds=$word ;;
    *) echo "usage: ./test.sh [--all] [release|debug|sanitize|discrete|thread|fuzz [SECONDS]]" >&2; exit 2 ;;
  esac
done
targets=(all)
case "$preset" in
  debug) targets=(discrete_tests continuum_tests coupling_tests coupling_panel_tests)
         select+=(-R '^(discrete|continuum|coupling|coupling_panels)[.]') ;;
  sanitize) targets=(discrete_tests coupling_tests coupling_panel_tests)
            select+=(-R '^(discrete|coupling|coupling_panels)[.]') ;;
  thread) targets=(discrete_tests diptych)
          select+=(-R '^discrete[.](Solvers|Processes|StalledContacts|ManyPanels)$') ;;
  fuzz) targets=(fuzz_scene fuzz_table fuzz_problem)
        packages+=(clang) ;;
esac
# Only the tests need these packages. They open report.html, read the ParaView files, build a package and the manual, use the Python
# package and its notebooks, and solve cone programs.
packages+=(chromium python3-vtk9 dpkg-dev file clang-format mkdocs mkdocs-material man-db)
packages+=(python3-pytest python3-nbconvert python3-ipykernel python3-openturns python3-cvxopt)
install_missing
build "$preset" "${targets[@]}"
if [ "$preset" = fuzz ]; then
  # HDF5 allocates as much memory as a damaged file demands, then fails without using it. The fuzzer must allow that.
  fuzz_one() {
    local log=build/fuzz/$1.log inputs=build/fuzz/inputs/$1
    mkdir -p "$inputs"
    TIMEFORMAT="fuzz_$1: %U s of CPU time, and %S s in the system"
    time ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 "build/fuzz/tests/robustness/fuzz/fuzz_$1" -max_total_time="$2" -timeout=25 -rss_limit_mb=4000 -malloc_limit_mb=-1 \
      -print_final_stats=1 -artifact_prefix="build/fuzz/finding_$1_" "$inputs" "tests/robustness/fuzz/kept/$1" >"$log" 2>&1 ||
      { tail -n 50 "$log"; echo "fuzz_$1: finding in build/fuzz/finding_$1_*"; return 1; }
    echo "fuzz_$1: $(sed -n 's/stat::number_of_executed_units: *//p' "$log") inputs, no finding"
  }
  export -f fuzz_one
  printf '%s\n' scene table problem | xargs -P "$(cores)" -I '{}' bash -c "fuzz_one {} $seconds"
  exit 0
fi
# The thread sanitizer needs a process without address randomisation.
around=()
[ "$preset" != thread ] || around=(setarch "$(uname -m)" -R)
"${around[@]}" ctest --test-dir build/"$preset" --output-on-failure -j "$(cores)" "${select[@]}"
if [ "$preset" = thread ]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  for threads in 2 4; do
    "${around[@]}" build/thread/diptych discrete benchmarks/moreau_quick/scene.prm --set loading/axial_strain=0.005 --set comparison/window_edges=0,0.005 \
      --set output/report=false --threads $threads --output "$folder/$threads" --quiet
  done
  cmp "$folder/2/discrete.csv" "$folder/4/discrete.csv"
  echo "thread sanitizer: 2 and 4 threads, no report"
fi
