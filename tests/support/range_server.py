"""A web server of one file that answers range requests, late or wrong if it is told to."""

import re
import socket
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

RANGE = re.compile(r"bytes=(\d*)-(\d+)")


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True  # else the body waits for the answer to the headers

    def do_GET(self):
        try:
            self.server.owner.answer(self)
        except (BrokenPipeError, ConnectionResetError):
            self.close_connection = True

    def do_HEAD(self):
        self.server.owner.head(self)

    def log_message(self, *_):
        pass


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = 64

    def handle_error(self, request, client_address):
        pass


class RangeServer:
    """Serves `file` at `address` until `with` ends.

    delay: seconds before each answer
    fault: from request number `after` on (the first is 0), `times` times: one of the methods below that
        begin with fault_, or a status
    requests: [first byte, last byte] of each request, in order
    """

    def __init__(self, file, delay=0.0, fault=None, after=0, times=10**9):
        self.file, self.delay = file, delay
        self.fault, self.after, self.times = fault, after, times
        self.requests = []
        self.tag = '"first"'
        self.open_connections = set()
        self.lock = threading.Lock()
        self.server = _Server(("127.0.0.1", 0), _Handler)
        self.server.owner = self
        self.address = f"http://127.0.0.1:{self.server.server_port}/{file.name}"

    def __enter__(self):
        self.thread = threading.Thread(target=self.server.serve_forever, args=(0.01,), daemon=True)
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.server.shutdown()
        self.server.server_close()

    @property
    def sent(self):
        """Bytes asked for."""
        return sum(last - first + 1 for first, last in self.requests)

    def answer(self, handler):
        size = self.file.stat().st_size
        found = RANGE.fullmatch(handler.headers.get("Range", ""))
        if found and not found[1]:  # the last bytes
            first, last = size - int(found[2]), size - 1
        else:
            first, last = (int(found[1]), min(int(found[2]), size - 1)) if found else (0, size - 1)
        self.encodings = handler.headers.get("Accept-Encoding")
        with self.lock:
            number = len(self.requests)
            self.requests.append([first, last])
        time.sleep(self.delay)
        if self.fault is None or not self.after <= number < self.after + self.times:
            return self.send(handler, first, last, size)
        if isinstance(self.fault, int):
            return self.status(handler, self.fault)
        return getattr(self, "fault_" + self.fault)(handler, first, last, size)

    def head(self, handler):
        self.status(handler, 200, **{"Content-Length": str(self.file.stat().st_size), "ETag": self.tag})

    def send(self, handler, first, last, size, status=206, length=None, total=None, shift=0, unit="bytes", **headers):
        body = self.read(first, last)[:length]
        handler.send_response(status)
        if status == 206:
            handler.send_header("Content-Range", f"{unit} {first + shift}-{last + shift}/{total or size}")
        for name, value in headers.items():
            handler.send_header(name, value)
        if self.tag:
            handler.send_header("ETag", self.tag)
        handler.send_header("Content-Length", str(len(body)))
        handler.end_headers()
        handler.wfile.write(body)

    def read(self, first, last):
        with open(self.file, "rb") as file:
            file.seek(first)
            return file.read(last - first + 1)

    def status(self, handler, status, **headers):
        handler.send_response(status)
        for name, value in {"Content-Length": "0", **headers}.items():
            handler.send_header(name, value)
        handler.end_headers()

    def fault_unknown_total(self, handler, first, last, size):
        self.send(handler, first, last, size, total="*", unit="Bytes")

    def fault_unknown_end(self, handler, first, last, size):
        """Nor does it tell the last bytes; the method HEAD tells the length."""
        if last == first == size - 1:
            return self.status(handler, 416)
        self.send(handler, first, last, size, total="*")

    def fault_in_pieces(self, handler, first, last, size):
        """Less than was asked for, as a server may."""
        self.send(handler, first, min(last, first + 999), size)

    def fault_weak_tags(self, handler, first, last, size):
        """Now weak, now strong, of the same version."""
        self.tag = self.tag[2:] if self.tag.startswith("W/") else "W/" + self.tag
        self.send(handler, first, last, size)

    def fault_compressed(self, handler, first, last, size):
        self.send(handler, first, last, size, **{"Content-Encoding": "gzip"})

    def fault_multipart(self, handler, first, last, size):
        self.send(handler, first, last, size, unit="", **{"Content-Type": "multipart/byteranges; boundary=x"})

    def fault_no_ranges(self, handler, first, last, size):
        self.send(handler, 0, size - 1, size, status=200)

    def fault_other_length(self, handler, first, last, size):
        self.send(handler, first, last, size, total=size + 1)

    def fault_other_range(self, handler, first, last, size):
        self.send(handler, first, last, size, shift=1)

    def fault_other_bytes(self, handler, first, last, size):
        """Sends what a server sends of a file that has changed."""
        self.tag = '"second"'
        self.send(handler, first, last, size)

    def fault_endless_headers(self, handler, first, last, size):
        handler.send_response(206)
        handler.flush_headers()
        while True:
            handler.wfile.write(b"X-Header: " + 1000 * b"a" + b"\r\n")

    def fault_endless_trailers(self, handler, first, last, size):
        """All bytes of the range, in chunks, then lines without end."""
        body = self.read(first, last)
        handler.send_response(206)
        handler.send_header("Content-Range", f"bytes {first}-{last}/{size}")
        handler.send_header("ETag", self.tag)
        handler.send_header("Transfer-Encoding", "chunked")
        handler.end_headers()
        handler.wfile.write(b"%x\r\n%b\r\n0\r\n" % (len(body), body))
        while True:
            handler.wfile.write(b"X-Trailer: " + 1000 * b"a" + b"\r\n")

    def fault_short(self, handler, first, last, size):
        """Fewer bytes than the range has, in a whole answer."""
        self.send(handler, first, last, size, length=(last - first) // 2)

    def fault_truncated(self, handler, first, last, size):
        """The connection ends in the middle of the answer."""
        body = self.read(first, last)
        handler.send_response(206)
        handler.send_header("Content-Range", f"bytes {first}-{last}/{size}")
        handler.send_header("ETag", self.tag)
        handler.send_header("Content-Length", str(len(body)))
        handler.end_headers()
        handler.wfile.write(body[:len(body) // 2])
        handler.close_connection = True

    def fault_gone(self, handler, first, last, size):
        """From now on nobody listens."""
        self.server.socket.close()
        handler.close_connection = True
        handler.connection.shutdown(socket.SHUT_RDWR)

    def fault_redirect(self, handler, first, last, size):
        self.status(handler, 302, Location=self.address)

    def fault_redirect_inside(self, handler, first, last, size):
        """To another port of this machine, which listens."""
        self.other = socket.create_server(("127.0.0.1", 0))
        port = self.other.getsockname()[1]
        self.status(handler, 302, Location=f"http://127.0.0.1:{port}/stream.hmlfc")

    def fault_redirect_elsewhere(self, handler, first, last, size):
        self.status(handler, 302, Location=self.file.as_uri())
