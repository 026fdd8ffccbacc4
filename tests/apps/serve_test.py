#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""serve_test.py PROGRAM MESHES: flbc view --serve under connections that no browser makes."""

import gzip
import pathlib
import signal
import socket
import subprocess
import sys
import time
import urllib.parse

PROGRAM, MESHES = sys.argv[1], pathlib.Path(sys.argv[2])


class Served:
    def __init__(self, cage="2d/letter_cage.obj", vertices=300):
        self.process = subprocess.Popen(
            [PROGRAM, "view", "--serve", MESHES / cage, "--vertices", str(vertices), "-q"],
            stdout=subprocess.PIPE, text=True)
        self.address = urllib.parse.urlparse(self.process.stdout.readline().strip())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def connect(self, sent=b""):
        connection = socket.create_connection((self.address.hostname, self.address.port), 20)
        connection.sendall(sent)
        return connection

    def request(self, name="", method="GET", headers="", token=True):
        path = (self.address.path if token else "/" + "0" * 32 + "/") + name
        return (f"{method} {path} HTTP/1.1\r\nHost: {self.address.netloc}\r\n{headers}\r\n").encode()

    def status_of(self, sent):
        with self.connect(sent) as connection:
            return status_in(read_all(connection))

    def megabytes(self):
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        return int(status.split("VmHWM:")[1].split()[0]) / 1024


def read_all(connection):
    received = b""
    while True:
        try:
            piece = connection.recv(1 << 16)
        except ConnectionResetError:
            return received
        if not piece:
            return received
        received += piece


def status_in(reply):
    return int(reply.split(b" ", 2)[1])


def flood(connection, piece, megabytes):
    """Sends until the other side has enough."""
    try:
        for _ in range(megabytes * (1 << 20) // len(piece)):
            connection.sendall(piece)
    except (BrokenPipeError, ConnectionResetError):
        return True
    return False


def test_many_connections_block_nobody():
    with Served() as served:
        idle = [served.connect() for _ in range(30)]
        dripping = [served.connect(b"GET /") for _ in range(30)]
        pages = [served.connect(served.request("alive")) for _ in range(50)]
        for page in pages:
            assert status_in(page.recv(4096)) == 200
        begin = time.monotonic()
        for _ in range(5):
            for connection in dripping:
                connection.sendall(b"x")
            assert served.status_of(served.request()) == 200
        assert time.monotonic() - begin < 10
        crowd = [served.connect() for _ in range(600)]
        assert served.status_of(served.request()) == 200
        for page in pages[1:]:
            page.close()
        time.sleep(4)
        assert served.process.poll() is None, "ended while a page was open"
        pages[0].close()
        assert served.process.wait(10) == 0
        del idle, crowd


def test_requests_have_limits():
    with Served() as served:
        before = served.megabytes()
        with served.connect() as connection:
            assert flood(connection, b"a" * (1 << 16), 64), "a line without end was read"
        with served.connect(served.request("reshape", "POST", "Content-Length: 99999999\r\n",
                                           token=False)) as connection:
            assert status_in(read_all(connection)) == 404
        chunked = "Transfer-Encoding: chunked\r\n"
        for token, status in ((False, 404), (True, 411)):
            with served.connect(served.request("reshape", "POST", chunked, token)) as connection:
                flood(connection, b"10000\r\n" + b"a" * (1 << 16) + b"\r\n", 4)
            assert served.status_of(served.request("reshape", "POST", chunked, token)) == status
        body = gzip.compress(b"a" * (1 << 26))
        coded = f"Content-Encoding: gzip\r\nContent-Length: {len(body)}\r\n"
        assert served.status_of(served.request("reshape", "POST", coded)) == 415
        for length, status in ((17 << 20, 413), (10 ** 30, 413), ("-1", 400), ("1x", 400)):
            headers = f"Content-Length: {length}\r\n"
            assert served.status_of(served.request("reshape", "POST", headers)) == status, length
        assert served.status_of(b"\r\n\r\n") == 400
        assert served.status_of(served.request(headers="Host: evil.example\r\n")) == 400
        assert served.status_of(served.request("reshape", "POST", "Content-Length: 2\r\n") + b"{}") == 200
        assert served.megabytes() < before + 40


def test_slow_requests_end():
    with Served() as served:
        headers = "Content-Length: 100\r\n"
        slow = [served.connect(b"GET / HTTP/1.1\r\n"),
                served.connect(served.request("reshape", "POST", headers))]
        begin = time.monotonic()
        while slow and time.monotonic() - begin < 20:
            time.sleep(0.5)
            for connection in list(slow):
                try:
                    connection.sendall(b"x")
                except (BrokenPipeError, ConnectionResetError):
                    slow.remove(connection)
        assert not slow, "a dripping request never ends"


def test_signals_end_the_program():
    for number in (signal.SIGINT, signal.SIGTERM):
        with Served() as served:
            open_ones = [served.connect() for _ in range(10)]
            open_ones += [served.connect(served.request("alive")) for _ in range(10)]
            time.sleep(0.3)
            served.process.send_signal(number)
            assert served.process.wait(5) == 0
            del open_ones


def test_a_second_signal_does_not_wait():
    with Served("3d/limb_cage.obj", 10000) as served:
        body = b'{"refine": true}'
        busy = [served.connect(served.request("reshape", "POST", f"Content-Length: {len(body)}\r\n") + body)
                for _ in range(20)]
        time.sleep(0.3)
        served.process.send_signal(signal.SIGINT)
        time.sleep(0.02)
        served.process.send_signal(signal.SIGTERM)
        begin = time.monotonic()
        assert served.process.wait(5) in (0, -signal.SIGTERM)
        assert time.monotonic() - begin < 1
        del busy


for name, test in list(globals().items()):
    if name.startswith("test_"):
        print(name, flush=True)
        test()
