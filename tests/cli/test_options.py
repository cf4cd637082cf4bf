"""Options that are wrong, contradict each other or would be ignored: one clear line and no trace."""

import unittest

import support
from small_files import GOOD


class BadOptions(support.CommandTest):
    def test_each_is_refused(self):
        self.write("a.obj", GOOD)
        pack = ("pack", "a.obj", "-o", "b.obj")
        for words, arguments in (
                (("subcommand",), ()),
                (("frob",), ("frob",)),
                (("input",), ("pack",)),
                (("--output",), ("pack", "a.obj")),
                (("extra",), (*pack, "extra")),
                (("--frob",), (*pack, "--frob")),
                (("--method",), (*pack, "--method", "guess")),
                (("--method",), (*pack, "--method")),
                (("--wrap",), (*pack, "--wrap", "w")),
                (("lprm02", "--wrap"), (*pack, "--method", "lprm02", "--wrap", "uv")),
                (("swg03", "--wrap"), (*pack, "--method", "swg03", "--wrap", "u")),
                (("zsgs04", "--wrap"), (*pack, "--method", "zsgs04", "--wrap", "v")),
                (("--export",), (*pack, "--export", "whole")),
                (("--stacked",), (*pack, "--stacked", "maybe")),
                (("--coverage",), (*pack, "--coverage", "most")),
                (("--rotation-base",), (*pack, "--rotation-base", "x")),
                (("--resolution",), (*pack, "--resolution", "0")),
                (("--resolution",), (*pack, "--resolution", "-5")),
                (("--resolution",), (*pack, "--resolution", "1x")),
                (("--resolution",), (*pack, "--resolution", "64x64x64")),
                (("--resolution",), (*pack, "--resolution", "65537")),
                (("--resolution",), (*pack, "--resolution", "99999999999")),
                (("--resolution",), (*pack, "--resolution", "1e3")),
                (("--aspect",), (*pack, "--aspect", "0:1")),
                (("--aspect",), (*pack, "--aspect", "wide")),
                (("--aspect",), (*pack, "--aspect", "1:")),
                (("--aspect",), (*pack, "--aspect", "nan:1")),
                (("--aspect",), (*pack, "--aspect", "1:1e9")),
                (("--aspect",), (*pack, "--aspect", "2:1", "--resolution", "64x32")),
                (("--aspect",), (*pack, "--aspect", "search", "--resolution", "64x32")),
                (("padding",), (*pack, "--padding", "-1")),
                (("padding",), (*pack, "--padding", "nan")),
                (("padding",), (*pack, "--padding", "1e9")),
                (("padding",), (*pack, "--padding", "two")),
                (("margin",), (*pack, "--margin", "nan")),
                (("margin",), (*pack, "--margin", "-1")),
                (("margin",), (*pack, "--margin", "1e9")),
                (("block",), (*pack, "--block", "0")),
                (("block",), (*pack, "--block", "65")),
                (("rotations",), (*pack, "--rotations", "0")),
                (("rotations",), (*pack, "--rotations", "100000")),
                (("grid",), (*pack, "--grid", "-1")),
                (("grid",), (*pack, "--grid", "1000000")),
                (("--texcoord",), (*pack, "--texcoord", "-1")),
                (("--threads",), (*pack, "--threads", "-1")),
                (("--seed",), (*pack, "--seed", "-1")),
                (("scale",), (*pack, "--scale-start", "0")),
                (("scale",), (*pack, "--scale-start", "1.5")),
                (("scale",), (*pack, "--scale-start", "nan")),
                (("lambda",), (*pack, "--lambda", "-1")),
                (("lambda",), (*pack, "--lambda", "nan")),
                (("input",), ("check",)),
                (("--wrap",), ("check", "a.obj", "--wrap", "x")),
                (("--padding",), ("check", "a.obj", "--padding", "-1")),
                (("padding",), ("check", "a.obj", "--padding", "nan")),
                (("--margin",), ("check", "a.obj", "--margin", "-1")),
                (("--resolution",), ("check", "a.obj", "--resolution", "none")),
                (("--tolerance",), ("check", "a.obj", "--tolerance", "-1")),
                (("input",), ("info",)),
                (("--texcoord",), ("info", "a.obj", "--texcoord", "99"))):
            with self.subTest(" ".join(arguments)):
                self.refuse(2, words, *arguments)

    def test_ranges_name_option_value_and_range(self):
        self.write("a.obj", GOOD)
        for command in (("pack", "a.obj", "-o", "b.obj"), ("check", "a.obj")):
            result = self.refuse(2, (), *command, "--padding", "70000")
            self.assertRegex(result.stderr, r"--padding 70000: out of range; give a number of "
                                            r"texels from 0 to \d+\n")
        result = self.refuse(2, (), "pack", "a.obj", "-o", "b.obj", "--rotations", "2.5")
        self.assertIn("--rotations 2.5: not a whole number; give", result.stderr)
        self.refuse(2, ("--padding 64:", "64 x 128"), "check", "a.obj", "--resolution", "64x128",
                    "--padding", "64")

    def test_what_would_be_ignored(self):
        self.write("a.obj", GOOD)
        pack = ("pack", "a.obj", "-o", "b.obj")
        for words, arguments in (
                (("--image-tiles:", "--image"), (*pack, "--image-tiles")),
                (("--image-size:", "--image"), (*pack, "--image-size", "64")),
                (("--image-tiles:", "wraps"), (*pack, "--image", "b.png", "--image-tiles", "--wrap",
                                               "none")),
                (("--texcoord 1:", "a.obj"), (*pack, "--texcoord", "1")),
                (("--texcoord 1:", "a.obj"), ("check", "a.obj", "--texcoord", "1")),
                (("--texcoord 1:", "a.obj"), ("info", "a.obj", "--texcoord", "1")),
                (("--margin:", "--wrap"), (*pack, "--margin", "3")),
                (("--margin:", "--wrap"), ("check", "a.obj", "--wrap", "uv", "--margin", "3")),
                (("--tolerance:", "--ref"), ("check", "a.obj", "--tolerance", "1")),
                (("--verbose:", "--quiet"), (*pack, "--quiet", "--verbose")),
                (("--verbose:", "--quiet"), ("check", "a.obj", "--quiet", "--verbose")),
                (("--all-sides:", "zsgs04"), (*pack, "--all-sides")),
                (("--seed:", "guided"), (*pack, "--method", "modulo", "--seed", "2")),
                (("--moves:", "pages", "--time"), (*pack, "--moves", "10", "--pages", "2")),
                (("--moves:", "pages", "--time"), (*pack, "--moves", "10", "--density", "2")),
                (("--all-sides:", "zsgs04"), (*pack, "--method", "swg03", "--all-sides")),
                (("--lambda:", "modulo"), (*pack, "--method", "zsgs04", "--lambda", "1")),
                (("--no-inner:", "modulo"), (*pack, "--method", "lprm02", "--no-inner")),
                (("--rotation-base:", "lprm02"), (*pack, "--method", "lprm02", "--rotation-base",
                                                  "box"))):
            with self.subTest(" ".join(arguments)):
                self.refuse(2, words, *arguments)


if __name__ == "__main__":
    unittest.main()
