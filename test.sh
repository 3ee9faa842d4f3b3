#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds Release and runs the tests.
#   ./test.sh         all but the long ones (label slow)
#   ./test.sh --all   the long ones too
#   ./test.sh debug | sanitize | discrete   the same on another preset of CMakePresets.json
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
packages+=(chromium python3-meshio dpkg-dev clang-format) # the tests alone: they open report.html, read the ParaView files back, make a package
install_missing
build "$preset" all
ctest --test-dir build/"$preset" --output-on-failure -j "$(nproc)" "${select[@]}"
