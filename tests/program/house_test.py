# diptych: how the sources look: formatted, no file and no function above what CONTRIBUTING.md allows
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from running import content, SOURCE, write

FOLDERS = ("discrete", "continuum", "coupling", "tests", "benchmarks")


def sources(*endings):
    trees = (tree for top in FOLDERS for tree in os.walk(os.path.join(SOURCE, top)))
    return sorted(os.path.join(folder, name) for folder, _, names in trees for name in names if name.endswith(endings))


def allowed(pattern):
    """The numbers that CONTRIBUTING.md states."""
    text = " ".join(content(os.path.join(SOURCE, "CONTRIBUTING.md")).decode().split())
    return [int(number) for number in re.search(pattern, text).groups()]


# Take six or seven arguments: kernels that are called for every contact, wrappers of the HDF5 library, constructors of
# what is made from plain data. No other function may.
MANY_ARGUMENTS = {"write_attribute", "write_array", "apply_law", "solve_sampled", "sweep_psor", "add_squares",
                  "sweep_batches",
                  "local_solution", "relative_velocity", "RecordedContinuum", "record", "pack_rectangle", "Course",
                  "BoundaryValueProblem"}
CONTROL = re.compile(r"(if|for|while|else|do|switch|try|catch|namespace|struct|class|enum|union|extern)\b")


def functions(path):
    """(lines of the body, arguments, line, head) of every function of a formatted source; lists of keys and numbers,
    which call a visitor line by line, left out."""
    lines = content(path).decode().split("\n")
    for k, line in enumerate(lines):
        brace = re.fullmatch(r"( *)\{", line)
        if not brace or k == 0:
            continue
        first = k - 1
        while first > 0 and lines[first].startswith(brace[1] + " "):
            first -= 1
        head = " ".join(part.strip() for part in lines[first:k])
        if not lines[first].startswith(brace[1]) or CONTROL.match(head) or "(" not in head:
            continue
        if re.search(r"\b(visit_|list_)\w*\(", head):
            continue
        end = k + 1
        while not lines[end].startswith(brace[1] + "}"):
            end += 1
        plain = head
        while re.search(r"<[^<>]*>", plain):
            plain = re.sub(r"<[^<>]*>", "", plain)
        listed = re.search(r"\w\s*\(((?:[^()]|\([^()]*\))*)\)", plain)
        words = re.sub(r"\([^()]*\)", "", listed[1]).strip() if listed else ""
        yield end - k - 1, words.count(",") + 1 if words else 0, k, head


HEADS = re.compile(r"((if|for|while|switch) *(constexpr )?@\s*|(else|do)\b\s*|case [\w:@]+:\s+|default:\s+)*")
CHAIN = re.compile(r"(\+\+|--|\*)?[\w:]+((\.|->)\w+|[@$])*(\+\+|--)?(\s*[-+*/%|&^]?=[^=,][^,]*)?,")
# Strings, comments and directives; then what holds no brackets any more: lambdas, blocks, arguments, lists, indices,
# types.
PLAIN = re.compile(r'//.*|^ *#.*|"(\\.|[^"\\\n])*"|\'(\\.|[^\'\\\n])+\'', re.MULTILINE)
INSIDE = r"[^(){}\[\]]*"
INNERMOST = re.compile(fr"(\[{INSIDE}\]|\$)\s*(\({INSIDE}\)|@)?\s*(mutable\s*)?(->\s*[\w:]+\s*)?\{{{INSIDE}\}}|"
                       fr"\{{{INSIDE}\}}|\({INSIDE}\)|\[{INSIDE}\]|<[\w:\s,*&@]*>")


def chained(text):
    """The statements of a source that join several by commas, like `a = 1, b = 2;`. Reduces the text from the inside:
    indices and captures to `$`, arguments, lists of values and lambdas to `@`, other blocks to `;`."""
    found = []

    def reduced(match):
        if match[0].endswith("}") and ";" in match[0]:
            statements = [HEADS.sub("", part.strip(), count=1)
                          for part in match[0][match[0].index("{") + 1:-1].split(";")]
            found.extend(" ".join(statement.split()) for statement in statements if CHAIN.match(statement))
            return ";" if match[0][0] == "{" else "@"
        return {"<": "", "[": "$" if match[0].endswith("]") else "@"}.get(match[0][0], "@")

    text, count = PLAIN.sub(lambda match: "@" if match[0][0] in "\"'" else "", text), 1
    while count:
        text, count = INNERMOST.subn(reduced, text)
    return found


