"""Depth images of a slanted wall as messages of ROS, and the points that they are."""

import struct
import zlib

import numpy as np
from sensor_msgs.msg import CameraInfo, CompressedImage, Image, PointCloud2, PointField

WIDTH, HEIGHT, FOCAL = 40, 30, 30.0
# compressedDepth's: 16-bit number = A / metres + B, as its default depth_quantization of 100 and
# depth_max of 10 m have it.
QUANTISATION = 10100.0, 1.0 - 10100.0 / 10.0


def depths(frame: int) -> np.ndarray:
    """(HEIGHT, WIDTH) uint16, millimetres."""
    slope = np.arange(WIDTH, dtype=np.uint16) * 5
    return np.tile(1500 + 50 * frame + slope, (HEIGHT, 1)).astype(np.uint16)


def points_of(depths_m: np.ndarray) -> np.ndarray:
    """(HEIGHT * WIDTH, 3) float32, in the optical frame."""
    v, u = np.mgrid[:HEIGHT, :WIDTH]
    x, y = (u - (WIDTH - 1) / 2) / FOCAL * depths_m, (v - (HEIGHT - 1) / 2) / FOCAL * depths_m
    return np.stack((x, y, depths_m), axis=-1).reshape(-1, 3).astype(np.float32)


def metres(frame: int) -> np.ndarray:
    """depths() as an image of floats has them."""
    return (depths(frame) * 0.001).astype("<f4")


def points(frame: int, encoding: str = "16UC1") -> np.ndarray:
    if encoding == "16UC1":
        return points_of(depths(frame) * 0.001)
    return points_of(metres(frame).astype(float))


def camera_info() -> CameraInfo:
    info = CameraInfo(height=HEIGHT, width=WIDTH)
    centre = (WIDTH - 1) / 2, (HEIGHT - 1) / 2
    info.P = [FOCAL, 0, centre[0], 0, 0, FOCAL, centre[1], 0, 0, 0, 1, 0]
    return info


def image(frame: int, encoding: str) -> Image:
    """16UC1 or 32FC1."""
    pixels = depths(frame) if encoding == "16UC1" else metres(frame)
    step = WIDTH * pixels.itemsize
    return Image(height=HEIGHT, width=WIDTH, encoding=encoding, step=step, data=pixels.tobytes())


def png(pixels: np.ndarray) -> bytes:
    """Of 16 bits of grey."""

    def part(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    height, width = pixels.shape
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in pixels)
    header = struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)
    start = b"\x89PNG\r\n\x1a\n"
    return start + part(b"IHDR", header) + part(b"IDAT", zlib.compress(rows)) + part(b"IEND", b"")


def quantised(frame: int) -> np.ndarray:
    """The numbers of 16 bits that compressedDepth makes of an image of metres."""
    a, b = QUANTISATION
    return (a / metres(frame).astype(float) + b).astype(np.uint16)


def compressed_image(frame: int, encoding: str) -> CompressedImage:
    """As the transport compressedDepth has it."""
    pixels = depths(frame) if encoding == "16UC1" else quantised(frame)
    header = struct.pack("<iff", 0, *(QUANTISATION if encoding == "32FC1" else (0.0, 0.0)))
    return CompressedImage(format=f"{encoding}; compressedDepth", data=header + png(pixels))


def compressed_points(frame: int, encoding: str) -> np.ndarray:
    """What is left of points() in such an image."""
    if encoding == "16UC1":
        return points(frame)
    a, b = QUANTISATION
    return points_of((a / (quantised(frame) - b)).astype(np.float32).astype(float))


def cloud(frame: int) -> PointCloud2:
    message = PointCloud2(height=HEIGHT, width=WIDTH, point_step=16, row_step=16 * WIDTH)
    fields = zip(("x", "y", "z"), (0, 4, 8))
    message.fields = [PointField(name, offset, PointField.FLOAT32, 1) for name, offset in fields]
    padded = np.zeros((HEIGHT * WIDTH, 4), np.float32)
    padded[:, :3] = points(frame)
    message.data = padded.tobytes()
    return message
