"""The documentation against the program: options, links and examples that are there."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.environ["WRAPATLAS"]
COMMANDS = ("unwrap", "pack", "simplify", "bake", "transfer", "render", "check", "info", "bench", "report")
COMMAND_LINE = r"wrapatlas (" + "|".join(COMMANDS) + r")\b([^`#&\n]*)"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "samples/README.md",
         ROOT / "tests/README.md", ROOT / "bench/README.md", ROOT / "bench/compare/README.md",
         *sorted((ROOT / "docs").rglob("*.md"))]


def options_of(command):
    text = subprocess.run([COMMAND, command, "--help"], capture_output=True, text=True,
                          check=True).stdout
    return set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", text))


def page_name(page):
    return str(page.relative_to(ROOT))


class Docs(unittest.TestCase):
    def test_commands_have_the_options_they_are_given(self):
        for page in PAGES:
            text = page.read_text(encoding="utf-8").replace("\\\n", " ")
            for sub, rest in re.findall(COMMAND_LINE, text):
                for option in re.findall(r"(?<!\S)(--?[a-z][a-z-]*)", rest):
                    with self.subTest(page=page_name(page), command=sub, option=option):
                        self.assertIn(option, options_of(sub))

    def test_options_named_in_the_text_exist(self):
        known = set().union(*map(options_of, COMMANDS))
        others = {"--help-all", "--wrapatlas"}  # of the command itself, of make_images.py
        for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
            text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.S)
            for code in re.findall(r"`([^`]+)`", text):
                if not code.startswith("--"):
                    continue
                for option in re.findall(r"(?<!\S)(--[a-z][a-z-]*)", code):
                    with self.subTest(page=page_name(page), option=option):
                        self.assertIn(option, known | others)

    def test_links_lead_somewhere(self):
        for page in PAGES:
            text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.S)
            for target in re.findall(r"\]\(([^)\s]+)\)", text):
                if re.match(r"[a-z]+:", target):
                    continue
                with self.subTest(page=page_name(page), link=target):
                    path = target.split("#")[0]
                    self.assertTrue(not path or (page.parent / path).exists())

    def test_the_example_of_the_readme_is_the_one_that_is_compiled(self):
        readme = (ROOT / "README.md").read_text(encoding="utf-8")
        source = (ROOT / "docs/examples/pack_file.cpp").read_text(encoding="utf-8")
        shown = re.search(r"```cpp\n(.*?)```", readme, re.S).group(1)
        self.assertTrue(source.startswith(shown))

    def test_every_key_of_the_reports_is_explained(self):
        """And no other is. A key inside an object stands with it or by itself."""
        page = (ROOT / "docs/reports.md").read_text(encoding="utf-8")
        sections = dict(re.findall(r"^## (\w+)\n(.*?)(?=^## |\Z)", page, re.S | re.M))
        with tempfile.TemporaryDirectory() as folder:
            packed = pathlib.Path(folder) / "packed.glb"
            sample = ROOT / "samples/coral.glb"
            unwrapped = pathlib.Path(folder) / "unwrapped.glb"
            picture = pathlib.Path(folder) / "one.png"
            render = ("render", sample, "--size", "32", "-o")
            subprocess.run([COMMAND, *render, picture], check=True, capture_output=True)
            for command, arguments in (("pack", (sample, "-o", packed, "--grid", "64")),
                                       ("unwrap", (sample, "-o", unwrapped, "--time", "0")),
                                       ("simplify", (sample, "-o", unwrapped, "--faces", "9%")),
                                       ("check", (packed, "--padding", "9")), ("info", (sample,)),
                                       (render[0], (*render[1:], packed.with_suffix(".png"),
                                                    "--compare", picture))):
                run = subprocess.run([COMMAND, command, *arguments, "--json", "-"],
                                     capture_output=True, text=True)
                report = json.loads(run.stdout)
                keys = set(report)
                for value in report.values():
                    value = value[0] if isinstance(value, list) and value else value
                    keys |= set(value) if isinstance(value, dict) else set()
                cells = re.findall(r"^\|(.*?)\|(.*)\|$", sections[command], re.M)
                named = {key for key, _ in cells for key in re.findall(r"`([\w.]+)`", key)}
                named = {part for key in named for part in key.split(".")}
                if command == "unwrap":
                    cells += re.findall(r"^\|(.*?)\|(.*)\|$", sections["pack"], re.M)
                told = {word for cell in cells for word in re.findall(r"`([\w.]+)`", cell[0] + cell[1])}
                told = {part for key in told for part in key.split(".")}
                with self.subTest(command):
                    self.assertEqual(keys - told, set())
                    self.assertEqual(named - keys, set())


if __name__ == "__main__":
    unittest.main()
