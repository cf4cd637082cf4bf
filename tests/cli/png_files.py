"""PNG files, written and read without any library."""

import pathlib
import struct
import zlib


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def rgb_png(width, height, pixel):
    """The bytes of a picture of pixel(x, y), three values from 0 to 255."""
    rows = b"".join(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width))
                    for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows))
            + chunk(b"IEND", b""))


def read_png(path):
    """(width, height, bits, channels, rows of bytes) of a PNG without interlacing."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, bits, colour = struct.unpack(">IIBB", body[:10])
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    step, raw, rows, last = channels * bits // 8, zlib.decompress(packed), [], None
    for y in range(height):
        begin = y * (width * step + 1)
        kind, row = raw[begin], bytearray(raw[begin + 1:begin + 1 + width * step])
        last = last or bytes(width * step)
        for i in range(len(row)):
            left = row[i - step] if i >= step else 0
            corner = last[i - step] if i >= step else 0
            guess = left + last[i] - corner
            paeth = min((left, last[i], corner), key=lambda value: abs(guess - value))
            row[i] = (row[i] + (0, left, last[i], (left + last[i]) // 2, paeth)[kind]) % 256
        rows.append(bytes(row))
        last = rows[-1]
    return width, height, bits, channels, rows
