import pathlib
import re
import subprocess
import sys

import heml


def test_the_self_check_passes():
    run = subprocess.run([sys.executable, "-m", "heml"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert heml.__version__ in run.stdout and "passed" in run.stdout


def test_import_is_quick_and_loads_no_numpy():
    program = "import sys, time; t = time.perf_counter(); import heml; print(time.perf_counter() - t, 'numpy' in sys.modules)"
    best = min(float(subprocess.run([sys.executable, "-c", program], capture_output=True, text=True).stdout.split()[0])
               for _ in range(5))
    assert best < 0.2


def test_import_leaves_the_environment_alone():
    program = "import os; before = dict(os.environ); import heml; print(before == os.environ)"
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True).stdout == "True\n"


def test_the_stub_has_every_name_of_the_module():
    stub = pathlib.Path(heml.__file__).with_suffix(".pyi").read_text()
    told = set(re.findall(r"(?:def|class) (\w+)|^(__version__)|\b\w+ as (\w+)", stub, re.MULTILINE))
    told = {name for names in told for name in names if name}
    assert set(heml.__all__) <= told
    for owner in (heml.Scene, heml.Snapshot, heml.World, heml.Batch):
        missing = {name for name in vars(owner) if not name.startswith("_")} - told
        assert not missing, (owner, missing)


def test_what_is_not_there_is_an_attribute_error():
    assert not hasattr(heml, "no_such_thing")


def test_every_method_has_its_help():
    for owner in (heml.Scene, heml.Snapshot, heml.World, heml.Batch):
        for name, member in vars(owner).items():
            if not name.startswith("_") and name != "name":
                assert member.__doc__, f"{owner.__name__}.{name}"
