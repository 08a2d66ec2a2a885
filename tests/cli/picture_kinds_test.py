"""Views as phones and other programs write them are read as Pillow reads them, or refused with the reason."""

import numpy as np
from PIL import Image, ImageCms, ImageOps
from program import INPUT, CliTest, main

ORIENTATION = 0x0112


def photo():
    """Smooth colours with an edge, of sides that no block of 8 or 16 divides."""
    y, x = np.mgrid[0:45, 0:61]
    samples = np.stack([4 * x, 5 * y, 255 - 2 * (x + y)], axis=2)
    samples[:, 30:] //= 2
    return Image.fromarray(samples.astype(np.uint8))


def exif(orientation):
    data = Image.Exif()
    data[ORIENTATION] = orientation
    return data.tobytes()


class PictureKinds(CliTest):
    def views(self, name, picture, **options):
        """A new folder that holds `picture` alone, as 00_00 with the extension of `name`."""
        folder = self.folder / name
        folder.mkdir()
        picture.save(folder / f"00_00{folder.suffix}", **options)
        return folder / f"00_00{folder.suffix}"

    def same_as_pillow(self, name, picture, note="", **options):
        with self.subTest(name=name):
            file = self.views(name, picture, **options)
            result = self.run_hmlfc("picture", "view", name, "--view", "0,0", "-o", "picture.png")
            told = result.stderr.decode()
            self.assertEqual(result.returncode, 0, told)
            self.assertEqual(len(told.splitlines()), 1 if note else 0, told)
            self.assertIn(note, told)
            expected = Image.open(file)
            if expected.format != "TIFF":  # which Pillow turns when it loads it
                expected = ImageOps.exif_transpose(expected)
            expected = expected.convert("RGB")
            ours = np.asarray(Image.open(self.folder / "picture.png"), np.int16)
            self.assertEqual(ours.shape, (expected.height, expected.width, 3))
            self.assertLessEqual(np.abs(ours - np.asarray(expected, np.int16)).max(), 1)

    def test_phones(self):
        srgb = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
        for orientation in range(1, 9):
            note = f"orientation {orientation} is applied" if orientation > 1 else ""
            for ending in "jpg", "png", "webp":
                data = {"exif": exif(orientation), "icc_profile": srgb}
                self.same_as_pillow(f"turned-{orientation}.{ending}", photo(), note, **data)
            tags = {ORIENTATION: orientation}
            self.same_as_pillow(f"turned-{orientation}.tif", photo(), note, tiffinfo=tags)
        gain_map = photo().convert("L").reduce(4)
        self.same_as_pillow("two.mpo.jpg", photo(), "what follows the end", format="MPO", save_all=True,
                            append_images=[gain_map])  # fmt: skip
        lab = ImageCms.ImageCmsProfile(ImageCms.createProfile("LAB")).tobytes()
        self.same_as_pillow("other.jpg", photo(), "colour profile is not applied", icc_profile=lab)

    def test_programs(self):
        grey, alpha = photo().convert("L"), photo().convert("RGBA")
        alpha.putalpha(128)
        for progressive in False, True:
            for subsampling in range(3):
                self.same_as_pillow(f"{progressive}-{subsampling}.jpe", photo(), format="JPEG", quality=90,
                                    progressive=progressive, subsampling=subsampling)  # fmt: skip
        self.same_as_pillow("grey.jfif", grey, format="JPEG")
        for quality in 30, 90:
            self.same_as_pillow(f"{quality}.webp", photo(), quality=quality)
        self.same_as_pillow("lossless.webp", photo(), lossless=True)
        self.same_as_pillow("alpha.webp", alpha, "alpha channel", lossless=True, exact=True)
        for compression in "raw", "tiff_lzw", "tiff_adobe_deflate", "packbits", "jpeg":
            self.same_as_pillow(f"{compression}.tiff", photo(), compression=compression)
        self.same_as_pillow("grey.tiff", grey, compression="tiff_lzw")
        self.same_as_pillow("alpha.tiff", alpha, "alpha channel")
        self.same_as_pillow("ycbcr.tiff", photo().convert("YCbCr"), compression="jpeg")
        for mode in "1", "L", "LA", "P", "RGBA":
            picture, note = (alpha, "alpha channel") if mode[-1] == "A" else (photo(), "")
            self.same_as_pillow(f"{mode}.png", picture.convert(mode), note)
        self.same_as_pillow("clear.png", grey, "tRNS", transparency=0)

    def test_refusals(self):
        moving = {"save_all": True, "append_images": [photo().rotate(90)]}
        for name, picture, says, options in (
            ("moving.webp", photo(), "an animation; not supported", moving),
            ("print.jpg", photo().convert("CMYK"), "CMYK", {}),
            ("print.tif", photo().convert("CMYK"), "PhotometricInterpretation 5", {}),
            ("float.tif", photo().convert("F"), "SampleFormat 3", {}),
            ("bitmap.tif", photo().convert("1"), "1 bits a pixel", {}),
            ("palette.tif", photo().convert("P"), "PhotometricInterpretation 3", {}),
        ):
            with self.subTest(name=name):
                file = self.views(name, picture, **options)
                message = self.refused(INPUT, "picture", "view", name, "--view", "0,0", "-o", "no.png", says=says)
                self.assertIn("not supported", message)
                self.assertIn(str(file.relative_to(self.folder)), message)


if __name__ == "__main__":
    main()
