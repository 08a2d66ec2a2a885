"""What is run in place of a command of a document. A command that no rule matches runs as it stands.

Each rule is (pattern, replacement, reason). WORDS are replaced wherever they are found in a command; then
the first pattern of COMMANDS that matches all of it decides. The pattern NAMED_ONLY as replacement:
the command does not run, ./run --help has to name it. A rule that no document needs is an error.
"""

import re
from dataclasses import dataclass

NAMED_ONLY = object()


@dataclass(frozen=True)
class Rule:
    pattern: re.Pattern
    replacement: object
    reason: str


def rules(*rows):
    return [Rule(re.compile(pattern), replacement, reason) for pattern, replacement, reason in rows]


WORDS = rules(
    (r"--size (192x144|256x192|320x240|512x512)", "--size 64x48", "the smallest with the blocks that are named"),
    (r"--rect 64,32,128,96", "--rect 8,8,32,24", "inside the small views"),
    (r"--frames \d+", "--frames 2", "frames are alike"),
    (r"(fuzz-dut .*)--minutes 60", r"\1--count 2", "minutes are its smallest unit"),
    (r"(minimise .*)--dut '[^']*'", r"""\1--dut 'sh -c "exit 1" {input} {output}' --trials 20""",
     "the decoder in the sandbox does not fail"),
)

COMMANDS = rules(
    (r"\./run (demo|soak .*)", NAMED_ONLY, "runs for minutes"),
    (r"\./run test", NAMED_ONLY, "runs this test"),
    (r"\./run test (.*)", r"ctest --test-dir $BUILD -N --no-tests=error \1", "lists the tests"),
    (r"\./run compare .*", r"\g<0>; test $? = 1", "the views differ"),
    (r"(\./run|hmlfc) conform (?!.*--filter|.*--merge)(.*--dut.*)", r"\1 conform --filter 'syntax/base-*' \2; test $? = 5",
     "the whole suite takes a minute"),
    (r"\./run conform .*faulty_decoder.*", r"\g<0>; test $? = 1", "it fails"),
    (r"\./run conform --merge .*", r"\g<0>; test $? = 5", "the shards have a part of the suite"),
    (r"\./run bench (methods)", r"./run bench \1 30 FOLDER", "a small light field"),
    (r"\./run (bench (?:accuracy|rate_distortion|skipping)|stress|fuzz)( .*)?", r"./run \1 --help",
     "measures for minutes, or needs a build of its own"),
)


def substitute(command, words=WORDS, table=COMMANDS):
    """(what to run or NAMED_ONLY, the rules used)."""
    used = [rule for rule in words if rule.pattern.search(command)]
    for rule in used:
        command = rule.pattern.sub(rule.replacement, command)
    for rule in table:
        match = rule.pattern.fullmatch(command)
        if match:
            made = rule.replacement
            return (made if made is NAMED_ONLY else match.expand(made)), [*used, rule]
    return command, used
