#!/usr/bin/env python3
"""Serves a folder by HTTP on a port of its own, which it prints, and misbehaves on demand.

The first part of a path says how: /MODE/dam.roam/packs/... A mode "current-404" concerns CURRENT alone, one without such
a beginning only packs. GET /log answers with all requests so far, one a line, and forgets them; GET /most with the
largest number of requests that were under way at once. GET /release/first lets go the requests of the file ffff...,
which wait for it, and GET /release/rest all of mode "gated" but the first kB, which they send at once.
"""
import contextlib
import http.server
import os
import re
import socket
import ssl
import struct
import sys
import threading
import time

root = sys.argv[1]
log, tries, lock = [], {}, threading.Lock()
line, line_free = threading.Lock(), 0.0  # that all answers share, and when it is free
under_way = most = 0
released = {"first": threading.Event(), "rest": threading.Event()}


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    disable_nagle_algorithm = True

    def log_message(self, *_):
        pass

    def answer(self, status, body=b"", **headers):
        self.send_response(status)
        headers.setdefault("Content_Length", len(body))
        for name, value in headers.items():
            if value is not None:
                self.send_header(name.replace("_", "-"), str(value))
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        global under_way, most
        with lock:
            under_way += 1
            most = max(most, under_way)
        try:
            self.get()
        finally:
            with lock:
                under_way -= 1

    def do_CONNECT(self):  # to the host "403.invalid": status 403
        with lock:
            log.append(f"CONNECT {self.path}")
        self.answer(int(self.path.partition(".")[0]), b"refused")

    def get(self):
        global most
        path, _, query = re.sub("^http://[^/]*", "", self.path).partition("?")  # as a proxy it is given the host, too
        if path == "/log":
            with lock:
                lines, log[:] = "\n".join(log), []
            return self.answer(200, lines.encode())
        if path == "/most":
            with lock:
                found, most = most, 0
            return self.answer(200, str(found).encode())
        if path.startswith("/release/"):
            released[path[9:]].set()
            return self.answer(200)
        wanted = self.headers.get("Range", "")
        with lock:
            log.append(f"{path} {wanted or '-'} {query or '-'} {self.headers.get('Authorization', '-')}")
            tries[self.path, wanted] = turn = tries.get((self.path, wanted), 0) + 1
        if "f" * 64 in path:
            released["first"].wait()
        _, mode, name = path.split("/", 2)
        concerns_current = mode.startswith("current-")
        if name.endswith("/CURRENT") != concerns_current and not (mode.startswith("all-")):
            mode = "good"
        if "/packs/" not in name and not concerns_current and not mode.startswith("all-"):
            mode = "good"
        mode = mode.removeprefix("current-").removeprefix("all-")
        file = os.path.join(root, name)
        if not os.path.isfile(file):
            return self.answer(404, b"nothing here")
        with open(file, "rb") as opened:
            body = opened.read()
        self.respond(mode, body, re.fullmatch(r"bytes=(\d+)-(\d+)", wanted), turn, path, query)

    def respond(self, mode, body, wanted, turn, path, query):
        global line_free
        if mode.isdigit():
            return self.answer(int(mode), b"an error", Retry_After=1 if mode == "429" else None)
        if mode in ("503once", "429once"):
            if turn == 1:
                return self.answer(int(mode[:3]), b"busy", Retry_After=1 if mode == "429once" else None)
            mode = "good"
        if mode.startswith("elsewhere"):  # another name for this host; "elsewhere100": by a page of 100 kB
            to = f"http://localhost:{self.server.server_address[1]}" + path.replace(mode, "good", 1)
            return self.answer(302, bytes(1000 * int(mode[9:] or 0)), Location=to)
        if mode == "file":
            return self.answer(302, Location="file:///etc/passwd")
        if mode == "loop":
            return self.answer(302, Location=self.path)
        if mode == "page":  # of a login
            return self.answer(200, b"<html>Who are you?</html>", Content_Type="text/html")
        if mode == "endless":
            self.answer(200, b"", Content_Length=None, Connection="close")
            try:
                while True:
                    self.wfile.write(bytes(1 << 16))
            except OSError:
                self.close_connection = True
                return None
        if mode in ("head", "trailers"):  # header lines without end
            self.close_connection = True
            self.wfile.write(b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n")
            if mode == "trailers":
                self.wfile.write(b"\r\n0\r\n")
            with contextlib.suppress(OSError):
                while True:
                    self.wfile.write(b"X: aa\r\n" * 1000)
            return None
        if mode == "drip" and "/manifests/" in path:  # without end, and never too slow
            self.answer(200, b"", Content_Length=None, Connection="close")
            with contextlib.suppress(OSError):
                while True:
                    self.wfile.write(bytes(5000))
                    time.sleep(0.1)
            self.close_connection = True
            return None
        if mode == "stall":
            time.sleep(600)
        if mode.startswith("late"):  # "late20": by 20 ms
            time.sleep(int(mode[4:]) / 1000)
        if mode.startswith("inner"):  # "inner503": beyond the file's beginning
            mode = mode[5:] if wanted is None or int(wanted[1]) > 0 else "good"
            return self.respond(mode, body, wanted, turn, path, query)
        if mode == "garbage":
            self.wfile.write(b"\0\1\2 this is no HTTP\r\n\r\n")
            self.close_connection = True
            return None
        if mode == "truncated":
            body = body[:64]
            if wanted and int(wanted[1]) >= 64:  # nginx answers 416
                return self.answer(206, body[-1:], Content_Range="bytes 63-63/64")
        if mode.startswith("unsized") and "/manifests/" in path and (turn == 1 or mode == "unsized"):  # "unsizedonce"
            return self.answer(200, body[:len(body) // 2], Content_Length=None, Connection="close")
        if wanted is None or mode == "whole":
            return self.answer(200, body)
        first, last = int(wanted[1]), min(int(wanted[2]), len(body) - 1)
        if first > last:
            return self.answer(416, Content_Range=f"bytes */{len(body)}")
        part = body[first:last + 1]
        said, length = f"bytes {first}-{last}/{len(body)}", len(part)
        rate, _, reset = mode[4:].partition("reset") if mode.startswith("rate") else ("0", "", "")
        rate = int(rate)  # "rate20reset655360": the first try of a range from there on is reset
        if mode == "reset" or (turn == 1 and (mode == "resetonce" or (reset and first >= int(reset)))):
            self.send_response(206)
            self.send_header("Content-Range", said)
            self.send_header("Content-Length", str(length))
            self.end_headers()
            self.wfile.write(part[:length // 2])
            self.wfile.flush()
            self.connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            self.connection.close()
            self.close_connection = True
            return None
        if mode == "short":  # a whole answer of half the bytes
            part, said = part[:length // 2], f"bytes {first}-{first + length // 2 - 1}/{len(body)}"
        if mode == "cut":  # the connection ends early
            self.close_connection = True
            part = part[:length // 2]
        if mode == "gated":
            self.send_response(206)
            self.send_header("Content-Range", said)
            self.send_header("Content-Length", str(length))
            self.end_headers()
            self.wfile.write(part[:1000])
            if length > 1000:
                released["rest"].wait()
                self.wfile.write(part[1000:])
            return None
        if mode.startswith("rate"):  # "rate1250": 1250 kB a second for all answers together, 10 Mbit a second
            self.send_response(206)
            self.send_header("Content-Range", said)
            self.send_header("Content-Length", str(length))
            self.end_headers()
            step = max(512, min(4096, 25 * rate))
            for at in range(0, length, step):
                with line:  # takes its turn
                    line_free = max(line_free, time.monotonic()) + len(part[at:at + step]) / (1000 * rate)
                    until = line_free
                time.sleep(max(0.0, until - time.monotonic()))
                self.wfile.write(part[at:at + step])
            return None
        if mode == "long":
            part = part + bytes(1000)
            length += 1000
        if mode == "bits":
            part = bytes([part[0] ^ 1]) + part[1:]
        if mode == "zeros":
            part = bytes(length)
        if mode == "shifted":
            said = f"bytes {first + 8}-{last + 8}/{len(body)}"
        if mode == "unsaid":
            said = None
        if mode == "absurd":
            said = f"bytes {first}-99999999999999999999999/x"
        return self.answer(206, part, Content_Range=said, Content_Length=len(part) if mode == "short" else length)


class Server(http.server.ThreadingHTTPServer):
    daemon_threads = True
    request_queue_size = 64

    def handle_error(self, *_):
        pass


server = Server(("127.0.0.1", 0), Handler)
if len(sys.argv) > 2:  # a file with a certificate and its key
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.load_cert_chain(sys.argv[2])
    server.socket = context.wrap_socket(server.socket, server_side=True, do_handshake_on_connect=False)
print(server.server_address[1], flush=True)
threading.Thread(target=server.serve_forever, daemon=True).start()
sys.stdin.read()  # until whoever started it ends
