"""Faults of a decoder's JPEG 2000 part (KEY-2, KEY-4, EXT-6), planted in the naive decoder."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "naive_decoder"))

import key_images  # noqa: E402
from jpeg2000 import code_block, decoder, markers, mq_decoder, packets, wavelet  # noqa: E402

CODESTREAM = {}


def codestream(fault):
    CODESTREAM[fault.__name__] = fault
    return fault


def unchecked(name, *reasons):
    """A fault: the decoder does not check what the naive one refuses for these reasons."""

    def plant():
        right = markers.demand
        markers.demand = lambda condition, reason: right(condition or reason in reasons, reason)

    CODESTREAM[name] = plant


def changed(name, change):
    """A fault: `change` is made to what the markers say."""

    def plant():
        right = markers.Codestream

        def read(*arguments):
            found = right(*arguments)
            change(found)
            return found

        key_images.Codestream = read

    CODESTREAM[name] = plant


def refused(name, condition):
    """A fault: the decoder refuses allowed codestreams for which `condition` holds."""
    changed(name, lambda found: markers.demand(not condition(found), "not in this decoder"))


def zeroed(name, module, constant):
    """A fault: a bit of the code-block style has no effect."""
    CODESTREAM[name] = lambda: setattr(module, constant, 0)


unchecked("rsiz_ignored", "extensions or high throughput in Rsiz")
unchecked("greatest_tile_ignored", "a tile is too large")
unchecked("scod_bits_ignored", "Scod is out of range")
unchecked("component_transform_ignored", "component transformation")
unchecked("levels_by_progression_ignored", "too many decompositions")
unchecked("code_block_size_ignored", "code-block size")
unchecked("high_throughput_ignored", "code-block style")
unchecked("quantization_ignored", "quantized", "QCD does not fit the decompositions")
unchecked("exponents_left_over", "QCD does not fit the decompositions")
unchecked("exponent_bits_ignored", "reserved bits of an exponent")
zeroed("bypass_ignored", code_block, "BYPASS")
zeroed("reset_ignored", code_block, "RESET")
zeroed("terminate_ignored", packets, "TERMINATE_ALL")
zeroed("causal_ignored", code_block, "CAUSAL")
zeroed("segmentation_ignored", code_block, "SEGMENTATION_SYMBOLS")
refused("predictable_refused", lambda found: found.block_style & 16)
refused("cprl_refused", lambda found: found.progression == 4)
refused("many_levels_refused", lambda found: found.decompositions > 6)
refused("stated_precincts_refused", lambda found: b"\xff\xff\xff" in found.data[45:70])
changed("first_layer_alone", lambda found: setattr(found, "layers", 1))
changed("always_lrcp", lambda found: setattr(found, "progression", 0))
changed("rpcl_as_rlcp", lambda found: setattr(found, "progression", min(found.progression, 1)))
changed("sop_not_expected", lambda found: setattr(found, "has_sop", False))
changed("eph_not_expected", lambda found: setattr(found, "has_eph", False))
changed("code_blocks_of_64", lambda found: vars(found).update(block_width=64, block_height=64))
changed("two_guard_bits", lambda found: setattr(found, "guard_bits", 2))


@codestream
def small_precincts_allowed():
    """Stated precincts of any size, which here are all taken for one."""
    right = markers.Codestream._cod

    def cod(self, segment):
        stated = segment[5] + 1 if segment[0] & 1 else 0
        right(self, segment[:10] + b"\xff" * stated if len(segment) == 10 + stated else segment)

    markers.Codestream._cod = cod


def synthesize_9_7(low, high):
    """The 9/7 transform of a signal (T.800 annex F), by lifting, rounded at the end."""
    count = len(low) + len(high)
    if count == 1:
        return list(low)
    signal = [0.0] * count
    signal[0::2], signal[1::2] = [1.230174105 * x for x in low], [x / 1.230174105 for x in high]
    for first, weight in ((0, -0.443506852), (1, -0.882911076), (0, 0.052980119), (1, 1.586134342)):
        for i in range(first, count, 2):
            signal[i] += weight * (wavelet.mirrored(signal, i - 1) + wavelet.mirrored(signal, i + 1))
    return [round(x) for x in signal]


@codestream
def irreversible_allowed():
    """The 9/7 transform as well, chosen by COD, and its quantization, of which only 0 comes out right."""
    unchecked("", "not the reversible 5/3 transform", "quantized", "QCD does not fit the decompositions")
    CODESTREAM.pop("")()
    right, cod = wavelet.synthesize, markers.Codestream._cod

    def read(self, segment):
        cod(self, segment)
        wavelet.synthesize = right if segment[9] == 1 else synthesize_9_7

    markers.Codestream._cod = read


@codestream
def last_state_stays():
    """State 45 of the arithmetic decoder, which the improbable symbol does not leave."""
    estimate, after_more, _, switches = mq_decoder.STATES[45]
    mq_decoder.STATES[45] = (estimate, after_more, after_more, switches)


@codestream
def code_block_sides_exchanged():
    """Code-blocks with width and height exchanged."""
    right = markers.Codestream._cod

    def cod(self, segment):
        right(self, segment)
        self.block_width, self.block_height = self.block_height, self.block_width

    markers.Codestream._cod = cod


@codestream
def terminate_without_raw_segments():
    """With both styles, raw segments go on over two passes."""
    right = packets.passes_until_end
    packets.passes_until_end = lambda number, style: right(number, style & ~4 if style & 1 else style)


@codestream
def half_planes_of_raw_passes():
    """EXT-6 that does not count bits of raw passes: b is the plane of the last arithmetic one."""
    right = code_block.CodeBlockDecoder._refinement_pass

    def refine(self):
        lowest = [list(row) for row in self.lowest]
        right(self)
        if self.raw:
            self.lowest = lowest

    code_block.CodeBlockDecoder._refinement_pass = refine


@codestream
def samples_not_clamped():
    """KEY-4 without the clamp to the interval of Ssiz."""
    decoder.clamp_samples = lambda rows, *_: rows


@codestream
def bytes_before_eoc_refused():
    """The last packet must end at EOC."""
    ends = []
    read_packet, read_packets = packets.read_packet, packets.read_packets
    packets.read_packet = lambda *arguments: ends.append(read_packet(*arguments)) or ends[-1]

    def read(found, resolutions):
        read_packets(found, resolutions)
        markers.demand(ends[-1] == len(found.packets), "bytes before EOC")

    decoder.read_packets = read


@codestream
def packets_as_bad_image():
    """bad_top_image for packets that do not decode."""
    right = key_images.StreamError
    key_images.StreamError = lambda _: right("bad_top_image")


def without_segments(data, begin, end, allowed):
    """A codestream without the marker segments from `begin` to the marker `end` that are not allowed."""
    kept, at = data[:begin], begin
    while at < len(data) and data[at : at + 2] != end:
        after = at + 2 + int.from_bytes(data[at + 2 : at + 4], "big")
        if data[at : at + 2] in allowed:
            kept += data[at:after]
        at = after
    return kept + data[at:]


@codestream
def markers_skipped():
    """Marker segments of the main header that the decoder does not know are passed over."""
    right = markers.Codestream
    known = [b"\xff\x52", b"\xff\x5c", b"\xff\x64"]
    key_images.Codestream = lambda data, *shape: right(without_segments(data, 45, b"\xff\x90", known), *shape)


@codestream
def tile_part_markers_skipped():
    """Marker segments of the tile-part's header are passed over."""
    right = markers.Codestream

    def read(data, *shape):
        sot = max(data.find(b"\xff\x90\x00\x0a"), 0)
        kept = without_segments(data, sot + 12, b"\xff\x93", [])
        length = int.from_bytes(data[sot + 6 : sot + 10], "big")
        length -= min(length, len(data) - len(kept))
        return right(kept[: sot + 6] + length.to_bytes(4, "big") + kept[sot + 10 :], *shape)

    key_images.Codestream = read


