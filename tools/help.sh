# The help of ./run, which sources this file: what it says of its commands and of those of hmlfc.

usage() {
  cat <<'END'
Usage: ./run COMMAND [ARG...]

Start
  demo             render a light field, encode, decode and compare it
  view             look through a light field and into its stream in a browser

Your light field
  encode           a folder of views to a stream
  publish          a web page that draws it in the visitor's browser
  decode           views of a stream to PNG files
  render           novel views: one, a path or a focal stack
  picture          a view, a contact sheet, a difference or an epipolar picture
  compare          how far apart two light fields are, or two maps of disparities
  info             what a stream is and what its bytes are spent on
  disparity        where things are, as a map
  convert          tiles, quilts, lenslet pictures and videos, both ways
  synth            a synthetic light field

Your decoder
  conform          test it with the conformance suite
  inspect          how one block is decoded, field by field
  minimise         reduce a stream on which it fails
  fuzz-dut         test it with random valid streams
  vectors          make and examine the conformance suite

More
  test             run the tests, or those of ctest's ARG...; --require-all: a skip is a failure
  setup            only install packages; groups: .ci/packages.txt
  bise             encode or decode a bounded integer sequence
  reference-area   what the decoder in WGSL needs beside a stream
  serve            answer requests for blocks by a decoder in a shared library

./run COMMAND --help shows the options and an example of a command; ./run help developers the checks of
implementations and tests, releases and measurements.
Missing Debian packages are installed first, then build/release is built.
END
}

usage_developers() {
  cat <<'END'
Usage: ./run COMMAND [ARG...]

Checks of an implementation
  rtl-check        FILE.hmlfc [ARG...]: the decode unit against the model; --help
  rtl-view         FILE.hmlfc [ARG...]: a view by descriptor and DMA into memory; --help
  rtl-random       the same on random streams, intact and damaged
  rtl-clocks       [--json]: clocks per block of the decode unit, by the block's state
  rtl-bench        FILE.hmlfc... [ARG...]: throughput and latency of the decode unit; --help
  rtl-coverage     what random streams reach in the decode unit; --help
  gpu-check        FILE.hmlfc [ARG...]: the GPU decoder against the model; --help
  crosscheck       FILE.hmlfc [ARG...]: every implementation on the same blocks; --help

Checks of the tests
  soak             --minutes N [--seed S] [--shard I/N] [CTEST-ARG...]: the long tests, then random
                   streams on the decode unit
  clauses          clauses by vectors and implementations; --help
  coverage         [--missed]: lines of the decoder that the vectors reach
  fuzz             TARGET|all [--minutes N]: libFuzzer on decoder and page; --help
  stress           --minutes N [--seed S]: the range of every integer on extreme streams; --help

Releases
  pack-vectors     [FOLDER]: the conformance suite as an archive, and its SHA-256
  package          [FOLDER]: Debian packages
  docs             [FOLDER]: documents and reference of the library as a site
  release          [FOLDER]: all files of a release of this commit, their sums, and what is left to do
  sbom             [FILE]: packages that a build uses: versions, purpose (CycloneDX)

Measurements
  bench            [NAME [ARG...]]: run one benchmark; without NAME, list them
  synthesis        size TARGET [MODULE...]: size of the decode unit: ice40, ecp5, xc7, osu035;
                   speed [MODULE...]: its clock rate after place and route
  fpga             [--seeds N]: a bitstream with the view unit for the board ULX3S; --help
END
}

# commands: the names of all commands, one a line.
commands() {
  { usage; usage_developers; } | sed -n 's/^  \([a-z][a-z-]*\) .*/\1/p'
}

# near WORD: the name of a command that WORD is most like, if it is like one: at most a third of its letters
# are left out, added or changed.
near() {
  commands | awk -v word="$1" '
    function least(a, b) { return a < b ? a : b }
    {
      for (i = 0; i <= length(word); ++i) {
        for (j = 0; j <= length($0); ++j) {
          d[i, j] = i + j
          if (!i || !j) continue
          same = substr(word, i, 1) == substr($0, j, 1)
          d[i, j] = least(least(d[i - 1, j], d[i, j - 1]) + 1, d[i - 1, j - 1] + !same)
        }
      }
      if (d[length(word), length($0)] <= (length(word) + 1) / 3 && (best == "" || d[length(word), length($0)] < distance)) {
        best = $0
        distance = d[length(word), length($0)]
      }
    }
    END { print best }'
}

# help [developers]: builds nothing.
help() {
  if [[ ${1:-} == developers ]]; then usage_developers; else usage; fi
}
