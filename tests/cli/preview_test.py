"""render --preview as GIF and MP4, through a stand-in for the program ffmpeg."""

import os

from program import DONE, OUTPUT, ROOT, USAGE, CliTest, main


class Preview(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene flat --grid 3x3 --size 40x30 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc".split())

    def environment(self, program=None):
        """A PATH on which ffmpeg is `program`, or there is none."""
        folder = self.folder / f"bin-{program.name if program else 'none'}"
        folder.mkdir(exist_ok=True)
        if program and not (folder / "ffmpeg").exists():
            (folder / "ffmpeg").symlink_to(program)
        return dict(os.environ, PATH=f"{folder}:/usr/bin:/bin" if program else str(folder))

    def stand_in(self):
        return self.environment(ROOT / "tests/support/ffmpeg")

    def fails(self, script):
        program = self.folder / "failing"
        program.write_text(f"#!/bin/sh\n[ $1 = -version ] || {{ {script}; }}\n")
        program.chmod(0o755)
        return self.environment(program)

    def made(self, output, preview, *arguments, note=b""):
        """The arguments of the stand-in for ffmpeg."""
        ran = self.run_hmlfc("render", "a.hmlfc", "-o", output, "--preview", preview, "--force", *arguments, env=self.stand_in())
        self.assertEqual((ran.returncode, ran.stderr), (DONE, note))
        self.assertEqual([name for name in os.listdir(self.folder) if "partial" in name], [])
        return (self.folder / preview).read_text().splitlines()

    def test_gif_and_mp4(self):
        path = "--path orbit --frames 3".split()
        gif = self.made("or%dbit", "orbit.gif", *path)
        self.assertIn("file:or%%dbit/frame_%04d.png", gif)
        self.assertIn("trim=end_frame=3,split[a][b];[a]palettegen[p];[b][p]paletteuse", gif)
        self.assertEqual(gif[gif.index("-f", gif.index("-vf")) + 1], "gif")
        mp4 = self.made("orbit", "orbit.MP4", *path)
        self.assertIn("file:orbit/frame_%04d.png", mp4)
        self.assertEqual(mp4[mp4.index("-f", mp4.index("-vf")) + 1], "mp4")
        # The folder has a fourth frame of a longer path, which is left out.
        self.made("orbit", "longer.mp4", *"--path orbit --frames 4".split())
        note = b"orbit: 1 other picture stays there, of an earlier result perhaps\n"
        self.assertEqual(self.made("orbit", "orbit.MP4", *path, note=note)[:-1], mp4[:-1])
        one = self.made("one%d.png", "one.gif")
        self.assertIn("file:one%d.png", one)
        self.assertEqual(one[one.index("-frames:v") + 1], "1")

    def test_refused_before_a_frame_is_drawn(self):
        def refused(preview, says, **options):
            self.refused(USAGE, "render", "a.hmlfc", "-o", "no.png", "--preview", preview, says=says, **options)
            self.assertFalse((self.folder / "no.png").exists())

        refused("no.mp4", says=["no.mp4", "ffmpeg", "*.png"], env=self.environment())
        refused("no.avi", says=["no.avi", "*.mp4"])
        refused("nowhere/no.gif", says="nowhere", env=self.stand_in())

    def test_what_fails_leaves_the_old_file(self):
        (self.folder / "old.gif").write_text("old")
        for script, says in [
            ('for last; do :; done; echo half >"${last#file:}"; echo no such codec >&2; exit 7', ["exit status 7", "no such codec"]),
            ("kill -9 $$", ["signal 9"]),
            ("exit 0", ["old.gif"]),
        ]:
            with self.subTest(script=script):
                arguments = ["render", "a.hmlfc", "-o", "one.png", "--preview", "old.gif", "--force"]
                self.refused(OUTPUT, *arguments, says=["old.gif", *says], env=self.fails(script))
                self.assertEqual((self.folder / "old.gif").read_text(), "old")
                self.assertEqual([name for name in os.listdir(self.folder) if "partial" in name], [])


if __name__ == "__main__":
    main()
