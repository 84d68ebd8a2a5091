#!/usr/bin/python3
"""Writes a folder of seeds for each fuzz target: small files of every form that the readers know, whole and damaged,
and scripts for the targets of detectors and proxies. Argument: where the folders go.
"""
import base64
import copy
import json
import pathlib
import random
import struct
import sys

VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.1, 0.2, 1e-9), (-1e300, 2.5, 4.9e-324)]
FACES = [(0, 1, 2), (0, 1, 3), (1, 2, 3, 4)]


def ply(form, index="vertex_indices", extra=""):
    header = (f"ply\nformat {form} 1.0\ncomment seed\nelement vertex {len(VERTICES)}\nproperty double x\n"
              f"property float64 y\nproperty double z\n{extra}element face {len(FACES)}\n"
              f"property list uchar int {index}\nend_header\n")
    if form == "ascii":
        lines = [" ".join(map(repr, v)) + (" 7" if extra else "") for v in VERTICES]
        lines += [" ".join(map(str, (len(f), *f))) for f in FACES]
        return (header + "\n".join(lines) + "\n").encode()
    order = "<" if "little" in form else ">"
    body = b"".join(struct.pack(order + "3d", *v) + (b"\7" if extra else b"") for v in VERTICES)
    body += b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in FACES)
    return header.encode() + body


PLY_VERTICES = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
PLY_POINTS = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n"


def unusual_ply():
    """What few programs write, and files that are refused by name."""
    start, end = "ply\nformat ascii 1.0\n", "end_header\n"
    strips = "element tristrips 1\nproperty list int int vertex_indices\n"
    faces = "element face 1\nproperty list uchar int vertex_indices\n"
    yield start + PLY_VERTICES + strips + end + PLY_POINTS + "8 0 1 2 3 3 -1 1 2\n"
    yield start + PLY_VERTICES + faces.replace("int", "float") + end + PLY_POINTS + "4 0 1.0 3 2e0\n"
    yield start + faces + PLY_VERTICES + end + "4 0 1 3 2\n" + PLY_POINTS + "\n\0\0"
    yield "\ufeff" + start + PLY_VERTICES + "property float x\n" + faces + end + PLY_POINTS + "3 0 1 2\n"
    edges = "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
    yield start + PLY_VERTICES + edges + end + PLY_POINTS + "0 1\n"
    yield start + edges + PLY_VERTICES + faces + end + "0 1\n" + PLY_POINTS + "3 0 1 2\n"
    yield start + PLY_VERTICES + faces + end + PLY_POINTS.replace("0 0 0", "0,0 0,5 0") + "3 0 1 2\n"
    yield start + PLY_VERTICES + faces + faces.replace("face", "range_grid") + end + PLY_POINTS + "3 0 1 2\n0\n"


def obj():
    yield "\ufefff 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\ncstype bspline\ncurv 0 1 1 2 3\nend\nf -1 -2 3\n"
    yield "v 0 0 0\nsurf 0 1 0 1 1\n"
    yield "# C:\\\nv 0 0 0#a\\\nv 1 \\\r0 0\nv 0 1 0\nt crease 2/1/0 0 1 2.0\nvw 1 2 0.5\nf 1\\\n 2\\\r\n 3\n"
    yield "v 0,5 1 2\n"
    # A face of more corners than are clipped: a square with many on its sides.
    corners = [(i, 0) for i in range(300)] + [(300, i) for i in range(300)]
    corners += [(300 - i, 300) for i in range(300)] + [(0, 300 - i) for i in range(300)]
    yield "".join(f"v {x} {y} 0\n" for x, y in corners) + "f " + " ".join(str(i + 1) for i in range(1200)) + "\n"
    yield "".join(f"v {x} {y} {z}\n" for x, y, z in VERTICES) + "f 1 2 3\nf 1/1 2/2/2 -1//3\nf 1 2 3 \\\n4\n"
    yield "# a comment\r\no thing\r\nv 0 0 0\r\nv 1 0 0 1.0\r\nv 0 1 0\r\nvt 0 0\r\nvn 0 0 1\r\ns off\r\nf -3 -2 -1\r\n"


def off():
    faces = "".join(f"{len(f)} {' '.join(map(str, f))}\n" for f in FACES)
    vertices = "".join(f"{x} {y} {z}\n" for x, y, z in VERTICES)
    yield f"OFF\n{len(VERTICES)} {len(FACES)} 0\n{vertices}{faces}"
    yield f"{len(VERTICES)} {len(FACES)} 0\n{vertices}{faces}"
    yield "4nOFF 3\n3 1 0\n0 0 0 1\n2 0 0 2\n0 1 0 1\n3 0 1 2\n\0"
    yield "OFF BINARY\n"
    yield "CSTOFF3 1 0\n0 0 0 1 1\n1 0 0 1 1\n0 1 0 1 1\n3 0 1 2\n"
    yield "noff 3\n3\n1#\n0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
    yield "n4OFF3 3 1 0\n0 0 0 1\n2 0 0 2\n0 1 0 1\n3 0 1 2\n"
    yield "off\n3 1\n0 0 0\n1,5 0 0\n0 1 0\n3 0 1 2\n"
    yield "COFF # coloured\n3 1 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n3 0 1 2 0.5 0.5 0.5\n"


