#!/usr/bin/env bash
# Installs what is missing, builds heml, and opens the default scene. Arguments go to heml:
#   bash app/start.sh                     the default scene; without a display, pictures of it
#   bash app/start.sh run my_liver.obj    your own
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$top/app/packages.sh"

install_missing "${build_packages[@]}" "${run_packages[@]}"
(cd "$top" && build release --target heml)
say "heml ${*:-run}"
exec "$top/build/release/app/heml" "$@"
