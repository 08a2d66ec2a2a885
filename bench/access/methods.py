"""The methods of the access bench: each encodes a light field at a PSNR and tells what regions of it cost."""

import time
from dataclasses import dataclass

import coders
import haar
import vq
from light_field import squared_error
from process import BenchError, bench_json, hmlfc_json
from regions import Cost, means, pairs, pixels, regions, whole_pictures

NEAR = 0.05  # dB above the target that are near enough
AS_VQ = "extended-as-vq"  # at the PSNR that vector quantisation reaches
MAIN = ("main", "rlfc", "mc")
CRF = [half / 2 for half in range(90, 8, -1)]
PARAMETERS = {  # in order of rising PSNR
    "jpeg": range(5, 97), "jpeg2000": [2 * 1.05**step for step in range(100, -1, -1)], "x265-intra": CRF, "x265-inter": CRF,
}


@dataclass
class Result:
    """bytes of the file, its PSNR over RGB in dB, CPU seconds of all threads (decode: None where nothing is timed), and
    costs, of each region the costs [cold, warm]."""

    bytes: int
    psnr: float
    encode: float
    decode: float | None
    costs: dict


def search(encode, parameters, target):
    """(p, encode(p)) for the first of `parameters`, which are in order of rising PSNR, that reaches `target` dB; the last
    one if none does. encode: gives a tuple that begins with the PSNR."""
    low, high = 0, len(parameters) - 1
    found = None
    while low <= high:
        middle = (low + high) // 2
        got = encode(parameters[middle])
        if got[0] >= target:
            found, high = (parameters[middle], *got), middle - 1
            if got[0] < target + NEAR:
                break
        else:
            low = middle + 1
    return found or (parameters[-1], *encode(parameters[-1]))


def hmlfc(name, field, target, work):
    """HMLFC in both profiles, and RLFC and MC, made from the tools of profile main."""
    coding = ["--profile", "main", "--method", "hmlfc" if name == "main" else name] if name in MAIN else []
    found, refusal = [], None
    for chroma in ("420", "444") if name in MAIN else (None,):
        stream = work / f"{name}-{chroma}.hmlfc"
        arguments = [*coding, *(["--chroma", chroma] if chroma else []), "--target-psnr", target]
        try:
            report = hmlfc_json("encode", field.folder, "-o", stream, "--no-rig", *arguments)
        except BenchError as error:  # chroma of half size limits the PSNR
            refusal = error
        else:
            found.append((report["bytes"], report, stream))
    if not found:
        raise refusal
    size, report, stream = min(found, key=lambda made: made[0])
    asked = regions(field)
    lines = "\n\n".join("\n".join(" ".join(str(n) for rect in request for n in rect) for request in both)
                        for places in asked.values() for both in places)
    told = bench_json("requests", stream, given=lines)
    costs = iter([Cost(**cost) for cost in told["requests"]])
    return Result(size, float(report["psnr_rgb"]), report["cpu_seconds"], told["decode_seconds"],
                  {region: means([(next(costs), next(costs)) for _ in places]) for region, places in asked.items()})


def pictures(name, field, target, work):
    """Codecs that code whole pictures: alone, or as a video. Of JPEG the better one of 4:2:0 and 4:4:4."""
    found = []
    for codec in ("jpeg", "jpeg-444") if name == "jpeg" else (name,):
        encode = coders.make(codec, field, None, work)

        def one(value, encode=encode):
            made = encode(value)
            return made.psnr, made

        _, psnr, made = search(one, PARAMETERS[name], target)
        found.append((psnr < target, made.bytes, made))
    made = min(found, key=lambda entry: entry[:2])[2]
    order = field.serpentine() if name.startswith("x265") else list(range(field.rows * field.cols))
    costs = pairs(field, lambda: whole_pictures(field, made.picture_bytes, order, name != "x265-inter"))
    return Result(made.bytes, made.psnr, made.encode_seconds, None, costs)


def quantisation(_, field, target, __):
    """Vector quantisation: cold, the whole file is read and its entropy coding undone; warm, the file is not read."""
    words = [2**bits for bits in range(4, 12)]

    def coded(tile, parameters):
        def one(count):
            begin = time.process_time()
            file = vq.encode(field.grid, tile, count)
            middle = time.process_time()
            views = vq.Layer(file).views()
            end = time.process_time()
            return field.psnr(squared_error(field.grid, views)), file, middle - begin, end - middle

        return search(one, parameters, target)

    large = coded(vq.TILES[0], words[-1:])
    _, psnr, file, encoding, decoding = coded(vq.TILES[large[1] < target], words)
    layer = vq.Layer(file)

    def open_client():
        unread = [len(file)]

        def request(rectangles):
            samples = 3 * sum(1 for _ in pixels(rectangles))
            return Cost(unread.pop(), samples + layer.held, layer.held) if unread else Cost(0, samples, layer.held)

        return request

    return Result(len(file), psnr, encoding, decoding, pairs(field, open_client))


def wavelet(_, field, target, __):
    """The 4D Haar wavelet. What was read is kept; a node takes 15 details of two bytes in memory."""
    steps = [round(4095 / 1.06**i) for i in range(108) if 4095 / 1.06**i >= haar.LEAST_STEP]

    def psnr_of(step):
        views = haar.views_of(haar.quantised(field.grid, step), field.grid.shape[:4], step)
        return (field.psnr(squared_error(field.grid, views)),)

    step, psnr = search(psnr_of, steps, target)
    begin = time.process_time()
    file = haar.encode(field.grid, step)
    encoding = time.process_time() - begin

    def open_client():
        reader = haar.Reader(file)

        def request(rectangles):
            read, samples = reader.bytes, reader.samples
            for place in pixels(rectangles):
                reader.pixel(*place)
            return Cost(reader.bytes - read, reader.samples - samples, 30 * reader.samples // 16)

        return request

    return Result(len(file), psnr, encoding, None, pairs(field, open_client))


METHODS = {  # name: (what tables call it, the function)
    "extended": ("HMLFC extended", hmlfc), "main": ("HMLFC main", hmlfc), "rlfc": ("RLFC", hmlfc), "mc": ("MC", hmlfc),
    "vq": ("vector quantisation", quantisation), AS_VQ: ("HMLFC extended, at that PSNR", hmlfc),
    "haar": ("4D Haar wavelet", wavelet), "x265-intra": ("x265 all-intra", pictures),
    "x265-inter": ("x265 inter", pictures), "jpeg": ("JPEG of each view", pictures),
    "jpeg2000": ("JPEG 2000 of each view", pictures),
}
