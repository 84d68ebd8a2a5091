"""Revisions and their plug-ins."""
import collections
import filecmp
import hashlib
import os
import pathlib
import shutil
import subprocess

from regression.failure import BadInput, NoResources

ROOT = pathlib.Path(__file__).resolve().parents[2]
JUDGED = ("core", "CMakeLists.txt")  # what a plug-in is made of, beside the gate's own source

Revision = collections.namedtuple("Revision", "commit text")


class DoesNotBuild(Exception):
    """The plug-in does not compile against a revision; the message is one line and names the log."""


def git(*arguments, check=True):
    done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        if check:
            raise BadInput(f"git {' '.join(arguments)}: {(done.stderr.strip() or 'failed').splitlines()[-1]}")
        return None
    return done.stdout.strip()


def commit_of(name):
    return git("rev-parse", "--verify", "--quiet", name + "^{commit}", check=False)


def described(commit):
    return git("log", "-1", "--format=%h %s", commit)


def head_revision():
    commit = commit_of("HEAD")
    if commit is None:
        raise BadInput("this is no git repository with a commit: nothing to compare with")
    changed = git("status", "--porcelain", "--untracked-files=no", "--", *JUDGED, "bench")
    return Revision(commit, described(commit) + (", with uncommitted changes" if changed else ""))


def base_revision(asked):
    """The commit to compare with: as asked, else where this branch left origin/main, else the parent."""
    if asked is not None:
        commit = commit_of(asked)
        if commit is None:
            raise BadInput(f"--against {asked}: no such revision")
        return Revision(commit, described(commit))
    head = commit_of("HEAD")
    if head is None:
        raise BadInput("this is no git repository with a commit: nothing to compare with")
    fork = git("merge-base", "HEAD", "origin/main", check=False)
    commit = fork if fork and fork != head else commit_of("HEAD^")
    if commit is None:
        raise BadInput("HEAD has no parent here (a shallow clone?): name a revision with --against")
    return Revision(commit, described(commit))


def core_of(commit):
    """Identifies what is judged of a commit."""
    parts = [git("rev-parse", "--verify", "--quiet", f"{commit}:{path}", check=False) for path in JUDGED]
    if None in parts:
        raise BadInput(f"{commit[:12]} has no {JUDGED[parts.index(None)]}: it cannot be compared")
    return hashlib.sha256(" ".join(parts).encode()).hexdigest()[:16]


def is_unchanged_since(commit):
    """Is what is judged of this tree, with what is not committed, what it was in the commit?"""
    return (git("diff", "--quiet", commit, "--", *JUDGED, check=False) is not None
            and not git("status", "--porcelain", "--untracked-files=all", "--", *JUDGED))


def extracted(commit, folder):
    """The tree of the commit in folder/source, left alone where it is already."""
    stamp, source = folder / "revision", folder / "source"
    wanted = core_of(commit)
    if stamp.is_file() and stamp.read_text(encoding="utf-8") == wanted and source.is_dir():
        return source
    shutil.rmtree(folder, ignore_errors=True)
    source.mkdir(parents=True)
    with subprocess.Popen(["git", "archive", commit, *JUDGED], cwd=ROOT, stdout=subprocess.PIPE) as archive:
        # Without the commit's times (-m), which would look older than what was built before.
        unpacked = subprocess.run(["tar", "-x", "-m", "-C", source], stdin=archive.stdout, check=False)
    if archive.returncode != 0 or unpacked.returncode != 0:
        raise NoResources(f"cannot unpack {commit[:12]} into {source}")
    stamp.write_text(wanted, encoding="utf-8")
    return source


def synchronised(folder):
    """This tree, with what is not committed, in folder/source: at the same place in relation to what is built as a
    base's is, so that a compiler cache knows the files that both have."""
    source = folder / "source"
    wanted = {ROOT / "CMakeLists.txt"} | {path for path in (ROOT / "core").rglob("*") if path.is_file()}
    copies = {source / path.relative_to(ROOT): path for path in wanted}
    for copy, path in copies.items():
        if not copy.is_file() or not filecmp.cmp(copy, path, shallow=False):
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, copy)
    for old in source.rglob("*"):
        if old.is_file() and old not in copies:
            old.unlink()
    return source


def plugin(source, folder, driver=False):
    """The plug-in with the core of `source` inside, built in folder/build; with `driver` touchmark-regression beside it."""
    build, log = folder / "build", folder / "build.log"
    folder.mkdir(parents=True, exist_ok=True)
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    steps = (
        ["cmake", "-S", ROOT / "bench" / "regression" / "driver", "-B", build, "-G", "Ninja", "-Wno-dev", "-DCMAKE_BUILD_TYPE=Release",
         "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON",  # a cached one of another build has crashed GCC 12
         f"-DTOUCHMARK_SOURCE={source}", f"-DTOUCHMARK_GATE_DRIVER={'ON' if driver else 'OFF'}", *launcher],
        ["cmake", "--build", build],
    )
    environment = {**os.environ, "CCACHE_BASEDIR": str(ROOT), "CCACHE_SLOPPINESS": "pch_defines,time_macros"}
    with open(log, "wb") as output:
        for step in steps:
            try:
                done = subprocess.run(step, stdout=output, stderr=subprocess.STDOUT, check=False, env=environment)
            except FileNotFoundError:
                raise NoResources(f"{step[0]} is missing: run scripts/setup develop") from None
            if done.returncode != 0:
                raise DoesNotBuild(f"{source}: the plug-in does not build; see {log}")
    return build / "plugin.so"


def copied(library, name, folder):
    """A copy under another name, which is loaded apart."""
    folder.mkdir(parents=True, exist_ok=True)
    copy = folder / f"{name}.so"
    temporary = copy.with_suffix(f".{os.getpid()}.part")  # a loaded library must not be written over
    shutil.copyfile(library, temporary)
    temporary.replace(copy)
    return copy
