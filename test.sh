#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds Release and runs the tests.
#   ./test.sh         all but the long ones (label slow)
#   ./test.sh --all   the long ones too
#   ./test.sh discrete   all of the discrete panel alone (no deal.II)
#   ./test.sh debug      tests of units, in discrete/, continuum/ and coupling/, with assertions of deal.II, Eigen and our own
#   ./test.sh sanitize   tests of units, in discrete/ and coupling/, with address and undefined-behaviour sanitizers
set -euo pipefail
cd "$(dirname "$0")"
source ./.build.sh

preset=release
select=(-LE slow)
for word in "$@"; do
  case "$word" in
    --all) select=() ;;
    release | debug | sanitize | discrete) preset=$word ;;
    *) echo "usage: ./test.sh [--all] [release|debug|sanitize|discrete]" >&2; exit 2 ;;
  esac
done
targets=(all)
case "$preset" in
  debug) targets=(house_tests discrete_tests continuum_tests coupling_tests coupling_panel_tests)
         select+=(-R '^(house[.]House|discrete|continuum|coupling|coupling_panels)[.]') ;;
  sanitize) targets=(house_tests discrete_tests coupling_tests coupling_panel_tests)
            select+=(-R '^(house[.]House|discrete|coupling|coupling_panels)[.]') ;;
esac
# The tests alone: they open report.html, read the ParaView files back, make a package and the manual, use the Python package and
# run its notebooks.
packages+=(chromium python3-meshio dpkg-dev clang-format mkdocs mkdocs-material libjs-katex fish man-db)
packages+=(python3-pytest python3-pandas python3-scipy python3-nbconvert python3-ipykernel python3-mpi4py)
install_missing
build "$preset" "${targets[@]}"
ctest --test-dir build/"$preset" --output-on-failure -j "$(cores)" "${select[@]}"