def repeated_namespaces(text):
    """How many unnamed namespaces follow another one beside them: those of one indent have one enclosing namespace."""
    indents = re.findall(r"^( *)namespace$", text, re.MULTILINE)
    return len(indents) - len(set(indents))


class House(unittest.TestCase):
    def test_no_file_is_longer_than_allowed(self):
        most, = allowed(r"One idea a file \(about \d+ lines, (\d+) at most\)")
        files = sources(".h", ".cc", ".py", ".js")
        self.assertGreater(len(files), 300)
        long = {os.path.relpath(path, SOURCE): content(path).count(b"\n") for path in files}
        self.assertEqual({path: lines for path, lines in long.items() if lines > most}, {})

    def test_no_function_is_longer_or_takes_more_than_allowed(self):
        most_lines, = allowed(r"functions of about \d+ lines \((\d+) at most")
        found = [(os.path.relpath(path, SOURCE), *function) for path in sources(".h", ".cc")
                 if not os.path.relpath(path, SOURCE).startswith("tests") for function in functions(path)]
        self.assertGreater(len(found), 1500)
        self.assertGreater(max(lines for _, lines, *_ in found), most_lines // 2)
        self.assertEqual([one for one in found if one[1] > most_lines], [])
        many = {re.search(r"(\w+)\s*\(", re.sub(r"<[^<>]*>", "", head))[1]: arguments
                for _, _, arguments, _, head in found if arguments > 5}
        self.assertLessEqual(set(many), MANY_ARGUMENTS)
        self.assertLessEqual(max(many.values()), 7)
        with tempfile.TemporaryDirectory() as work:  # it can fail
            path = write(os.path.join(work, "long.cc"), "int f(const A<int, B> a,\n      int b)\n{\n" + "  ++a;\n" * 70
                         + "}\n")
            self.assertEqual([function[:2] for function in functions(path)], [(70, 2)])

    def misformatted(self, files):
        words = ["clang-format", "--style=file:" + os.path.join(SOURCE, ".clang-format"), "--dry-run", *files]
        told = subprocess.run(words, capture_output=True, text=True, check=True).stderr
        return sorted(set(re.findall(r"^(\S+?):\d+:\d+: warning", told, re.MULTILINE)))

    def test_every_source_is_formatted(self):
        if shutil.which("clang-format") is None:
            self.skipTest("clang-format is not installed (test.sh installs it)")
        version = subprocess.run(["clang-format", "--version"], capture_output=True, text=True, check=True).stdout
        if " 14." not in version:
            self.skipTest("other versions than 14 (Debian 12) format a few lines differently: " + version.strip())
        files = sources(".h", ".cc")
        self.assertGreater(len(files), 300)
        self.assertEqual(self.misformatted(files), [])
        with tempfile.TemporaryDirectory() as work:  # it can fail
            ugly = write(os.path.join(work, "ugly.cc"), "int  main( ){return 0;}\n")
            self.assertEqual(self.misformatted([ugly]), [ugly])

    def test_every_statement_stands_alone_and_a_file_has_one_unnamed_namespace(self):
        texts = {os.path.relpath(path, SOURCE): content(path).decode() for path in sources(".h", ".cc")}
        texts = {path: text for path, text in texts.items() if path.startswith(FOLDERS[:3])}
        self.assertGreater(len(texts), 300)
        self.assertEqual([(path, chained(text)) for path, text in texts.items() if chained(text)], [])
        self.assertEqual([path for path, text in texts.items() if repeated_namespaces(text)], [])
        # It can fail.
        calls = "void f()\n{\n  for (int i = 0, j = 1; i < j; ++i, --j)\n    a[i] = g(i, j), h->b(i);\n}\n"
        self.assertEqual(chained(calls), ["a$ = g@, h->b@"])
        self.assertEqual(chained("void f()\n{\n  run([&] { ++n, m += 2; }, 3);\n}\n"), ["++n, m += 2"])
        self.assertEqual(chained("void f()\n{\n  std::map<int, int> a = {{1, 2}}, b;\n  m << 1, 2;\n}\n"), [])
        self.assertEqual(repeated_namespaces("namespace\n{\n}\n\nnamespace\n{\n}\n"), 1)
        self.assertEqual(repeated_namespaces("namespace\n{\n  namespace\n  {\n  }\n}\n"), 0)
