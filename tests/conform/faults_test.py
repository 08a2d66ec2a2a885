"""The self-test of the conformance suite: decoders that must fail, and the vector that catches each."""

import json

from conform_case import SUITE, ConformTest, faulty, main
from faulty_decoder import ARITHMETIC, CHECKS, CODESTREAM, PROCESS

# Each planted fault of the arithmetic, and a vector that must catch it.
HUNTED_BY = {
    "wrong_rounding": "syntax/subpel-3",
    "disparity_rounded_down": "syntax/disparity-precision-0-5",
    "trit_digits_swapped": "syntax/bise-levels-3",
    "lowest_trit_code": "syntax/bise-every-trit-code",
    "quint_digits_swapped": "syntax/bise-levels-5",
    "neighbours_exchanged": "syntax/references-1",
    "border_off_by_one": "boundary/vector-border-one",
    "sign_ignored": "syntax/signs-minus",
    "stale_cache": "syntax/many-tiles",
    "bias_ignored": "syntax/headers-bias-bits-5",
    "step_doubled": "syntax/steps-all",
    "chroma_shifted": "syntax/blocks-4-420",
    "colour_without_clamp": "boundary/colour-clamps-depth8",
    "eight_bit_samples": "syntax/depth-9",
}

# Each planted fault of JPEG 2000, and a vector that must catch it.
CODESTREAM_HUNTED_BY = {
    "rsiz_ignored": "error/top-image-rsiz-extensions",
    "greatest_tile_ignored": "error/top-image-tile-width-2-31",
    "scod_bits_ignored": "error/top-image-scod",
    "component_transform_ignored": "error/top-image-component-transform",
    "levels_by_progression_ignored": "error/top-image-levels-16-rpcl",
    "code_block_size_ignored": "error/top-image-code-block-area",
    "high_throughput_ignored": "error/top-image-style-high-throughput",
    "irreversible_allowed": "error/top-image-transform-quantized",
    "small_precincts_allowed": "error/top-image-precincts-column",
    "quantization_ignored": "error/top-image-quantization-expounded",
    "exponents_left_over": "error/top-image-qcd-longer",
    "exponent_bits_ignored": "error/top-image-exponent-bits",
    "bypass_ignored": "syntax/key-style-bypass",
    "reset_ignored": "syntax/key-style-reset",
    "terminate_ignored": "syntax/key-style-terminate",
    "causal_ignored": "syntax/key-style-causal",
    "segmentation_ignored": "syntax/key-style-segmentation",
    "predictable_refused": "syntax/key-style-predictable",
    "cprl_refused": "syntax/key-progression-cprl",
    "many_levels_refused": "boundary/key-decompositions-32-lrcp",
    "stated_precincts_refused": "syntax/key-precincts-stated",
    "first_layer_alone": "syntax/key-layers-3",
    "always_lrcp": "syntax/key-progression-rlcp",
    "rpcl_as_rlcp": "boundary/key-precincts-two-rpcl",
    "sop_not_expected": "syntax/key-sop",
    "eph_not_expected": "syntax/key-eph",
    "code_blocks_of_64": "syntax/key-code-blocks-8x16",
    "two_guard_bits": "boundary/key-guard-bits-1",
    "last_state_stays": "boundary/key-probable-symbols",
    "code_block_sides_exchanged": "syntax/key-code-blocks-32x4",
    "terminate_without_raw_segments": "syntax/key-style-bypass-terminate",
    "samples_not_clamped": "boundary/key-samples-clamped",
    "bytes_before_eoc_refused": "boundary/key-bytes-before-eoc",
    "packets_as_bad_image": "error/top-crc-packet",
    "half_planes_of_raw_passes": "syntax/lossy-keys-style-bypass",
    "markers_skipped": "error/top-image-main-tlm",
    "quantization_of_four_bits": "error/top-image-quantization-bit-4",
    "equal_qcds_allowed": "error/top-image-main-qcd",
    "precincts_left_over": "error/top-image-precincts-longer",
    "psot_with_eoc": "error/top-image-psot-eoc",
    "tile_part_markers_skipped": "error/top-image-tile-part-plt",
}

