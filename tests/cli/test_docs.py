"""The documentation against the program: options, links and examples that are there."""

import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMAND = os.environ["WRAPATLAS"]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "samples/README.md",
         ROOT / "tests/README.md", *sorted((ROOT / "docs").rglob("*.md"))]


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
            for sub, rest in re.findall(r"wrapatlas (pack|check|info)\b([^`#\n]*)", text):
                for option in re.findall(r"(?<!\S)(--?[a-z][a-z-]*)", rest):
                    with self.subTest(page=page_name(page), command=sub, option=option):
                        self.assertIn(option, options_of(sub))

    def test_options_named_in_the_text_exist(self):
        known = options_of("pack") | options_of("check") | options_of("info")
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


if __name__ == "__main__":
    unittest.main()
