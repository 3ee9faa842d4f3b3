#!/usr/bin/env bash
# Installs missing packages (Debian 12 or 13), builds Release and compares both panels of one granular sample.
#   ./run.sh            benchmarks/moreau_1997: about 5 minutes on a fresh machine with two cores, 1.2 once it is built
#   ./run.sh quick      benchmarks/moreau_quick: less than a minute once it is built
#   ./run.sh SCENE ...  any scene file; passes further arguments to `diptych run`
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
