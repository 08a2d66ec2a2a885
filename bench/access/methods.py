"""The methods of the access bench: each encodes a light field at a PSNR and tells what regions of it cost."""

import json
import subprocess
import time
from dataclasses import dataclass, field as member

import coders
import haar
import vq
from light_field import load, squared_error
from process import BenchError, run, run_measured
from regions import Cost, means, pairs, pixels, whole_pictures
from regions import regions as regions_of

NEAR = 0.05  # dB above the target that are near enough
AS_VQ = "extended-as-vq"  # at the PSNR that vector quantisation reaches
MAIN = ("main", "rlfc", "mc")
CRF = [half / 2 for half in range(90, 8, -1)]
PARAMETERS = {  # in order of rising PSNR
    "jpeg": range(5, 97), "jpeg2000": [2 * 1.05**step for step in range(100, -1, -1)], "x265-intra": CRF, "x265-inter": CRF,
}
JPEG_444 = {"format": "JPEG", "optimize": True, "subsampling": 0}


@dataclass
class Result:
    """bytes of the file, its PSNR over RGB in dB, CPU seconds of all threads (decode: None where nothing is timed), and
    of each region the costs [cold, warm]."""

    bytes: int
    psnr: float
    encode: float
    decode: float | None
    regions: dict = member(default_factory=dict)


def search(encode, parameters, target):
    """(encode(p), p) for the first of `parameters`, which are in order of rising PSNR, that reaches `target` dB; the last
    one if none does. encode: gives a tuple that begins with the PSNR."""
    low, high = 0, len(parameters) - 1
    found = None
    while low <= high:
        middle = (low + high) // 2
        got = encode(parameters[middle])
        if got[0] >= target:
            found, high = (got, parameters[middle]), middle - 1
            if got[0] < target + NEAR:
                break
        else:
            low = middle + 1
    return found or (encode(parameters[-1]), parameters[-1])


