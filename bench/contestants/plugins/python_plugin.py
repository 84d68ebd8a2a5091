"""Runs the user's script for a worker: the other end of bench/contestants/plugins/script_plugin.cpp."""
import importlib.util
import os
import socket
import struct
import sys
import traceback

PATH, CHANNEL = sys.argv[1], int(sys.argv[2])
MESSAGE = struct.Struct("=B3xI8d")
COUNTS = struct.Struct("=QQ")
DESCRIBE, BUILD, DESTROY, TOUCHES, NEAREST, FIRST_HIT, NOTHING, REPRODUCE = range(8)
NO, YES, FAILED = range(3)
NO_TRIANGLE = 2**32 - 1
ZEROS = (0.0,) * 8


def described(error):
    """What was raised, in one line, and where in the script."""
    where = ""
    for frame in traceback.extract_tb(error.__traceback__):
        if frame.filename == PATH:
            where = f" ({os.path.basename(PATH)}, line {frame.lineno})"
    text = str(error)
    return " ".join(f"{type(error).__name__}{': ' if text else ''}{text}{where}".split())


def vector(numpy, query, what, value):
    array = numpy.asarray(value, dtype=numpy.float64)
    if array.shape != (3,):
        raise ValueError(f"{query} returned a {what} of the shape {array.shape}; it must be (3,)")
    return array.tolist()


def triangle_of(query, value):
    if value is None:
        return NO_TRIANGLE
    number = int(value)
    if number != value or not 0 <= number < NO_TRIANGLE:
        raise ValueError(f"{query} returned the triangle {value!r}; it must be a row of faces, or None")
    return number


class Script:
    def __init__(self):
        try:
            import numpy
        except ImportError as error:
            raise ImportError(f"{error}: a plug-in in Python needs numpy") from None
        self.numpy = numpy
        sys.dont_write_bytecode = True
        sys.path.insert(0, os.path.dirname(PATH))
        spec = importlib.util.spec_from_file_location("touchmark_plugin", PATH)
        self.module = importlib.util.module_from_spec(spec)
        sys.modules["touchmark_plugin"] = self.module
        spec.loader.exec_module(self.module)
        self.kind = getattr(self.module, "Detector", None)
        if not isinstance(self.kind, type):
            raise AttributeError("it has no class Detector, which docs/plugins.md asks for")
        self.detectors = {}

    def describe(self):
        def word(name, otherwise):
            value = getattr(self.module, name, otherwise)
            if not isinstance(value, str):
                raise TypeError(f"{name} is a {type(value).__name__}; it must be a text")
            return " ".join(value.split())
        stem = os.path.splitext(os.path.basename(PATH))[0]
        queries = [name for name in ("touches", "nearest", "first_hit") if callable(getattr(self.kind, name, None))]
        return "\n".join([word("name", stem), word("summary", "a plug-in in Python"), word("guarantee", "approximate"),
                          " ".join(queries)])

    def build(self, number, vertices, faces):
        detector = self.detectors[number] = self.kind(self.points(vertices), self.corners(faces))
        return YES, number, (float(getattr(detector, "nbytes", 0)), float(getattr(detector, "error", 0)), *ZEROS[2:])

    def reproduce(self, query, values, vertices, faces):
        """What shows the answer to a question in the engine's own API, or nothing where the module cannot say."""
        write = getattr(self.module, "reproduce", None)
        if write is None:
            return ""
        point = list(values[:3])
        question = {TOUCHES: {"query": "touches", "center": point, "radius": values[3]},
                    NEAREST: {"query": "nearest", "center": point, "reach": values[3]},
                    FIRST_HIT: {"query": "first_hit", "from": point, "to": list(values[3:6]), "radius": values[6]}}[query]
        text = write(self.points(vertices), self.corners(faces), question)
        if not isinstance(text, str):
            raise TypeError(f"reproduce returned {text!r:.60}; it must return a text")
        return text

    def points(self, vertices):
        return self.numpy.frombuffer(vertices, self.numpy.float64).reshape(-1, 3)

    def corners(self, faces):
        return self.numpy.frombuffer(faces, self.numpy.uint32).reshape(-1, 3)

    def ask(self, code, number, values):
        detector, point = self.detectors[number], self.numpy.array(values[:3])
        if code == TOUCHES:
            touching = detector.touches(point, values[3])
            if not isinstance(touching, (bool, self.numpy.bool_)):
                raise ValueError(f"touches returned {touching!r}; it must return True or False")
            return (YES if touching else NO), 0, ZEROS
        if code == NEAREST:
            return self.contact("nearest", ("point", "normal", "distance", "triangle"), detector.nearest(point, values[3]))
        end = self.numpy.array(values[3:6])
        return self.contact("first_hit", ("fraction", "point", "normal", "distance", "triangle"),
                            detector.first_hit(point, end, values[6]))

    def contact(self, query, members, found):
        if found is None:
            return NO, 0, ZEROS
        if not isinstance(found, (tuple, list)) or len(found) != len(members):
            raise ValueError(f"{query} returned {found!r:.60}; it must return None or ({', '.join(members)})")
        point, normal, distance, triangle = found[-4:]
        fraction = float(found[0]) if len(members) == 5 else 0.0
        return YES, triangle_of(query, triangle), (*vector(self.numpy, query, "point", point),
                                                   *vector(self.numpy, query, "normal", normal), float(distance), fraction)


def serve(channel):
    script = None

    def receive(size):
        data = bytearray(size)
        view = memoryview(data)
        while view:
            got = channel.recv_into(view, len(view), socket.MSG_WAITALL)
            if got == 0:
                os._exit(0)  # the worker has ended
            view = view[got:]
        return data

    def receive_mesh():
        vertices, faces = COUNTS.unpack(receive(COUNTS.size))
        return bytes(receive(24 * vertices)), bytes(receive(12 * faces))

    while True:
        code, number, *values = MESSAGE.unpack(receive(MESSAGE.size))
        text = b""
        try:
            if code == NOTHING:
                answer = NO, 0, ZEROS
            elif code == DESCRIBE:
                script = script or Script()
                text = script.describe().encode()
                answer = YES, len(text), ZEROS
            elif code == BUILD:
                answer = script.build(number, *receive_mesh())
            elif code == REPRODUCE:
                text = script.reproduce(number, values, *receive_mesh()).encode()
                answer = YES, len(text), ZEROS
            elif code == DESTROY:
                script.detectors.pop(number, None)
                answer = YES, 0, ZEROS
            else:
                answer = script.ask(code, number, values)
        except BaseException as error:  # SystemExit as well: nothing that a script raises ends this
            text = described(error).encode(errors="replace")[:900]
            answer = FAILED, len(text), ZEROS
        channel.sendall(MESSAGE.pack(answer[0], answer[1], *answer[2]) + text)


serve(socket.socket(fileno=CHANNEL))
