#!/usr/bin/env bash
# Installs what is missing, builds heml and tests it. Ends with the tests that failed and how many passed.
#   bash tests/run.sh           all: release; address and undefined behaviour sanitizers and fuzzers; thread sanitizer; engine alone
#   bash tests/run.sh --quick   release alone
#   bash tests/run.sh --long    all, five minutes a fuzzer, thirty for whole scenes; recordings of whole scenes
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$top"
source app/packages.sh

presets=(release address thread smallest)
fuzz_seconds=20 world_fuzz_seconds=100
studies=OFF  # and laws, under sanitizers: many minutes
# What a preset leaves out but for --long: under sanitizers, cases that take minutes there and repeat others for every
# law, command or size; of the engine alone, what does not change without the program and the helpers for surfaces.
declare -A selection=(
  [address]='-E ^world:.?(snapshot:.(every|quadratic)|step.rescue:.blocks|undo:.(the.same|restores|what.is)|history:.every|two.hundred|a.thousand|self-contact:.(two.boxes|at.1)|quadratic.contact:.(a.stack|boxes|a.cut|at.1|the.same)|recovery:.of.every|cautery:.a.free|capstan|vibration)|^scenario:.?(a.recording.of.every.element|a.surface.is.filled|a.tissue.that.is.given|the.wanted.number|the.estimate.is)|^mesh:.?(cut:.a.stroke|burn:.a.long)|^mend:.?(meshing.anew.keeps|what.has.no.volume)'
  [smallest]='-R ^(assets|base|floors|install|mesh|scenario|session): -E ^scenario:.?a.recording.of.every.element'
)
case "${1:-}" in
  '') ;;
  --quick) presets=(release) ;;
  --long)
    fuzz_seconds=300 world_fuzz_seconds=1800 selection=() studies=ON
    export HEML_LONG=1 HEML_FUZZ_CASES=1000000000 HEML_WORLD_FUZZ_CASES=1000000000 ;;
  *) fail "usage: bash tests/run.sh [--quick | --long]" ;;
esac

minutes() { printf '%d:%02d' $(($1 / 60)) $(($1 % 60)); }

# CMake splits lists at semicolons: ctest would look for halves of such a name, find none, and pass.
if grep -rnE 'TEST_CASE\("[^"]*;' tests; then fail "these names of tests hold a semicolon and would never run"; fi

install_missing "${build_packages[@]}" "${run_packages[@]}" "${test_packages[@]}"
# The same file compiled with the same flags is the same, whatever folder it is built in.
export CCACHE_BASEDIR=$top CCACHE_NOHASHDIR=1
# The Python module is part of the release build, for the Python of a venv that holds what its tests need.
python=build/venv/bin/python
if [[ " ${presets[*]} " == *" release "* ]]; then
  [[ -x $python ]] || python3 -m venv build/venv
  "$python" -m pip install -q --disable-pip-version-check nanobind numpy pytest || fail "pip could not install what the tests of the Python module need"
  cmake --preset release -DHEML_PYTHON=ON "-DPython_EXECUTABLE=$top/$python" >/dev/null
fi
results=() times=()
for preset in "${presets[@]}"; do
  start=$SECONDS
  cmake --preset "$preset" "-DHEML_SANITIZE_STUDIES=$studies" >/dev/null
  build "$preset" || fail "building $preset failed"
  built=$SECONDS
  say "testing $preset"
  results+=("build/$preset/results.xml")
  rm -f "${results[-1]}"
  # shellcheck disable=SC2086  # an option and its argument
  HEML_FUZZ_SECONDS=$fuzz_seconds HEML_WORLD_FUZZ_SECONDS=$world_fuzz_seconds \
    ctest --preset "$preset" -j "$(nproc)" --output-junit results.xml ${selection[$preset]:-} || true
  if [[ $preset == release ]]; then
    results+=("build/release/python-results.xml")
    rm -f "${results[-1]}"
    PYTHONPATH=build/release/python "$python" -m pytest -q tests/app/python --junitxml="${results[-1]}" || true
  fi
  times+=("$preset $(minutes $((built - start))) + $(minutes $((SECONDS - built)))")
done

say "$(minutes $SECONDS) min, build + tests: $(IFS=,; echo "${times[*]}")"
python3 tests/summary.py "${results[@]}"
