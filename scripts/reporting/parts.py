"""The page's script: TypeScript of web/, three.js and dygraphs, bundled by esbuild and kept in a cache."""
import hashlib
import os
import pathlib
import shutil
import subprocess
import tempfile

WEB = pathlib.Path(__file__).resolve().parent / "web"
BUNDLED = WEB / "built"  # in a package that has no esbuild
LIBRARIES = pathlib.Path(os.environ.get("TOUCHMARK_JAVASCRIPT", "/usr/share/javascript"))
THREE, DYGRAPHS = LIBRARIES / "three", LIBRARIES / "dygraphs"
NEEDED = [THREE / "three.module.js", THREE / "examples/jsm/controls/OrbitControls.js", DYGRAPHS / "dygraph.js",
          DYGRAPHS / "dygraph.css"]
LICENCES = """With three.js (c) 2010-2019 three.js authors and dygraphs (c) 2006-, 2009-, 2011- Dan Vanderkam and others, both
under the MIT licence: Permission is hereby granted, free of charge, to any person obtaining a copy of this software and
associated documentation files (the "Software"), to deal in the Software without restriction, including without limitation
the rights to use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies of the Software, and to permit
persons to whom the Software is furnished to do so, subject to the following conditions: The above copyright notice and this
permission notice shall be included in all copies or substantial portions of the Software. THE SOFTWARE IS PROVIDED "AS IS",
WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR
A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES
OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE
SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE."""


class Missing(Exception):
    """The script cannot be built here; the message says why, as the end of a sentence."""


def cache_folder():
    return pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "touchmark" / "report-page"


def sources():
    return sorted(path for path in WEB.rglob("*") if path.suffix in (".ts", ".css"))


def key_of(esbuild):
    """Of all that the script is made of."""
    version = subprocess.run([esbuild, "--version"], capture_output=True, text=True, check=False).stdout
    digest = hashlib.sha256(version.encode())
    for path in [*sources(), *NEEDED, pathlib.Path(__file__)]:
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def built():
    """(script, style) of the page. Raises Missing."""
    if BUNDLED.is_dir():
        return (BUNDLED / "page.js").read_text(encoding="utf-8"), (BUNDLED / "page.css").read_text(encoding="utf-8")
    esbuild = shutil.which("esbuild")
    lacking = [str(path) for path in NEEDED if not path.is_file()]
    if esbuild is None or lacking:
        what = "esbuild" if esbuild is None else lacking[0]
        raise Missing(f"{what} is not installed; scripts/setup report brings it")
    folder = cache_folder() / key_of(esbuild)
    try:
        return (folder / "page.js").read_text(encoding="utf-8"), (folder / "page.css").read_text(encoding="utf-8")
    except OSError:
        pass
    script, style = bundle(esbuild)
    keep(folder, script, style)
    return script, style


def bundle(esbuild):
    with tempfile.TemporaryDirectory() as scratch:
        out = pathlib.Path(scratch)
        done = subprocess.run(
            [esbuild, str(WEB / "main.ts"), "--bundle", "--minify", "--format=iife", "--target=es2020", "--charset=utf8",
             "--log-level=warning", "--legal-comments=none", f"--alias:three={THREE / 'three.module.js'}",
             f"--alias:orbit-controls={THREE / 'examples/jsm/controls/OrbitControls.js'}",
             f"--alias:dygraphs={DYGRAPHS / 'dygraph.js'}", f"--outfile={out / 'page.js'}"],
            capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Missing("esbuild failed: " + (done.stderr.strip().splitlines() or ["it said nothing"])[0])
        style = (DYGRAPHS / "dygraph.css").read_text(encoding="utf-8")
        return (out / "page.js").read_text(encoding="utf-8"), style


def keep(folder, script, style):
    """Where the cache cannot be written, the script is built again next time."""
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        scratch = pathlib.Path(tempfile.mkdtemp(dir=folder.parent))
        (scratch / "page.js").write_text(script, encoding="utf-8")
        (scratch / "page.css").write_text(style, encoding="utf-8")
        scratch.rename(folder)
    except OSError:
        pass