# Each planted fault of the checks, a vector that must catch it, and what the runner says.
CHECKED_BY = {
    "range_before_crc": ("error/pair-key-crc-range", "another error than bad_top_crc: top_sample_range"),
    "codes_before_vectors": ("error/pair-main-min-x-codes-x", "another error than vector_range: bad_levels"),
    "top_before_sizes": ("error/pair-open-root-size-top-entry", "another error than bad_section_size: bad_top_entry"),
    "residual_before_motion": ("error/pair-tiles-motion-head-mask", "another error than bad_mode: mask_outside"),
    "own_before_parent": ("error/pair-tree-top-mask-motion", "another error than mask_outside: tile_overrun"),
    "second_reference_first": ("error/pair-tiles-first-mode-second-mask", "another error than bad_mode: mask_outside"),
    "k2_before_k1": ("error/pair-references-5-first-second", "another error than bad_mode: mask_outside"),
    "k3_before_k0": ("error/pair-references-6-first-second", "another error than bad_mode: mask_outside"),
    "vectors_with_head": ("error/pair-main-level-bits-vector", "another error than bad_mode: vector_range"),
    "crc_before_sizes": ("error/pair-open-root-size-section-crc", "another error than bad_section_size: bad_section_crc"),
    "levels_with_head": ("error/overrun-headers-level", "another error than tile_overrun: bad_levels"),
    "steps_with_values": ("error/pair-steps-step-values", "another error than bad_levels: tile_overrun"),
    "data_of_empty_groups": ("boundary/index-table-beyond", "refused a valid stream"),
    "masks_one_by_one": ("error/overrun-second-mask", "another error than tile_overrun: mask_outside"),
    "motion_block_at_once": ("error/motion-block-small-cut", "another error than tile_overrun: bad_mode"),
    "first_of_32_bits": ("error/root-entry-bit-32", "accepted, but must be refused with bad_root_entry"),
    "record_for_each_mask_bit": ("boundary/index-groups-beyond", "refused a valid stream"),
    "tiles_that_exist_alone": ("boundary/index-tiles-beyond", "0 instead of"),
    "empty_tiles_unchecked": ("error/group-empty-tile", "accepted, but must be refused with bad_group_record"),
    "key_references_unchecked": ("error/key-references-without", "accepted, but must be refused"),
    "end_before_vector_ranges": ("error/order-min-y-end", "another error than vector_range: tile_overrun"),
    "end_before_residual_widths": ("error/order-level-bits-end", "another error than bad_mode: tile_overrun"),
    "bias_bits_after_steps": ("error/order-bias-bits-step", "another error than bad_mode: tile_overrun"),
    "values_one_bit_short": ("error/overrun-values-one-bit", "accepted, but must be refused with tile_overrun"),
    "record_number_of_64_bits": ("error/root-entry-sum", "accepted, but must be refused with bad_root_entry"),
    "top_bit_of_place_ignored": ("error/group-place-bit-63", "accepted, but must be refused with bad_group_record"),
    "second_reserved_byte_ignored": ("error/field-reserved-second-byte", "accepted, but must be refused"),
    "third_reserved_byte_ignored": ("error/field-reserved-third-byte", "accepted, but must be refused"),
    "magic_of_seven_bytes": ("error/magic-last-byte", "accepted, but must be refused with bad_magic"),
    "features_of_31_bits": ("error/feature-bit-31", "accepted, but must be refused with bad_feature"),
    "tree_height_16": ("error/tree-height-16-entries", "another error than bad_header_field: bad_section_table"),
    "vector_precision_4": ("error/vector-precision-4-disparity-5", "accepted, but must be refused with bad_header_field"),
    "top_sizes_signed": ("error/top-entry-end-2-32", "another error than bad_top_entry: bad_top_image"),
    "tiles_of_32_bits": ("error/root-size-2-32", "another error than bad_section_size: bad_levels"),
    "first_of_empty_groups": ("boundary/index-first-unused", "refused a valid stream"),
    "data_of_47_bits": ("error/group-data-bit-47", "accepted, but must be refused with bad_group_record"),
    "ends_of_31_bits": ("error/tile-end-bit-31", "accepted, but must be refused with bad_tile_offset"),
    "record_one_byte_past": ("error/tile-end-one-past", "accepted, but must be refused with bad_tile_offset"),
    "table_padding_checked": ("boundary/index-table-padding", "refused a valid stream"),
    "rows_4095": ("performance/level3-rows", "refused a valid stream"),
    "height_65535": ("performance/level3-height", "refused a valid stream"),
    "types_of_31_bits": ("error/section-type-bit-31", "accepted, but must be refused with bad_section_table"),
    "rig_of_16_bits": ("boundary/rig-zeros", "refused a valid stream"),
    "last_reserved_byte_ignored": ("error/field-reserved-last-byte", "accepted, but must be refused with bad_header_field"),
    "features_before_profile": ("error/profile-feature-unknown", "another error than bad_profile: bad_feature"),
    "sections_unchecked": ("error/section-crc-tile", "accepted, but must be refused with bad_section_crc"),
}

