#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds Release and runs a comparison: both panels of one granular sample.
#   ./run.sh            benchmarks/moreau_1997
#   ./run.sh quick      benchmarks/moreau_quick
#   ./run.sh SCENE ...  any scene file, further arguments go to `diptych run`
set -euo pipefail
cd "$(dirname "$0")"
source ./.build.sh
install_missing
build release diptych

case "${1:-}" in
  "") set -- benchmarks/moreau_1997/scene.prm ;;
  quick) shift; set -- benchmarks/moreau_quick/scene.prm "$@" ;;
esac
exec build/release/diptych run "$@"
