"""Runs `hmlfc view` for tests."""

import http.client
import json
import signal
import subprocess
import sys
from pathlib import Path
from urllib.parse import quote, urlsplit

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))

from program import PROGRAM


class PageServer:
    """The program on a free port, until `with` ends. `address` is the page's."""

    def __init__(self, folder, *arguments):
        command = [PROGRAM, "view", *map(str, arguments), "--no-browser"]
        self.process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        if not self.address:
            raise AssertionError(self.process.communicate()[1])
        self.host = urlsplit(self.address).netloc
        self.path = urlsplit(self.address).path

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def end(self, number=signal.SIGINT):
        """Ends the program as Ctrl-C does, and returns (exit status, standard error)."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        message = self.process.communicate(timeout=20)[1]
        return self.process.returncode, message

    def ask(self, path, query=None, method="GET", **headers):
        """(status, headers, body) of an address beside the page's."""
        return self.ask_path(self.path + path, query, method, **headers)

    def ask_path(self, path, query=None, method="GET", **headers):
        pairs = "&".join(f"{name}={quote(str(value), safe=',')}" for name, value in (query or {}).items())
        connection = http.client.HTTPConnection(self.host, timeout=60)
        named = {name.replace("_", "-"): value for name, value in headers.items()}
        connection.request(method, path + ("?" + pairs if pairs else ""), headers=named)
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        return answer.status, dict(answer.getheaders()), body

    def json(self, path, query=None):
        status, _, body = self.ask(path, query)
        if status != 200:
            raise AssertionError(f"{path}: status {status}, {body.decode()}")
        return json.loads(body)
