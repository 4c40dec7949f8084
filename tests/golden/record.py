"""Records scenes with the portable kernels, which run on every processor: python3 record.py HEML SCENE.json RECORDING.jsonl

Hashes of single nodes, nearly all of the bytes, are left out: checkpoints compare whole states.
"""
import json
import pathlib
import subprocess
import sys
import tempfile


def record(program, scene, to):
    with tempfile.TemporaryDirectory() as folder:
        recording = pathlib.Path(folder) / "recording.jsonl"
        subprocess.run([program, "replay", scene, "--record", recording, "--instructions", "portable"], check=True)
        lines = [json.loads(line) for line in recording.read_text().splitlines()]
    for line in lines:
        line.pop("nodes", None)
    pathlib.Path(to).write_text("".join(json.dumps(line) + "\n" for line in lines))


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    record(*sys.argv[1:])
