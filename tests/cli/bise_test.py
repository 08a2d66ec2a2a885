"""bise enc and dec: known sequences, and the way back."""

from program import USAGE, CliTest, main

import bise

class Bise(CliTest):
    def test_plain_bits_by_hand(self):
        # 16 levels are nibbles, the first in the low half of its byte.
        self.assertEqual(self.hmlfc("bise", "enc", 16, 1, 2, 3, 15, 0), "20 21f300\n")
        self.assertEqual(self.hmlfc("bise", "enc", 2, 1, 0, 0, 0, 0, 0, 0, 0, 1), "9 0101\n")
        self.assertEqual(self.hmlfc("bise", "enc", 256, 0, 255, 128), "24 00ff80\n")
        self.assertEqual(self.hmlfc("bise", "dec", 16, 5, "21F300"), "1 2 3 15 0\n")

    def test_trits_by_hand(self):
        # T = 00001111: T[4:2] = 3, so C = 15 and t4 = t3 = 0; C[1:0] = 3, so t2 = 2, t1 = 0, t0 = 2.
        self.assertEqual(self.hmlfc("bise", "enc", 3, 2, 0, 2, 0, 0), "8 0f\n")
        # T = 11111110: T[4:2] = 7, so C = 30 and t4 = t3 = 2; C[3:2] = 3, so t2 = t1 = 2, t0 = 2.
        self.assertEqual(self.hmlfc("bise", "enc", 3, 2, 2, 2, 2, 2), "8 fe\n")
        # 12 levels: the same T in parts after the plain bits of 1, 2, 3, 0, 1; in stream order
        # 10 11, 01 11, 11 0, 00 00, 10 0.
        self.assertEqual(self.hmlfc("bise", "enc", 12, 9, 2, 11, 0, 1), "18 ed8300\n")
        self.assertEqual(self.hmlfc("bise", "dec", 3, 5, "00"), "0 0 0 0 0\n")

    def test_quints_and_the_way_back(self):
        # Of the quint group's codes 7, 15, 23 and 31 the greatest.
        self.assertEqual(self.hmlfc("bise", "enc", 5, 4, 4, 4), "7 1f\n")
        for levels in map(bise.levels_of, range(1, 40)):
            values = [(7 * i + 1) % levels for i in range(17)]
            bits, text = self.hmlfc("bise", "enc", levels, *values).split()
            self.assertEqual(int(bits), bise.sequence_bits(17, levels))
            self.assertEqual(self.hmlfc("bise", "dec", levels, 17, text), " ".join(map(str, values)) + "\n")

    def test_one_level_takes_no_bits(self):
        self.assertEqual(self.hmlfc("bise", "enc", 1, 0, 0, 0).split(), ["0"])
        self.assertEqual(self.hmlfc("bise", "dec", 1, 3), "0 0 0\n")
        self.assertEqual(self.hmlfc("bise", "dec", 1, 3, ""), "0 0 0\n")

    def test_refused(self):
        for arguments, named in [
            (["enc", 7, 1], "allowed are 1 2 3 4 5 6 8 10 12 16"),
            (["enc", 0, 0], "allowed"),
            (["enc", 32768, 0], "16384"),
            (["enc", "0x3", 0], "allowed"),
            (["enc", 3, 3], "[0, 2]"),
            (["enc", 3, 0, -1], "-1"),
            (["enc", 3, "1.0"], "1.0"),
            (["enc", 3], "V"),
            (["dec", 7, 1, "00"], "allowed"),
            (["dec", 3, 0, ""], "COUNT"),
            (["dec", 3, 6, "00"], "10 bits, that is 2 bytes, but HEX has 1"),
            (["dec", 3, 5, "0000"], "HEX has 2"),
            (["dec", 3, 5, "0"], "whole number of bytes"),
            (["dec", 3, 5, "zz"], "hexadecimal"),
            (["dec", 3, 5, "+1"], "hexadecimal"),
            (["dec", 3, 5], "HEX has 0"),
        ]:
            with self.subTest(arguments=arguments):
                self.refused(USAGE, "bise", *arguments, says=named)


if __name__ == "__main__":
    main()
