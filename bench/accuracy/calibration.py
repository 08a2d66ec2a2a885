"""Fixed work whose CPU time measures the current speed of the machine."""

import hashlib
import time
import zlib

WORK = "".join(hashlib.sha256(bytes([k % 256, k // 256])).hexdigest() for k in range(16384)).encode()
RUNS = 3


def calibration_seconds():
    """CPU seconds of compressing WORK, 1 MiB of hexadecimal digits: the least of RUNS."""
    seconds = []
    for _ in range(RUNS):
        begin = time.process_time()
        zlib.compress(WORK, 6)
        seconds.append(time.process_time() - begin)
    return min(seconds)
