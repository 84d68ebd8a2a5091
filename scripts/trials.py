"""What scripts/gate-trials and scripts/busy-trials share: how they end, what they print, and which program they try."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
BAD_INPUT, NO_RESOURCES, INTERRUPTED = 2, 3, 130


class Ended(Exception):
    def __init__(self, status, text):
        super().__init__(text)
        self.status = status


def say(text):
    print(text, file=sys.stderr, flush=True)


def last_words(done):
    """The last line that a program left, on stderr where there is one."""
    return (done.stderr.strip() or done.stdout.strip() or "no word").splitlines()[-1]


def markdown(header, rows):
    lines = ["| " + " | ".join(row) + " |" for row in (header, *rows)]
    lines.insert(1, "|" + "---|" * len(header))
    return "\n".join(lines) + "\n"


def add_program(parser):
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "bin" / "touchmark",
                        metavar="FILE", help="touchmark (build/release/bin/touchmark)")


def status_of(name, program, run, written=str):
    """Runs it and returns the exit status: what it returns, or that of its end. written: of an error in what was read."""
    try:
        if not program.is_file():
            raise Ended(NO_RESOURCES, f"{program} is missing: build the release preset")
        return run()
    except Ended as end:
        say(f"{name}: {end}")
        return end.status
    except (OSError, ValueError, KeyError, IndexError) as error:
        say(f"{name}: {written(error)}")
        return NO_RESOURCES
    except KeyboardInterrupt:
        say(f"{name}: interrupted")
        return INTERRUPTED
