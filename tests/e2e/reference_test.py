"""The reference pages are those that the program writes, and their examples run. HEML_BINARY names the program."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

BINARY = os.environ["HEML_BINARY"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGES = {"commands.md": SOURCE / "app/docs", "scene-format.md": SOURCE / "app/docs", "laws.md": SOURCE / "engine/docs"}


def heml(*arguments):
    return subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True, timeout=280)


def anchors(page):
    """As GitHub makes them of headings."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", page, flags=re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings}


class Reference(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_committed_pages_are_those_the_program_writes(self):
        done = heml("reference", "--out", self.folder / "pages")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(path.name for path in (self.folder / "pages").iterdir()), sorted(PAGES))
        for name, committed in PAGES.items():
            with self.subTest(name):
                self.assertEqual((self.folder / "pages" / name).read_bytes(), (committed / name).read_bytes(),
                                 f"write it anew: heml reference --out DIR, then copy {name} to {committed}")

    def test_links_of_the_pages_lead_somewhere(self):
        for name, folder in PAGES.items():
            text = (folder / name).read_text()
            for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"```.*?```", "", text, flags=re.S)):
                with self.subTest(page=name, target=target):
                    path, _, heading = target.partition("#")
                    page = (folder / path).resolve() if path else folder / name
                    self.assertTrue(page.is_file())
                    if heading:
                        self.assertIn(heading, anchors(page.read_text()))

    def test_every_command_of_the_help_is_on_the_page(self):
        page = (PAGES["commands.md"] / "commands.md").read_text()
        helped = heml("--help").stdout.split("Subcommands:")[1].split("Without a command")[0]
        names = re.findall(r"^  ([a-z-]+)\s", helped, re.M)
        self.assertIn("reference", names)
        for name in names:
            self.assertIn(f"\n## {name}\n", page)
            options = re.findall(r"^  (--[\w-]+)", heml(name, "--help").stdout, re.M)
            section = page.split(f"\n## {name}\n")[1].split("\n## ")[0]
            for option in set(options) - {"--help"}:
                self.assertIn(f"`{option}", section, name)

    def test_examples_of_scenes_run(self):
        examples = re.findall(r"```json\n(.*?)```", (PAGES["scene-format.md"] / "scene-format.md").read_text(), re.S)
        self.assertGreaterEqual(len(examples), 1)
        for k, example in enumerate(examples):
            scene = self.folder / f"example_{k}.json"
            scene.write_text(example)
            explained = heml("explain", scene)
            self.assertEqual(explained.returncode, 0, explained.stderr)
            out = self.folder / f"out_{k}"
            solved = heml("solve", scene, "--out", out)
            self.assertEqual((solved.returncode, solved.stderr), (0, ""))
            for file in ("positions.csv", "positions_0.csv", "report.json", "markers.csv", "history.csv"):
                self.assertTrue((out / file).is_file(), file)

    def test_a_folder_that_cannot_be_written_is_exit_3(self):
        (self.folder / "file").write_text("")
        done = heml("reference", "--out", self.folder / "file")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(done.stderr.count("error"), 1, done.stderr)
        self.assertIn("--out", done.stderr)
        self.assertEqual(heml("reference").returncode, 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