def hmlfc(name, field, target, options, work):
    """HMLFC in both profiles, and RLFC and MC, made from the tools of profile main."""
    stream = work / f"{name}.hmlfc"
    coding = ["--profile", "main", "--method", "hmlfc" if name == "main" else name] if name in MAIN else []
    best, refusal = None, None
    for chroma in ("420", "444") if name in MAIN else (None,):
        arguments = [*coding, *(["--chroma", chroma] if chroma else [])]
        command = [options.hmlfc, "encode", field.folder, "-o", stream, "--no-rig", "--json", *arguments]
        try:
            report = json.loads(run([*command, "--target-psnr", target])[0])
        except BenchError as error:  # chroma of half size limits the PSNR
            refusal = error
            continue
        if best is None or report["bytes"] < best[0]["bytes"]:
            best = report, stream.read_bytes()
    if best is None:
        raise refusal
    report, content = best
    stream.write_bytes(content)
    requests = regions_of(field)
    lines = "\n\n".join("\n".join(" ".join(str(n) for rect in request for n in rect) for request in both)
                        for asked in requests.values() for both in asked)
    done = subprocess.run([options.bench, stream], input=lines, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise BenchError(done.stderr.strip())
    told = json.loads(done.stdout)
    costs = iter([Cost(**cost) for cost in told["requests"]])
    return Result(len(content), report["psnr_rgb"], report["cpu_seconds"], told["decode_seconds"],
                  {region: means([(next(costs), next(costs)) for _ in asked]) for region, asked in requests.items()})


def pictures(name, field, target, options, work):
    """The codecs of the rate-distortion bench that code whole pictures: alone, or as a video. JPEG also gets 4:4:4."""
    parameters, encode = PARAMETERS[name], coders.make(name, field, None, options, work)

    def one(parameter):
        _, size, psnr, seconds = encode(parameter)
        return psnr, size, seconds, encode.picture_bytes

    (psnr, size, seconds, picture_bytes), _ = search(one, parameters, target)
    if name == "jpeg":
        encode = coders.pictures("quality", lambda quality: {**JPEG_444, "quality": quality}, field)
        full, _ = search(one, parameters, target)
        if full[0] >= target and (psnr < target or full[1] < size):
            psnr, size, seconds, picture_bytes = full
    order = field.serpentine() if name.startswith("x265") else list(range(field.rows * field.cols))
    costs = pairs(field, lambda: whole_pictures(field, picture_bytes, order, name != "x265-inter"))
    return Result(size, psnr, seconds, None, costs)


def grid_of(field):
    return field.views.reshape(field.rows, field.cols, *field.views.shape[1:])


def measured(field, encode, parameters, target, views):
    """(file, PSNR, CPU s of the encoding, CPU s of the decoding) of the parameter that search() finds. views(file): uint8
    views."""

    def one(parameter):
        began = time.process_time()
        file = encode(parameter)
        middle = time.process_time()
        decoded = views(file)
        end = time.process_time()
        return field.psnr(squared_error(grid_of(field), decoded)), file, middle - began, end - middle

    (psnr, file, encoding, decoding), _ = search(one, parameters, target)
    return file, psnr, encoding, decoding


def quantisation(_, field, target, options, __):
    """Vector quantisation: cold, the whole file is read and its entropy coding undone; warm, the file is not read."""
    words = [2**bits for bits in range(4, 12)]

    def coded(tile, parameters):
        return measured(field, lambda count: vq.encode(grid_of(field), tile, count), parameters, target,
                        lambda file: vq.Layer(file).views())

    large = coded(vq.TILES[0], words[-1:])
    file, psnr, *seconds = coded(vq.TILES[large[1] < target], words)
    layer = vq.Layer(file)

    def open_client():
        unread = [len(file)]

        def request(rectangles):
            samples = 3 * sum(1 for _ in pixels(rectangles))
            return Cost(unread.pop(), samples + layer.held, layer.held) if unread else Cost(0, samples, layer.held)

        return request

    return Result(len(file), psnr, *seconds, pairs(field, open_client))


def wavelet(_, field, target, __, ___):
    """The 4D Haar wavelet. What was read is kept; a node takes 15 details of two bytes in memory."""
    steps = [round(4095 / 1.06**i) for i in range(108) if 4095 / 1.06**i >= haar.LEAST_STEP]
    views = grid_of(field)

    def psnr_of(step):
        return (field.psnr(squared_error(views, haar.views_of(haar.quantised(views, step), views.shape[:4], step))),)

    _, step = search(psnr_of, steps, target)
    file, psnr, *seconds = measured(field, lambda step: haar.encode(views, step), [step], target,
                                    lambda file: haar.Reader(file).views())

    def open_client():
        reader = haar.Reader(file)

        def request(rectangles):
            read, samples = reader.bytes, reader.samples
            for place in pixels(rectangles):
                reader.pixel(*place)
            return Cost(reader.bytes - read, reader.samples - samples, 30 * reader.samples // 16)

        return request

    return Result(len(file), psnr, *seconds, pairs(field, open_client))


def pleno(_, field, target, options, work):
    """A program of the user around the reference software of JPEG Pleno, whose options differ by version. Called as
    PROGRAM VIEWS STREAM DECODED LAMBDA: encodes the folder VIEWS of 8-bit CCC_RRR.ppm to the file STREAM with this Lagrange
    multiplier, and decodes it to files of the same names in the folder DECODED."""
    views, stream, decoded, back = (work / name for name in ("pleno", "views.jpl", "pleno-decoded", "pleno-back"))
    run([options.hmlfc, "convert", field.folder, views, "--to", "pleno"])

    def one(multiplier):
        decoded.mkdir(exist_ok=True)
        _, cost = run_measured([options.pleno, views, stream, decoded, multiplier])
        if not stream.is_file():
            raise BenchError(f"{options.pleno} wrote no file {stream.name}")
        run([options.hmlfc, "convert", decoded, back, "--from", "pleno"])
        error = sum(map(squared_error, field.views, load("decoded", back).views))
        for folder in (decoded, back):
            for path in folder.iterdir():
                path.unlink()
        return field.psnr(error), stream.stat().st_size, cost.cpu_seconds

    (psnr, size, seconds), _ = search(one, [2**bits for bits in range(24, -1, -1)], target)
    return Result(size, psnr, seconds, None, {})


METHODS = {
    "extended": hmlfc, "main": hmlfc, "rlfc": hmlfc, "mc": hmlfc,
    "vq": quantisation, AS_VQ: hmlfc, "haar": wavelet,
    "x265-intra": pictures, "x265-inter": pictures, "jpeg": pictures, "jpeg2000": pictures,
    "pleno": pleno,
}
