"""Arrays for the page: one compressed stream, and where each array is in it."""
import base64
import zlib

import numpy


TYPES = {"u1": "u8", "u2": "u16", "u4": "u32", "f4": "f32", "f8": "f64", "u8": "b64"}


class Packer:
    """Gathers arrays of unsigned integers and floats; text() is what the page carries."""

    def __init__(self):
        self.parts, self.size = [], 0

    def add(self, array):
        """[offset, items, type, order] for the page's reader: how often differences were taken, whichever is shortest."""
        array = numpy.ascontiguousarray(array)
        kind = TYPES[array.dtype.str[1:]]
        orders = [0] if kind in ("f32", "f64", "b64") or len(array) < 3 else [0, 1, 2]
        forms = [planes_of(differences(array, order)) for order in orders]
        order = min(orders, key=lambda one: len(zlib.compress(forms[one], 1)))
        self.parts.append(forms[order])
        offset, self.size = self.size, self.size + len(forms[order])
        return [offset, len(array), kind, order]

    def text(self):
        return packed(b"".join(self.parts))


def differences(array, order):
    """Of unsigned integers, `order` times each less the one before it; then with the sign in the lowest bit, so that small ones
    of either sign have high bytes that are zero."""
    if order == 0:
        return array
    for _ in range(order):
        array = numpy.diff(array, prepend=array.dtype.type(0))
    signed = array.view(array.dtype.str.replace("u", "i"))
    return ((signed << 1) ^ (signed >> (8 * array.dtype.itemsize - 1))).view(array.dtype)


def planes_of(array):
    """Bytes of equal weight together: the high ones vary little."""
    width = array.dtype.itemsize
    return array.astype(array.dtype.newbyteorder("<")).view(numpy.uint8).reshape(-1, width).T.tobytes()


def packed(content):
    """Bytes as a zlib stream in base 85, a dot for <, which no element of a page takes for a mark; the loader undoes it."""
    return base64.b85encode(zlib.compress(content, 9)).decode("ascii").replace("<", ".")


def coarser(axis, bits):
    """16-bit places with so many of their bits, the others zeros; 65535, which is none, stays."""
    dropped = 16 - bits
    return numpy.where(axis == 65535, axis, (axis >> dropped) << dropped).astype(numpy.uint16)


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
