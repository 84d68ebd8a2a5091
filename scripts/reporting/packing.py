"""Arrays for the page: one compressed stream, and where each array is in it."""
import base64
import zlib

import numpy


class Packer:
    """Gathers arrays of unsigned integers and floats; text() is what the page carries."""

    def __init__(self):
        self.parts, self.size = [], 0

    def add(self, array, delta=False):
        """[offset, items, type, 1 if each item is stored less the one before it] for the page's reader."""
        array = numpy.ascontiguousarray(array)
        name = {"u1": "u8", "u2": "u16", "u4": "u32", "f4": "f32", "f8": "f64"}[array.dtype.str[1:]]
        items = len(array)
        if delta:
            array = numpy.diff(array, prepend=array.dtype.type(0))
        width = array.dtype.itemsize
        # Bytes of equal weight together: the high ones vary little.
        planes = array.astype(array.dtype.newbyteorder("<")).view(numpy.uint8).reshape(-1, width).T.tobytes()
        self.parts.append(planes)
        offset, self.size = self.size, self.size + len(planes)
        return [offset, items, name, int(delta)]

    def text(self):
        return base64.b64encode(zlib.compress(b"".join(self.parts), 9)).decode("ascii")


def on_grid(places, low, high):
    """(n, 3) positions as three arrays of 16 bits an axis; 65535 is none."""
    low, high = numpy.array(low, float), numpy.array(high, float)
    extent = numpy.where(high > low, high - low, 1)
    share = numpy.clip((places - low) / extent, 0, 1)
    levels = numpy.where(numpy.isnan(share), 65535, numpy.rint(65534 * numpy.nan_to_num(share)))
    return [levels[:, axis].astype(numpy.uint16) for axis in range(3)]


def log_levels(values, levels):
    """(8-bit levels, low, high) of values on a log scale between their positive extremes; level 0 is also what is not positive."""
    positive = values[values > 0]
    if not len(positive):
        return numpy.zeros(len(values), numpy.uint8), 1.0, 1.0
    low, high = float(positive.min()), float(positive.max())
    if high <= low:
        return numpy.zeros(len(values), numpy.uint8), low, high
    share = numpy.log(numpy.clip(values, low, high) / low) / numpy.log(high / low)
    return numpy.rint(share * (levels - 1)).astype(numpy.uint8), low, high
