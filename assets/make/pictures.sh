#!/usr/bin/env bash
# Draws assets/pictures/scenes: a frame of each scene, in seconds of its own time.
#   bash assets/make/pictures.sh path/to/heml
set -euo pipefail
heml=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT
while read -r scene seconds; do
  "$heml" capture "scenes/$scene.json" --out "$frames/$scene" --frames 2 --fps "$(awk "BEGIN {print 1 / $seconds}")" --size 480x270
  cp "$frames/$scene/frame_00001.png" "pictures/scenes/$scene.png"
done <<'END'
kidney_grasp 0.5
kidney_pull 1.1
kidney_adapted 1.1
uterus 0.3
liver_cut 1.8
test_bench 2
beam_duel 0.5
thin_stretch 1.5
twist 1.5
brain_block 0.5
cantilever 0.5
cube 0.5
irregular_cube 0.5
large_cube 0.2
kidney_on_table 1.6
kidney_on_pad 1.4
strip_tears 2.1
energy_law 0.5
ventricle 0.32
END
