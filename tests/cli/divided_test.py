"""encode --memory, --plan, --shard, --assemble: the bytes of one encoding, in bounds, from many machines."""

import json
import os
import resource
import shutil

from program import DONE, INPUT, OUTPUT, PROGRAM, USAGE, CliTest, main

MEBIBYTE = 1 << 20
BOUND = 48
FAST = "--preset fast --references 4x4".split()


def limit_files():
    """The child cannot make a file longer than a kilobyte."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024))


class Divided(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 9x8 --size 60x44 -o views".split())
        cls.hmlfc("encode", "views", "-o", "whole.hmlfc", *FAST)
        cls.hmlfc("encode", "views", "-o", "job.json", "--plan", *FAST)

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def shard(self, number, output, *options, plan="job.json"):
        self.hmlfc("encode", plan, "-o", output, "--shard", number, *options)

    def peak(self, *arguments):
        """Most bytes in memory during a run of hmlfc, as the kernel counts them."""
        child = os.posix_spawn(PROGRAM, [PROGRAM, *arguments], os.environ, file_actions=[
            (os.POSIX_SPAWN_OPEN, 1, "/dev/null", os.O_WRONLY, 0)])  # fmt: skip
        _, status, used = os.wait4(child, 0)
        self.assertEqual(os.waitstatus_to_exitcode(status), DONE)
        return used.ru_maxrss * 1024

    def test_the_bound_holds_for_any_number_of_views(self):
        peaks = {}
        for side in (12, 24):
            views, whole, part = (str(self.folder / f"{name}{side}") for name in ("large", "whole", "part"))
            self.hmlfc(*f"synth --scene cards --grid {side}x{side} --size 192x144 -o {views}".split())
            options = [*FAST, "--threads", "1"]
            unbounded = self.peak("encode", views, "-o", whole, *options)
            peaks[side] = self.peak("encode", views, "-o", part, *options, "--memory", f"{BOUND}M")
            self.assertEqual(self.bytes_of(part), self.bytes_of(whole))
            self.assertLessEqual(peaks[side], BOUND * MEBIBYTE)
        self.assertGreater(unbounded, BOUND * MEBIBYTE)
        self.assertLess(peaks[24], 1.25 * peaks[12])

    def test_a_bound_that_is_too_small_names_the_least(self):
        message = self.refused(INPUT, "encode", "views", "-o", "a.hmlfc", "--memory", "1M", *FAST,
                               says="the least that would do")  # fmt: skip
        least = message.split(" is the least")[0].split()[-1]
        self.hmlfc("encode", "views", "-o", "a.hmlfc", "--memory", least, *FAST)
        self.assertEqual(self.bytes_of("a.hmlfc"), self.bytes_of("whole.hmlfc"))

    def test_options_that_contradict_each_other(self):
        for options, says in [
            ("--memory 512M --target-psnr 40", "target"),
            ("--plan --max-bytes 1000", "target"),
            ("--plan --shard 1/2", "exclude"),
            ("--memory 5X", "512M"),
            ("--shard 3/2", "I/N"),
            ("--shard 1/2 --quality 50", "--quality is settled by the plan"),
        ]:
            with self.subTest(options=options):
                self.refused(USAGE, "encode", "views", "-o", "a.hmlfc", *options.split(), says=says)

    def test_a_full_disk_leaves_nothing(self):
        before = sorted(os.listdir(self.folder))
        for options in (["--memory", "64M"], ["--shard", "1/1"]):
            views = "job.json" if "--shard" in options else "views"
            self.refused(OUTPUT, "encode", views, "-o", "new", *options, preexec_fn=limit_files, says="too large")
            self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_shards_make_the_bytes_of_one_machine(self):
        for profile in (FAST, ["--profile", "main", "--height", "2"], ["--height", "2", *FAST], ["--lossless", "--views", "0..6:2,1..7"]):
            self.hmlfc("encode", "views", "-o", "one.hmlfc", *profile)
            self.hmlfc("encode", "views", "-o", "plan.json", "--plan", *profile)
            plan = json.loads((self.folder / "plan.json").read_text())
            # As planned; across the groups of the tree; each view alone.
            for division in ({}, {"row_ends": [1, 3], "col_ends": [1, 3, 6]}, {"row_ends": range(1, 9), "col_ends": range(1, 8)}):
                with self.subTest(profile=profile, division=division):
                    ends = {name: [end for end in some if end < plan[name][-1]] + plan[name][-1:] for name, some in division.items()}
                    (self.folder / "plan.json").write_text(json.dumps({**plan, **ends}))
                    names = [f"{i}.part" for i in (3, 1, 2)]
                    for name in names:
                        self.shard(f"{name[0]}/3", name, plan="plan.json")
                    self.hmlfc("encode", "plan.json", "-o", "many.hmlfc", "--assemble", *names)
                    self.assertEqual(self.bytes_of("many.hmlfc"), self.bytes_of("one.hmlfc"))

    def test_a_lost_shard_is_named_and_can_be_run_again(self):
        self.shard("1/2", "first")
        assemble = ["encode", "job.json", "-o", "late.hmlfc", "--assemble"]
        self.refused(INPUT, *assemble, "first", says="shards are missing: 2/2")
        self.assertFalse((self.folder / "late.hmlfc").exists())
        self.refused(INPUT, *assemble, "first", "first", says="first: its parts are also in a shard before")
        self.shard("2/2", "second")
        self.hmlfc(*assemble, "first", "second")
        self.assertEqual(self.bytes_of("late.hmlfc"), self.bytes_of("whole.hmlfc"))

    def test_shards_of_another_plan_or_version_are_refused(self):
        self.hmlfc("encode", "views", "-o", "other.json", "--plan", "--quality", "50", *FAST)
        self.shard("1/1", "good")
        self.shard("1/1", "other", plan="other.json")
        good = self.bytes_of("good")
        line = good.index(b"\n", good.index(b"{"))
        version = b'"version":"%s"' % json.loads(good[good.index(b"{") : line])["version"].encode()
        for name, bytes_ in [
            ("version", good.replace(version, b'"version":"9.9.9"', 1)),
            ("damaged", good[:-9] + bytes([good[-9] ^ 1]) + good[-8:]),
            ("cut", good[:-1]),
            ("longer", good + b"x"),
            ("head", good[: line - 4]),
            ("empty", b""),
            ("number", good.replace(b'"of":1', b'"of":4294967295', 1)),
            ("stream", self.bytes_of("whole.hmlfc")),
        ]:
            (self.folder / name).write_bytes(bytes_)
        for name, says in [
            ("other", "another plan"), ("version", "9.9.9"), ("damaged", "damaged"), ("cut", "damaged"),
            ("longer", "damaged"), ("head", "damaged"), ("empty", "not a shard"), ("stream", "not a shard"), ("number", "damaged"),
        ]:  # fmt: skip
            with self.subTest(name=name):
                self.refused(INPUT, "encode", "job.json", "-o", "a.hmlfc", "--assemble", name, says=[name, says])

    def test_a_plan_keeps_to_its_views_and_version(self):
        shutil.copytree(self.folder / "views", self.folder / "moved")
        self.hmlfc("encode", "moved", "-o", "moved.json", "--plan", *FAST)
        plan = (self.folder / "moved.json").read_text()
        version = json.loads(plan)["version"]
        for name, text, says in [
            ("version.json", plan.replace(f'"version": "{version}"', '"version": "9.9.9"'), "9.9.9"),
            ("field.json", plan.replace('"row_ends"', '"rows"'), "a damaged plan"),
            ("kind.json", plan.replace('"window": 64', '"window": "a"'), "a damaged plan"),
            ("text.json", "views", "not a plan"),
        ]:
            (self.folder / name).write_text(text)
            self.refused(INPUT, "encode", name, "-o", "a.part", "--shard", "1/2", says=[name, says])
        with (self.folder / "moved/03_03.png").open("ab") as view:
            view.write(b"x")
        self.refused(INPUT, "encode", "moved.json", "-o", "a.part", "--shard", "1/2", says="are not those of the plan")


if __name__ == "__main__":
    main()
