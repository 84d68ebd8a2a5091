"""steps.bin, as docs/reference/steps-bin.md describes it: what each contestant did at each step."""
import json
import struct
import zlib

import numpy

MAGIC, VERSION = b"TMSTEPS\n", 1
TYPES = {"u8": numpy.uint8, "u16": numpy.uint16, "u32": numpy.uint32, "u64": numpy.uint64, "f64": numpy.uint64}
LARGEST_LEVEL, NOWHERE = 65535, 65535


class Damaged(Exception):
    """The file cannot be used; the message is one line."""


class StepsFile:
    """The header, and its blocks when they are asked for."""

    def __init__(self, path):
        try:
            content = path.read_bytes()
        except OSError as error:
            raise Damaged(f"{path}: {error.strerror}") from None
        fixed = len(MAGIC) + 8
        if len(content) < fixed or not content.startswith(MAGIC):
            raise Damaged(f"{path}: not a steps.bin")
        version, size = struct.unpack_from("<II", content, len(MAGIC))
        if version != VERSION:
            raise Damaged(f"{path}: is of version {version}; this script reads version {VERSION}")
        self.path = path
        self.blocks = memoryview(content)[fixed + size:]
        try:
            self.header = json.loads(content[fixed:fixed + size])
            self.run_id = self.header["run_id"]
            self.traces = self.header["traces"]
            self.mesh = self.header["mesh"]
        except (ValueError, KeyError, TypeError):
            raise Damaged(f"{path}: its header is not the JSON it should be") from None

    def block(self, about):
        """The items of a block."""
        try:
            kind = TYPES[about["type"]]
            packed = self.blocks[about["offset"]:about["offset"] + about["bytes"]]
            planes = numpy.frombuffer(zlib.decompress(packed), numpy.uint8)
            width = numpy.dtype(kind).itemsize
            together = planes.reshape(width, about["items"]).T.copy()
        except (KeyError, TypeError, ValueError, zlib.error):
            raise Damaged(f"{self.path}: a block is damaged") from None
        items = together.view(numpy.dtype(kind).newbyteorder("<")).reshape(-1).astype(kind)
        if about["delta"]:
            items = numpy.cumsum(items, dtype=kind)
        return items.view(numpy.float64) if about["type"] == "f64" else items

    def places(self, axes, low, high):
        """(n, 3) positions from 16 bits an axis; NaN where there is none."""
        levels = numpy.stack([self.block(axis) for axis in axes], axis=1)
        low, high = numpy.array(low, float), numpy.array(high, float)
        at = low + levels / (LARGEST_LEVEL - 1) * (high - low)
        at[(levels == NOWHERE).any(axis=1)] = numpy.nan
        return at


def times_of(steps_file, ns):
    """The times in ns from their levels; the least and the largest are exact."""
    levels = steps_file.block(ns["levels"]).astype(float) / LARGEST_LEVEL
    times = ns["low_ns"] * numpy.power(ns["high_ns"] / ns["low_ns"], levels)
    times[levels == 1] = ns["high_ns"]
    return times


def steps_of(ranges):
    """The steps of ranges [begin, end), one after the other."""
    return numpy.concatenate([numpy.arange(begin, end) for begin, end in ranges] or [numpy.arange(0)])