# How samples of more than 8 bits are stored, on a vector of 10 bits.
STORED = {
    "big_endian_raw": ("fail", "more than 10 bits"),
    "low_bits_of_png": ("fail", "instead of"),
    "png_without_depth": ("fail", "of 12 bits instead of"),
    "high_bits_of_png": ("pass", ""),
}

# Each planted fault of the process, and what must come of it on any vector that decodes.
PROCESS_RESULTS = {
    "missing_output": ("fail", "wrong output"),
    "no_output": ("fail", "wrong output"),
    "truncated_picture": ("fail", "wrong output"),
    "short_raw": ("fail", "17 bytes"),
    "wrong_exit_code": ("fail", "exit status 1"),
    "crash": ("error", "signal 11"),
    "hang": ("timeout", "timed out after"),
    "hanging_child": ("pass", ""),  # no fault of the views: the child is killed
    "endless_messages": ("timeout", "timed out after"),
    "memory_hog": ("fail", "exit status 1"),
}


class Faults(ConformTest):
    def run_on(self, fault, vector, *arguments, dut=None):
        status, report = self.conform(
            dut or faulty(fault), "--filter", vector, *arguments, suite=SUITE, output=fault
        )
        result = self.results(report)[vector]
        self.assertEqual(status, 1 if result["status"] not in ("pass", "skipped") else 5)
        return result

    def test_every_fault_is_run(self):
        self.assertEqual(set(HUNTED_BY), set(ARITHMETIC))
        self.assertEqual(set(CODESTREAM_HUNTED_BY), set(CODESTREAM))
        self.assertEqual(set(CHECKED_BY), set(CHECKS))
        self.assertEqual(set(PROCESS_RESULTS) | set(STORED) | {"accepts_everything"}, set(PROCESS))

    def test_without_a_fault(self):
        vectors = set(HUNTED_BY.values()) | set(CODESTREAM_HUNTED_BY.values())
        filters = [word for vector in sorted(vectors) for word in ("--filter", vector)]
        _, report = self.conform(self.declaration("none"), *filters, suite=SUITE)
        results = self.results(report)
        for vector in sorted(vectors):
            with self.subTest(vector=vector):
                self.assertEqual(results[vector]["status"], "pass")

    def test_arithmetic(self):
        for fault, vector in HUNTED_BY.items():
            with self.subTest(fault=fault):
                result = self.run_on(fault, vector)
                self.assertEqual(result["status"], "fail", result)
                if "difference" not in result:  # the fault led it to refuse the stream
                    self.assertIn("refused a valid stream", result["reason"])
                    continue
                difference = result["difference"]
                self.assertGreater(difference["wrong_blocks"], 0)
                self.assertNotEqual(difference["expected"], difference["actual"])
                self.assertTrue(difference["planes"])
                pictures = self.folder / fault / result["pictures"]
                self.assertEqual(
                    sorted(path.name for path in pictures.iterdir()),
                    ["actual.png", "difference.png", "expected.png", "heat.png"],
                )

    def declaration(self, fault, **claims):
        file = self.folder / f"{fault}.json"
        file.write_text(json.dumps({"name": fault, "command": faulty(fault), "error_names": True, **claims}))
        return file

    def test_checks(self):
        for fault, (vector, reason) in CHECKED_BY.items():
            with self.subTest(fault=fault):
                dut = self.declaration(fault, checks_sections=True)
                result = self.run_on(fault, vector, dut=dut)
                self.assertEqual(result["status"], "fail", result)
                self.assertIn(reason, result["reason"])

    def test_checks_without_a_fault(self):
        vectors = [argument for vector, _ in CHECKED_BY.values() for argument in ("--filter", vector)]
        dut = self.declaration("none", checks_sections=True)
        _, report = self.conform(dut, *vectors, suite=SUITE, output="none")
        results = {name: result["status"] for name, result in self.results(report).items()}
        for vector, _ in CHECKED_BY.values():
            self.assertEqual(results[vector], "pass", vector)
        self.assertEqual(set(results.values()), {"pass", "skipped"})

    def test_sections_may_be_unchecked_without_the_claim(self):
        result = self.run_on("sections_unchecked", "error/section-crc-tile", dut=self.declaration("sections_unchecked"))
        self.assertEqual(result["status"], "pass", result)

    def test_stored_samples(self):
        for fault, (status, reason) in STORED.items():
            with self.subTest(fault=fault):
                result = self.run_on(fault, "real/glass-depth10")
                self.assertEqual(result["status"], status, result)
                self.assertIn(reason, result.get("reason", ""))

    def test_codestreams(self):
        for fault, vector in CODESTREAM_HUNTED_BY.items():
            with self.subTest(fault=fault):
                _, report = self.conform(self.declaration(fault), "--filter", vector, suite=SUITE)
                result = self.results(report)[vector]
                self.assertEqual(result["status"], "fail", result)
                self.assertRegex(
                    result["reason"], "must be refused with|refused a valid stream|another error than bad_top_crc"
                )

    def test_process(self):
        for fault, (status, reason) in PROCESS_RESULTS.items():
            with self.subTest(fault=fault):
                seconds = "5" if status == "timeout" else "60"
                limits = ("--timeout", seconds, "--memory", "4096")
                result = self.run_on(fault, "real/cards-main", *limits)
                self.assertEqual(result["status"], status, result)
                self.assertIn(reason, result.get("reason", ""))

    def test_accepting_what_must_be_refused(self):
        for vector in ("error/magic", "error/sign-mode-3", "error/trailing-byte"):
            with self.subTest(vector=vector):
                result = self.run_on("accepts_everything", vector)
                self.assertEqual(result["status"], "fail")
                self.assertIn("must be refused with", result["reason"])

    def test_refusing_with_another_error(self):
        dut = self.folder / "other_error.json"
        command = "sh -c 'echo bad_mode_x bad_levels >&2; exit 4' {input} {output}"
        dut.write_text(json.dumps({"name": "other", "command": command, "error_names": True}))
        _, report = self.conform(dut, "--filter", "error/*")
        result = self.results(report)["error/sign-mode-3"]
        self.assertEqual(result["status"], "fail")
        self.assertIn("another error than bad_mode: bad_mode_x bad_levels", result["reason"])


if __name__ == "__main__":
    main()
