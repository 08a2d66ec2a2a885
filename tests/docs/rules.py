"""What is run in place of a command of a document. A command that no rule matches runs as it stands.

Each rule is (pattern, replacement, reason). WORDS are replaced wherever they are found in a command; then
the first pattern of COMMANDS that matches all of it decides. Two replacements are special:

NAMED_ONLY  the command does not run: the usage of ./run has to name it
HELP        the pattern's first group runs with --help, whose text has to have every --option of the command

A rule that no document needs is an error.
"""

import re
from dataclasses import dataclass

NAMED_ONLY = object()
HELP = object()
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")


@dataclass(frozen=True)
class Rule:
    pattern: re.Pattern
    replacement: object
    reason: str


def rules(*rows):
    return [Rule(re.compile(pattern), replacement, reason) for pattern, replacement, reason in rows]


WORDS = rules(
    (r"--size (192x144|256x192|320x240|512x512)", "--size 64x48", "the smallest with the blocks that are named"),
    (r"--grid (1x101|17x17)", "--grid 9x9", "as many views as the sandbox has"),
    (r"--rect 64,32,128,96", "--rect 8,8,32,24", "inside the small views"),
    (r"--frames \d+", "--frames 2", "frames are alike"),
    (r"(fuzz-dut .*)--(minutes 60|count 100000)", r"\1--count 2", "minutes are its smallest unit"),
    (r"(minimise .*)--dut '[^']*'", r"""\1--dut 'sh -c "exit 1" {input} {output}' --trials 20""",
     "the decoder in the sandbox does not fail"),
    (r"--target-psnr 39 --profile main", "--target-psnr 25 --profile main", "what 4:2:0 reaches in the sandbox"),
    (r"vectors (\w+) ID", r"vectors \1 syntax/base-palettes", "a vector"),
    (r"\$\{\{ matrix\.preset \}\}", "asan", "one of the three"),
)

COMMANDS = rules(
    (r"\./run (demo|release|soak.*)", NAMED_ONLY, "runs for minutes"),
    (r"\./run (package|docs|sbom)", NAMED_ONLY, "tests of label release run it"),
    (r"\./run test( --require-all)?", NAMED_ONLY, "runs this test"),
    (r"(?:\./run test|ctest --test-dir \S+) (.*)", r"ctest --test-dir $BUILD -N \1 | grep 'Total Tests: [1-9]'", "lists the tests"),
    (r"cmake (?:--preset |--build build/)(\w+)(?: -D\S+| --target \w+)?", r"""cmake --list-presets | grep -F '"\1"'""", "a build takes minutes"),
    (r"cmake --install build/release --prefix \S+", "cmake --install $BUILD --prefix installed", "into the sandbox"),
    (r"(\./run (?:bench (?:access|accuracy|geometry|gpu|rate_distortion|remote|skipping|view)|coverage|rtl-coverage|stress|fuzz))( .*)?", HELP,
     "measures for minutes, or needs a build of its own"),
    (r"(\./run view) .*", HELP, "serves until Ctrl-C; viewer.command runs it"),
    (r"(\./run rtl-clocks)", HELP, "testbench.rtl_clocks runs it, for 16 seconds"),
    (r"(\./run rtl-random)( .*)?", HELP, "rtl_unit.Seed/Rtl runs the same on two seeds"),
    (r"(\./run rtl-bench)( .*)?", HELP, "testbench.rtl_bench runs it"),
    (r"(\./run synthesis)( (?:size|speed) .*)?", HELP, "rtl.speed measures a module; a whole run takes hours"),
    (r"(\./run fpga)( .*)?", HELP, "portable.debian_13_fpga runs it"),
    (r"(\./run clauses) .*", HELP, "writes into the repository"),
    (r"\./run vectors generate", r"\g<0> -o made", "writes into the repository"),
    (r"\./run render .*--camera .*", r"\g<0> >said && ! grep outside said", "the example's frame is filled"),
    (r"\./run compare .*", r"\g<0>; test $? = 1", "the views differ"),
    (r"(hmlfc conform) .*--(?:claim|verify) .*", HELP, "conform.claim runs both; the whole suite takes a minute"),
    (r"hmlfc conform .*--milestone tree .*", r"\g<0>; test $? = 1", "the decoder shows one level"),
    (r"(\./run|hmlfc) conform (?!.*--filter|.*--merge|.*--milestone)(.*--dut.*)",
     r"\1 conform --filter 'syntax/base-*' \2; test $? = 5", "the whole suite takes a minute"),
    (r"sim/.* \+fault=.*", r"\g<0>; test $? != 0", "a difference ends it"),
    (r"\./run conform .*-o out/planted", r"\g<0>; test $? = 5", "one vector alone is not the suite"),
    (r"(?:\./run|hmlfc) conform --merge .*", r"\g<0>; test $? = 5", "the shards have a part of the suite"),
    (r"\./run bench render", "./run bench | grep -w render", "measures for minutes; the list of benchmarks has it"),
)


def substitute(command, words=WORDS, table=COMMANDS):
    """(what to run, or NAMED_ONLY; the options that its output has to have; the rules used)."""
    used = [rule for rule in words if rule.pattern.search(command)]
    for rule in used:
        command = rule.pattern.sub(rule.replacement, command)
    for rule in table:
        match = rule.pattern.fullmatch(command)
        if match:
            used.append(rule)
            if rule.replacement is HELP:
                return f"{match[1]} --help", OPTION.findall(command), used
            made = rule.replacement
            return (made if made is NAMED_ONLY else match.expand(made)), [], used
    return command, [], used
