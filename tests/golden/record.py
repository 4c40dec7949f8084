"""Records scenes with the portable kernels, which run on every processor: python3 record.py HEML SCENE.json RECORDING.jsonl

A recording plays with the instructions that its first line names; so a recording of the scene is played again with "portable" there.
Hashes of single nodes, nearly all of the bytes, are left out: checkpoints compare whole states.
"""
import json
import pathlib
import subprocess
import sys
import tempfile


def lines_of(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def write(path, lines):
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))


def record(program, scene, to):
    with tempfile.TemporaryDirectory() as folder:
        first, second = (pathlib.Path(folder) / name for name in ("first.jsonl", "second.jsonl"))
        subprocess.run([program, "replay", scene, "--record", first], check=True)
        lines = lines_of(first)
        lines[0]["recorded"]["instructions"] = "portable"
        write(first, [line for line in lines if "checkpoint" not in line and "hash" not in line] +
              [{"step": lines[-1]["step"], "end": True}])
        subprocess.run([program, "replay", first, "--record", second], check=True)
        lines = lines_of(second)
        assert lines[0]["recorded"]["instructions"] == "portable"
        for line in lines:
            if "checkpoint" in line:
                line.pop("nodes", None)
        write(pathlib.Path(to), lines)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    record(*sys.argv[1:])
