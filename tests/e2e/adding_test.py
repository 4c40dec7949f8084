"""The code that engine/docs/adding.md shows is the program's own: every block is found in a source file.

    python3 tests/e2e/adding_test.py
"""
import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGE = SOURCE / "engine" / "docs" / "adding.md"


def squeezed(text):
    return re.sub(r"\s+", "", text)


class AddingTest(unittest.TestCase):
    def setUp(self):
        files = [p for folder in ("engine", "app") for ending in ("*.hpp", "*.cpp") for p in (SOURCE / folder).rglob(ending)]
        self.sources = {p: squeezed(p.read_text()) for p in files if "third_party" not in p.parts}

    def test_every_code_block_is_in_a_source_file(self):
        blocks = re.findall(r"```cpp\n(.*?)```", PAGE.read_text(), re.S)
        self.assertGreater(len(blocks), 8)
        for block in blocks:
            with self.subTest(block=block.strip().splitlines()[0]):
                self.assertTrue(any(squeezed(block) in text for text in self.sources.values()), block)

    def test_every_named_file_exists(self):
        for path in re.findall(r"`([a-z_]+/[a-z_/0-9]+\.(?:hpp|cpp|py|json))`", PAGE.read_text()):
            if path == "materials/my_law.hpp":
                continue
            places = [SOURCE / path, SOURCE / "engine" / path, SOURCE / "engine" / "heml" / path]
            with self.subTest(path=path):
                self.assertTrue(any(p.exists() for p in places), path)


if __name__ == "__main__":
    unittest.main()