def stl():
    facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e-9 0\nendloop\nendfacet\n"
    yield f"solid a\n{facet}{facet}endsolid a\nsolid b\n{facet}endsolid\n".encode()
    words = facet.replace("1e-9 0\n", "1e-9 0\ncolor 1 0 0\n").replace("loop\n", "loop x\n").replace("facet\n", "facet y z\n")
    yield f"solid a facet\ncolor 1\n{words}{' '.join(facet.split())} {words}endsolid a b\n".encode()
    yield f"solid {' '.join(facet.split())}\n{facet.replace('1e-9', '0,5')}endsolid\n".encode()
    quad = facet.replace("endloop", "vertex 1 1 0\nendloop").upper()
    yield f"\ufeffSOLID a\n{quad}ENDSOLID a\n\0".encode()
    for start in (b"made", b"solid"):
        corners = [0, 0, 1] + [c for v in VERTICES[:3] for c in v]
        yield start.ljust(80, b"\0") + struct.pack("<I", 2) + 2 * (struct.pack("<12f", *corners) + b"\0\0")


def glb(file, binary):
    file = copy.deepcopy(file)
    file["buffers"][0].pop("uri")
    text = json.dumps(file, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    return (struct.pack("<4s2I", b"glTF", 2, 28 + len(text) + len(binary)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def gltf():
    """A tetrahedron as text and binary: plain, of bytes, sparse, as strip and fan, instanced, mirrored, nested, compressed."""
    binary = struct.pack("<12f12H", 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3)
    attributes = {"attributes": {"POSITION": 0}, "indices": 1}
    plain = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "a", "mesh": 0}],
             "meshes": [{"primitives": [attributes]}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                           {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
             "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
             "buffers": [{"byteLength": 72, "uri": "data:;base64," + base64.b64encode(binary).decode()}]}
    changes = [
        {},
        {"accessors": [{"bufferView": 0, "componentType": 5120, "normalized": True, "count": 9, "type": "VEC3"},
                       {"bufferView": 1, "componentType": 5121, "count": 24, "type": "SCALAR"}],
         "extensionsRequired": ["KHR_mesh_quantization"]},
        {"accessors": [{"componentType": 5126, "count": 9, "type": "VEC3", "sparse": {
            "count": 1, "indices": {"bufferView": 1, "byteOffset": 2, "componentType": 5123}, "values": {"bufferView": 0}}},
                       {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}]},
        {"meshes": [{"primitives": [attributes | {"mode": mode} for mode in (1, 5, 6)]
                     + [{"attributes": {"POSITION": 0}, "mode": 5}]}]},
        {"nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "SCALE": 0}}}}]},
        {"nodes": [{"children": [1, 2], "scale": [-1, 2, 1]}, {"mesh": 0, "rotation": [0, 0, 1, 0], "translation": [1, 2, 3]},
                   {"mesh": 0, "matrix": [1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1], "children": [3]}, {"mesh": 0}]},
        {"meshes": [{"primitives": [attributes | {"extensions": {"KHR_draco_mesh_compression": {
            "bufferView": 0, "attributes": {"POSITION": 0}}}}]}]},
        {"nodes": [{"children": [1]}, {"children": [0]}], "extensionsRequired": ["EXT_meshopt_compression"]},
        {"buffers": [{"byteLength": 72, "uri": "a%20b/c.bin"}]}]
    for change in changes:
        yield json.dumps(plain | change).encode()
        yield glb(plain | change, binary)


DAE = """<?xml version="1.0"?>
<COLLADA version="1.4.1"><asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="s"><float_array id="a" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array>
<technique_common><accessor source="#a" count="4" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
FACES</mesh></geometry></library_geometries>
<library_nodes><node id="l">TRANSFORM<instance_geometry url="#g"/></node></library_nodes><library_visual_scenes><visual_scene id="S">
<node name="part"><instance_node url="#l"/><node id="n"><instance_geometry url="#g"/></node></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#S"/></scene></COLLADA>
"""


def dae():
    """Every primitive and transform; arrays, indices and instances that name too much."""
    vertex = '<input semantic="VERTEX" source="#v" offset="0"/>'
    lists = "<p>0 2 1 0 1 3</p><p>0 3 2 1</p>"
    primitives = [f'<{kind} count="2">{vertex}{lists}</{kind}>' for kind in ("polygons", "tristrips", "trifans", "lines")]
    primitives.append(f'<triangles count="2">{vertex}<input semantic="NORMAL" offset="1"/>'
                      "<p>0 7 2 7 1 7 0 7 1 7 3 7</p></triangles>")
    primitives.append(f'<polylist count="2">{vertex}<vcount>3 4</vcount><p>0 2 1 0 1 3 2</p></polylist>')
    primitives.append(f'<polygons count="1">{vertex}<ph><p>0 1 2</p><h>1 2 3</h></ph></polygons>')
    transforms = ["<matrix>-1 0 0 4 0 1 0 5 0 0 1 6 0 0 0 1</matrix>", "<rotate>1 2 3 40</rotate><translate>1 2 3</translate>",
                  "<scale>2 3 4</scale><skew>45 0 1 0 1 0 0</skew>", "<lookat>0 0 5 1 0 0 0 1 0</lookat>", ""]
    for number, primitive in enumerate(primitives):
        yield DAE.replace("FACES", primitive).replace("TRANSFORM", transforms[number % len(transforms)])
    whole = DAE.replace("FACES", primitives[-2]).replace("TRANSFORM", "")
    for good, bad in (('"12"', '"3"'), ('stride="3"', 'stride="30"'), ("0 1 3 2", "0 1 3 -1"), ('url="#g"', 'url="#l"'),
                      ("<instance_geometry", '<instance_node url="#l"/><instance_geometry'), ('url="#g"', 'url="b.dae#g"'),
                      ('<?xml version="1.0"?>', '<!DOCTYPE x [<!ENTITY y "z">]>'), ("0 2 0", "0 <!-- --> 2 <![CDATA[0]]>")):
        yield whole.replace(good, bad)
    yield whole.replace("<", "<c:").replace("<c:/", "</c:").replace("<c:?", "<?")
    chain = "".join(f'<node id="l{i}">' + 2 * f'<instance_node url="#l{i + 1}"/>' + "</node>" for i in range(9))
    yield whole.replace('id="l"', 'id="l9"').replace("<library_nodes>", "<library_nodes>" + chain).replace('"#l"', '"#l0"')


def trajectory():
    yield "x,y,z\n0,0,0\n1e-9,2,3\n"
    yield "sep=;\r\nT_ms;Pos X;Pos Y;Pos Z\r\n0;0,5;1;2\r\n# lost\r\n1,5;2;1e-3;4\r\n;;;\r\n3;1;2;3;;\r\n"
    yield "% recorded\n# px\tpy\tpz\n1.5\t2\t3\n4\t5\t6"
    yield "0,1,2,3\n0.001,4,5,6\n0.009,7,8,9\n"
    yield '\ufefftime_s,"x",y,z,radius,more\r\n0,1,2,3,0.5,"a ""b"", c"\r\n0.001,1,2,3,0,\r\n'
    yield ("%time,field.header.frame_id,field.point.x,field.point.y,field.point.z\n"
           "1600000000000000000,a,0,0,1\n1600000000000500000,,0,0,2\n")
    yield "1600000000,0,1,2,3\n1600000000,500000,4,5,6\n"
    yield "# timestamp tx ty tz\n1600000000.001 1  2\t3 \r 1.600000001e9 4 5 6\r"
    yield ("#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m]\n"
           "1403636580838555648,1,2,3\n1403636580839055648,4,5,6\n")
    yield "Version,1.2,Name,a b\n\n,,Tool,Tool,Tool\nFrame,Time (Seconds),X,Y,Z\n0,0.5,1,2,3\n1,0.501,4,5,6\n"


def detectors():
    """Bytes as script.h reads them: an arbitrary choice of them is as good as any other."""
    draw = random.Random(1)
    for length in (16, 40, 64, 64, 100, 100, 160, 160, 220, 220):
        yield bytes(draw.randrange(256) for _ in range(length))
    for length in (60, 100, 140, 180):  # whole numbers in the natural scale
        yield bytes(draw.choice((0, 0, 1, 2, 3, 4, 33, 34)) for _ in range(length))


def damaged(text):
    """Each half of it, and with one byte changed here and there."""
    draw = random.Random(len(text))
    yield text[:len(text) // 2]
    yield text[:-1]
    for _ in range(3):
        at = draw.randrange(len(text))
        yield text[:at] + bytes([draw.randrange(256)]) + text[at + 1:]


def seeds():
    forms = [ply("ascii"), ply("binary_little_endian"), ply("binary_big_endian"), ply("ascii", "vertex_index"),
             ply("ascii", extra="property uchar red\n"), ply("binary_little_endian", extra="property uchar red\n")]
    huge = [ply("ascii").replace(b"element face 3", b"element face 4294967295"),
            ply("binary_little_endian").replace(b"element vertex 5", b"element vertex 2147483648")]
    yield "ply", forms + huge + [text.encode() for text in unusual_ply()]
    yield "obj", [text.encode() for text in obj()]
    yield "off", [text.encode() for text in off()]
    yield "stl", list(stl())
    yield "gltf", list(gltf())
    yield "dae", [text.encode() for text in dae()] + [text.encode("utf-16") for text in list(dae())[:1]]
    yield "trajectory", [text.encode() for text in trajectory()]
    yield "detectors", list(detectors())
    yield "proxy", list(detectors())


def main():
    folder = pathlib.Path(sys.argv[1])
    for target, whole in seeds():
        (folder / target).mkdir(parents=True, exist_ok=True)
        texts = whole + ([] if target in ("detectors", "proxy") else [bad for text in whole for bad in damaged(text)])
        for number, text in enumerate(texts):
            (folder / target / f"{number:02}").write_bytes(text)


if __name__ == "__main__":
    main()