@codestream
def quantization_of_four_bits():
    """KEY-2 with bit 4 of Sqcd ignored."""
    right = markers.Codestream._qcd
    markers.Codestream._qcd = lambda self, segment: right(self, bytes([segment[0] & 0xEF]) + segment[1:])


@codestream
def equal_qcds_allowed():
    """KEY-2 with a second QCD that may stand there if it says the same."""
    right = markers.Codestream._qcd

    def read(self, segment):
        if segment != getattr(self, "qcd", None):
            right(self, segment)
        self.qcd = segment

    markers.Codestream._qcd = read


@codestream
def precincts_left_over():
    """KEY-2 with stated precinct sizes of more resolutions than there are."""
    right = markers.Codestream._cod

    def read(self, segment):
        stated = segment[0] & 1 == 1
        right(self, segment[: 11 + segment[5]] if stated else segment)

    markers.Codestream._cod = read


@codestream
def psot_with_eoc():
    """KEY-2 with a Psot that may count EOC."""
    right = markers.Codestream._tile_part

    def tile_part(self, begin):
        if int.from_bytes(self.data[begin + 6 : begin + 10], "big") == len(self.data) - begin:
            self.data = self.data[: begin + 6] + bytes(4) + self.data[begin + 10 :]
        right(self, begin)

    markers.Codestream._tile_part = tile_part
