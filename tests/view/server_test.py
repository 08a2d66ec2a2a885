"""hmlfc view: connections that send too much, too little or nothing, and the end, whatever goes on."""

import os
import signal
import socket
import struct
import threading
import time
from pathlib import Path
from unittest import mock
from urllib.parse import urlsplit

from page_server import PageServer
from program import DONE, INPUT, CliTest, main

from crc32c import crc32c

BEGIN = b"GET / HTTP/1.1\r\nX: "
PATIENCE = 30  # seconds in which a busy machine does what takes a moment


def under_large_grid(small, rows, cols):
    """The key image of `small`, a stream with one and a tree of height 1, under a grid of views without a bit."""
    offset, size = struct.unpack_from("<QQ", small, 44 + 4 * 2 + 8)
    images = rows * cols + -(-rows // 255) * -(-cols // 255) + 1
    root = bytes(16 * -(-3 * images // 4096))
    header = bytearray(small[:44])
    struct.pack_into("<H", header, 10, 44 + 4 * 3 + 24 * 4 + 4)
    struct.pack_into("<HH", header, 16, rows, cols)
    header[32:35] = 255, 255, 2  # clusters, tree_height
    header += bytes([1, 1, 0, 0]) * 3
    sections = [small[offset : offset + size], root, b"", b""]
    at = 44 + 4 * 3 + 24 * 4 + 4
    for kind, section in enumerate(sections, 1):
        header += struct.pack("<IIQQ", kind, crc32c(section), at, len(section))
        at += len(section)
    return bytes(header) + struct.pack("<I", crc32c(header)) + b"".join(sections)


def is_running(process):
    """Whether a process, by its number, is more than a zombie."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


class Server(CliTest):
    @classmethod
    def prepare(cls):
        cls.hmlfc(*"synth --scene cards --grid 1x2 --size 8x8 -o views".split())
        cls.hmlfc(*"encode views -o a.hmlfc --profile main --height 1 --cluster 1x2 --chroma 444".split())
        stream = (cls.folder / "a.hmlfc").read_bytes()
        (cls.folder / "large.hmlfc").write_bytes(under_large_grid(stream, 4096, 4096))

    def serve(self, *arguments):
        server = PageServer(self.folder, *arguments)
        self.addCleanup(server.process.communicate)
        self.addCleanup(server.process.kill)
        return server

    def connect(self, server):
        connection = socket.create_connection(("127.0.0.1", urlsplit(server.address).port), PATIENCE)
        self.addCleanup(connection.close)
        return connection

    def ask(self, server, path, method="GET"):
        """Sends a request without waiting for its answer."""
        connection = self.connect(server)
        connection.sendall(f"{method} {server.path}{path} HTTP/1.1\r\nHost: {server.host}\r\n\r\n".encode())
        return connection

    def drip(self, connections, until):
        """Sends a byte over each open connection again and again, until `until` or for PATIENCE."""
        end = time.monotonic() + PATIENCE
        while not until() and time.monotonic() < end:
            for connection in connections:
                try:
                    connection.sendall(b"a")
                except OSError:
                    pass
            time.sleep(0.05)
        self.assertTrue(until())

    def most_memory(self, server):
        """The largest resident set until now, in bytes."""
        status = Path(f"/proc/{server.process.pid}/status").read_text()
        return 1024 * int(status.partition("VmHWM:")[2].split()[0])

    ENDLESS = {
        "request line": (b"GET /", b"a" * 65536, 414),
        "header": (BEGIN, b"a" * 65536, 431),
        "headers": (b"GET / HTTP/1.1\r\n", b"X: a\r\n" * 10000, 431),
        "body without a length": (b"POST / HTTP/1.1\r\n\r\n", b"a" * 65536, 404),
        "long body": (b"POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n", b"a" * 65536, 413),
        "chunked body": (
            b"POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n",
            b"10000\r\n" + b"a" * 65536 + b"\r\n",
            413,
        ),
    }

    def test_what_is_too_long_is_refused(self):
        server = self.serve("a.hmlfc")
        for name, (begin, more, status) in self.ENDLESS.items():
            with self.subTest(name):
                connection = self.connect(server)
                connection.sendall(begin + more)
                self.assertTrue(connection.recv(100).startswith(f"HTTP/1.1 {status} ".encode()))
        self.assertEqual(server.ask("stream")[0], 200)

    def test_a_file_that_becomes_shorter_does_not_end_it(self):
        (self.folder / "cut.hmlfc").write_bytes((self.folder / "a.hmlfc").read_bytes())
        server = self.serve("cut.hmlfc")
        os.truncate(self.folder / "cut.hmlfc", 0)
        server.ask("totals")
        self.assertEqual(server.ask("stream")[0], 200)
        status, message = server.end()
        self.assertEqual(status, INPUT)
        self.assertIn("became shorter", message)

    def test_what_is_endless_takes_no_memory(self):
        server = self.serve("a.hmlfc")
        server.ask("stream")
        before = self.most_memory(server)
        for begin, more, _ in self.ENDLESS.values():
            connection = self.connect(server)
            try:
                connection.sendall(begin)
                for _ in range(512):
                    connection.sendall(more)
            except OSError:
                pass
        self.assertLess(self.most_memory(server) - before, 16 << 20)
        self.assertEqual(server.ask("stream")[0], 200)

    def test_many_slow_connections_keep_nobody_out(self):
        server = self.serve("a.hmlfc")
        slow = [self.connect(server) for _ in range(200)]
        for connection in slow[::2]:
            connection.sendall(BEGIN)
        answered = []
        asking = threading.Thread(
            target=lambda: answered.extend(server.ask("stream")[0] for _ in range(10)), daemon=True
        )
        asking.start()
        self.drip(slow[::2], lambda: not asking.is_alive())
        self.assertEqual(answered, [200] * 10)

    def test_connections_that_take_no_answers_keep_nobody_out(self):
        server = self.serve("a.hmlfc")
        for _ in range(80):
            connection = socket.socket()
            self.addCleanup(connection.close)
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            connection.connect(("127.0.0.1", urlsplit(server.address).port))
            connection.setblocking(False)
            request = f"GET {server.path}specification.md HTTP/1.1\r\nHost: {server.host}\r\n\r\n"
            connection.send(request.encode() * 100)
        begin = time.monotonic()
        self.assertEqual(server.ask("stream")[0], 200)
        self.assertLess(time.monotonic() - begin, PATIENCE)

    def test_a_request_has_a_deadline(self):
        server = self.serve("a.hmlfc")
        slow, idle = self.connect(server), self.connect(server)
        slow.sendall(BEGIN)
        ended = threading.Event()
        threading.Thread(target=lambda: slow.recv(1) == b"" and ended.set(), daemon=True).start()
        self.drip([slow], ended.is_set)
        self.assertEqual(idle.recv(1), b"")

    def end(self, server, *statuses):
        self.assertIn(server.process.wait(PATIENCE), statuses or [DONE])

    def test_ctrl_c_ends_it_while_connections_drip(self):
        server = self.serve("a.hmlfc")
        slow = [self.connect(server) for _ in range(20)]
        for connection in slow:
            connection.sendall(BEGIN)
        server.ask("stream")
        server.process.send_signal(signal.SIGINT)
        self.drip(slow, lambda: server.process.poll() is not None)
        self.end(server)

    def test_ctrl_c_ends_it_while_much_is_worked_out_and_a_second_signal_at_once(self):
        for signals, *statuses in ([signal.SIGINT], DONE), ([signal.SIGINT, signal.SIGTERM], -signal.SIGINT, -signal.SIGTERM):
            server = self.serve("large.hmlfc")
            self.ask(server, "totals")
            self.assertEqual(server.ask("")[0], 200)
            begin = time.monotonic()
            for number in signals:
                server.process.send_signal(number)
            self.end(server, *statuses)
            self.assertLess(time.monotonic() - begin, 10)  # totals take longer

    def test_ctrl_c_ends_the_decoder_under_test_and_its_files(self):
        temporary = self.folder / "temporary"
        temporary.mkdir()
        started = self.folder / "started"
        dut = f"sh -c 'echo $$ > {started}.new; mv {started}.new {started}; sleep 1000' {{input}} {{output}}"
        with mock.patch.dict(os.environ, TMPDIR=str(temporary)):
            server = self.serve("a.hmlfc", "--dut", dut)
        self.ask(server, "dut-picture?view=0,0")
        end = time.monotonic() + PATIENCE
        while not started.exists() and time.monotonic() < end:
            time.sleep(0.05)
        process = int(started.read_text())
        server.process.send_signal(signal.SIGINT)
        self.end(server)
        while is_running(process) and time.monotonic() < end:
            time.sleep(0.05)
        self.assertFalse(is_running(process))
        self.assertEqual(list(temporary.iterdir()), [])


if __name__ == "__main__":
    main()
