"""Running out of memory is an error with a message, not the end of the world, and no damage."""

import resource
import shutil

from program import DONE, INPUT, OUT_OF_MEMORY, ROOT, CliTest, main

MEBIBYTE = 1 << 20
STEPS = 40


def limited(mebibytes):
    """What limits the address space of the program."""
    size = int(mebibytes * MEBIBYTE)
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (size, size))


class Memory(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene knights --grid 3x3 --size 128x96 -o views".split())
        for profile in ("extended", "main"):
            cls.hmlfc("encode", "views", "-o", f"{profile}.hmlfc", "--profile", profile)

    def test_one_view(self):
        options = "--scene flat --grid 1x1 --size 32768x32768 --threads 1 -o views".split()
        self.refused(
            OUT_OF_MEMORY, "synth", *options, preexec_fn=limited(1024), says="Not enough memory"
        )

    def least(self):
        """MiB with which the program begins: below, the system does not load it."""
        return next(
            size
            for size in range(8, 1024)
            if self.run_hmlfc("--version", preexec_fn=limited(size)).returncode == DONE
        )

    def enough(self, command, output, least):
        """MiB with which `command` succeeds, at most twice as many as it needs."""
        size = least
        while self.run_hmlfc(*command, "-o", output, preexec_fn=limited(size)).returncode != DONE:
            self.forget(output)
            size *= 2
        self.forget(output)
        return size

    def forget(self, output):
        path = self.folder / output
        if path.is_dir():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)

    def content(self, output):
        path = self.folder / output
        files = sorted(path.iterdir()) if path.is_dir() else [path]
        return [(file.name, file.read_bytes()) for file in files]

    def sweep(self, output, *command):
        """At each of STEPS limits the command gives what it gives with enough, or status 71."""
        self.hmlfc(*command, "-o", output)
        expected = self.content(output)
        self.forget(output)
        least = self.least()
        step = (self.enough(command, output, least) - least) / STEPS
        seen = set()
        for i in range(STEPS):
            result = self.run_hmlfc(*command, "-o", output, preexec_fn=limited(least + i * step))
            message = f"{least + i * step:.1f} MiB: {result.stderr.decode()}"
            self.assertIn(result.returncode, (DONE, OUT_OF_MEMORY), message)
            if result.returncode == DONE:
                self.assertEqual(self.content(output), expected, message)
            seen.add(result.returncode)
            self.forget(output)
        self.assertIn(OUT_OF_MEMORY, seen)

    def test_decode(self):
        self.sweep("all", "decode", "extended.hmlfc")
        self.sweep("all", "decode", "main.hmlfc", "--threads", "1")

    def test_render(self):
        self.sweep("frame.png", "render", "extended.hmlfc")

    def test_encode(self):
        self.sweep("again.hmlfc", "encode", "views")

    def test_convert(self):
        """The output is an argument of its own, no option."""
        least = self.least()
        seen = set()
        for i in range(STEPS):
            seen.add(self.run_hmlfc("convert", "views", "copy.hmlfc", preexec_fn=limited(least + i)).returncode)
            self.forget("copy.hmlfc")
        self.assertEqual(seen, {DONE, OUT_OF_MEMORY})

    def test_reference_area(self):
        self.sweep("area", "reference-area", "extended.hmlfc")

    def test_json(self):
        """Of a suite, and of a camera path that is refused."""
        frames = ['{"fov": 40}'] * 100000 + ['{"x": 1}']
        (self.folder / "path.json").write_text("[" + ",".join(frames) + "]")
        least = self.least()
        for expected, *command in (
            (DONE, "vectors", "list", "--suite", str(ROOT / "vectors")),
            (INPUT, "render", "extended.hmlfc", "--path", "path.json", "-o", "frames"),
        ):
            seen = {
                self.run_hmlfc(*command, preexec_fn=limited(least + 2 * i)).returncode for i in range(STEPS)
            }
            self.assertEqual(seen, {expected, OUT_OF_MEMORY}, command)


if __name__ == "__main__":
    main()
