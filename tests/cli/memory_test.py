"""Running out of memory is an error with a message, not the end of the world."""

import resource

from program import OUT_OF_MEMORY, CliTest, main

GIBIBYTE = 1 << 30


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (GIBIBYTE, GIBIBYTE))


class Memory(CliTest):
    def test_one_view(self):
        options = "--scene flat --grid 1x1 --size 32768x32768 --threads 1 -o views".split()
        self.refused(
            OUT_OF_MEMORY, "synth", *options, preexec_fn=limit_memory, says="Not enough memory"
        )


if __name__ == "__main__":
    main()
